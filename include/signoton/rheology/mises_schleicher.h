#ifndef signoton_rheology_mises_schleicher_h
#define signoton_rheology_mises_schleicher_h

#include <signoton/rheology/projection.h>
#include <signoton/tensors/lanes.h>

#include <limits>

namespace Signoton::Rheology
{
  /**
   * The von Mises-Schleicher cone $K=\{\tau \le \kappa\,(p+p_0)\}$ with
   * friction parameter $\kappa$ and apex at the hydrostatic tension $p_0$,
   * optionally cut off by a cylinder $\tau\le\tau_Y$.
   *
   * With $P=p_t+p_0$, $\tau_t$ the shifted pressure and the shear intensity of
   * the trial stress and $D=\mu+\kappa^2k$, the projection in the energy norm
   * is, in this order,
   *  - interior, $\tau_t\le\kappa P$ and $\tau_t\le\tau_Y$: the trial stress;
   *  - cylinder, $\kappa P\ge\tau_Y$: shear cut to $\tau_Y$, pressure kept;
   *  - vertex, $P^*=(\mu P+\kappa k\tau_t)/D\le 0$: the apex;
   *  - face, $\kappa P^*\le\tau_Y$: pressure $P^*$, shear $\kappa P^*$;
   *  - corner: pressure $\tau_Y/\kappa$, shear $\tau_Y$.
   *
   * In a face the deviator keeps its direction $n$ and the tangent is
   * $\frac{k\mu}{D} M\otimes M + 2\mu\frac{\kappa P^*}{\tau_t}
   *  (I_d-\tfrac12 n\otimes n)$ with $M=-I+\kappa n$.
   *
   * Source: Sadovskaya and Sadovskii (2012), Sec. 4 for the cone; the formulas
   * follow from minimizing $(P-P_t)^2/k+(\tau-\tau_t)^2/\mu$.
   *
   * All regions are computed and blended, without a branch, except that lanes
   * that are all elastic leave early.
   */
  class MisesSchleicherCone
  {
  public:
    static constexpr bool hardens = false;

    /**
     * @param friction $\kappa > 0$, dimensionless
     * @param apex     $p_0 \ge 0$ in Pa
     * @param shear_strength $\tau_Y$ in Pa; infinite for the bare cone
     */
    MisesSchleicherCone(
      const double friction,
      const double apex,
      const double shear_strength = std::numeric_limits<double>::infinity())
      : friction(friction)
      , apex(apex)
      , shear_strength(shear_strength)
      , corner_pressure(shear_strength / friction)
    {}

    /** See Projection. */
    template <typename Number, bool with_tangent>
    DEAL_II_ALWAYS_INLINE bool
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Number          P        = pressure(trial) + apex;
      const Tensor2<Number> deviator = deviatoric_part(trial);
      const Number          tau_2    = shear_invariant(deviator);
      const Number          zero(0.), one(1.), yield(shear_strength);
      result.potential_correction = 0.;

      const Number strength = std::min(Number(friction * P), yield);
      if (all_not_greater(zero, strength) &&
          all_not_greater(tau_2, Number(strength * strength)))
        {
          result.stress         = trial;
          result.region         = index(Region::interior);
          result.cylinder_share = zero;
          if constexpr (with_tangent)
            result.tangent = moduli.tensor<Number>();
          return true;
        }

      const double k = moduli.bulk, mu = moduli.shear;
      const double share = 1. / (mu + friction * friction * k);
      const Number tau   = std::sqrt(tau_2);
      const Number P_face =
        (mu * share) * P + (friction * k * share) * tau; // on the extended cone

      // Outside, P < P_face: the larger of the two is P in the cylinder only.
      const Number new_P =
        std::max(P, std::min(std::max(P_face, zero), Number(corner_pressure)));
      const Number new_tau =
        std::min(tau, std::min(Number(friction * new_P), yield));
      const Number inverse_tau = one / select_if_less(zero, tau, tau, one);
      const Number shear_scale = new_tau * inverse_tau;
      result.stress = add_spherical(Tensor2<Number>(shear_scale * deviator),
                                    Number(apex - new_P));

      // In the corner, the contact takes (theta, theta / kappa) of the strain
      // (theta, gamma); on the cone it takes all. Here mu times the shears.
      const Number excess  = tau - new_tau;
      const Number contact = (new_P - P) * (mu / (friction * k));
      const Number flow    = std::max(zero, Number(excess - contact)) /
                          select_if_less(zero, excess, excess, one);
      result.cylinder_share =
        select_if_not_greater(P_face, Number(corner_pressure), zero, flow);

      // A weight of one marks the lanes of a region; the order is the
      // sequential rule of the class comment, from last to first.
      const auto pick = [&](const Number &in_corner,
                            const Number &on_face,
                            const Number &at_vertex,
                            const Number &on_cylinder,
                            const Number &inside) {
        const Number corner_P(corner_pressure);
        Number       value =
          select_if_not_greater(P_face, corner_P, on_face, in_corner);
        value = select_if_not_greater(P_face, zero, at_vertex, value);
        value = select_if_not_greater(corner_P, P, on_cylinder, value);
        return select_if_not_greater(tau, strength, inside, value);
      };
      result.region = pick(Number(index(Region::corner)),
                           Number(index(Region::face)),
                           Number(index(Region::vertex)),
                           Number(index(Region::cylinder)),
                           Number(index(Region::interior)));
      if constexpr (with_tangent)
        {
          const Number c    = k * mu * share;
          const Number a_II = pick(zero, c, zero, Number(k), Number(k));
          const Number a_In = pick(zero, -friction * c, zero, zero, zero);
          const Number a_nn =
            pick(zero, friction * friction * c, zero, zero, Number(mu));
          result.tangent = revolution_tangent<Number>(
            a_II, a_In, a_nn, 2. * mu * shear_scale, inverse_tau * deviator);
        }
      return false;
    }

    /** The cone cut off by a cylinder at @p strength in Pa. */
    MisesSchleicherCone
    cut_at(const double strength) const
    {
      return {friction, apex, strength};
    }

    double
    apex_tension() const
    {
      return apex;
    }

  private:
    double friction;
    double apex;
    double shear_strength;
    double corner_pressure; ///< $\tau_Y/\kappa$
  };
} // namespace Signoton::Rheology

#endif
