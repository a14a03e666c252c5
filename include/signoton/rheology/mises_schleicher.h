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
    {}

    /** Whether all lanes are inside. */
    template <typename Number>
    bool
    contains(const Tensor2<Number> &t, const Number &) const
    {
      const Number strength = std::min(Number(friction * (pressure(t) + apex)),
                                       Number(shear_strength));
      const Tensor2<Number> deviator = deviatoric_part(t);
      return all_not_greater(Number(0.), strength) &&
             all_not_greater(Number(0.5 * (deviator * deviator)),
                             Number(strength * strength));
    }

    /** See Projection. */
    template <typename Number, bool with_tangent>
    void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Number          P        = pressure(trial) + apex;
      const Tensor2<Number> deviator = deviatoric_part(trial);
      const Number          tau      = shear_intensity(deviator);
      result.potential_correction    = 0.;

      const Number strength =
        std::min(Number(friction * P), Number(shear_strength));
      if (all_not_greater(tau, strength))
        {
          result.stress = trial;
          result.region = index(Region::interior);
          if constexpr (with_tangent)
            result.tangent = moduli.tensor<Number>();
          return;
        }

      const double k = moduli.bulk, mu = moduli.shear;
      const double D = mu + friction * friction * k;
      const Number P_face =
        (mu / D) * P + (friction * k / D) * tau; // on the extended cone
      const double P_corner = shear_strength / friction;
      const Number zero(0.), one(1.);

      // A weight of one marks the lanes of a region; the order is the
      // sequential rule of the class comment, from last to first.
      const auto pick = [&](const Number &in_corner,
                            const Number &on_face,
                            const Number &at_vertex,
                            const Number &on_cylinder,
                            const Number &inside) {
        Number value =
          select_if_not_greater(P_face, Number(P_corner), on_face, in_corner);
        value = select_if_not_greater(P_face, zero, at_vertex, value);
        value = select_if_not_greater(Number(P_corner), P, on_cylinder, value);
        return select_if_not_greater(tau, strength, inside, value);
      };

      const Number safe_tau = select_if_less(zero, tau, tau, one);
      const Number cut =
        Number(std::isfinite(shear_strength) ? shear_strength : 0.) / safe_tau;
      const Number face_scale  = friction * P_face / safe_tau;
      const Number corner_P    = std::isfinite(P_corner) ? P_corner : 0.;
      const Number new_P       = pick(corner_P, P_face, zero, P, P);
      const Number shear_scale = pick(cut, face_scale, zero, cut, one);

      result.stress = shear_scale * deviator +
                      (apex - new_P) * unit_symmetric_tensor<3, Number>();
      result.region = pick(Number(index(Region::corner)),
                           Number(index(Region::face)),
                           Number(index(Region::vertex)),
                           Number(index(Region::cylinder)),
                           Number(index(Region::interior)));
      if constexpr (with_tangent)
        {
          const Number c    = k * mu / D;
          const Number a_II = pick(zero, c, zero, Number(k), Number(k));
          const Number a_In = pick(zero, -friction * c, zero, zero, zero);
          const Number a_nn =
            pick(zero, friction * friction * c, zero, zero, Number(mu));
          result.tangent = revolution_tangent<Number>(
            a_II, a_In, a_nn, 2. * mu * shear_scale, deviator / safe_tau);
        }
    }

    /**
     * The part of a residual strain $q=E_c^{-1}(t-\pi)$ that is plastic flow on
     * the cylinder; the rest belongs to the contact on the cone. In the corner
     * the contact takes $(\theta_q,\theta_q/\kappa)$ of $(\theta_q,\gamma_q)$.
     */
    template <typename Number>
    Tensor2<Number>
    cylinder_part(const Tensor2<Number> &q, const Number &region) const
    {
      const Tensor2<Number> deviator = deviatoric_part(q);
      const Number          gamma    = 2. * shear_intensity(deviator);
      const Number          zero(0.), one(1.);
      const Number safe_gamma = select_if_less(zero, gamma, gamma, one);
      const Number in_corner =
        std::max(zero, Number(one - trace(q) / (friction * safe_gamma)));
      const Number share = select_if_less(
        region,
        Number(index(Region::cylinder)),
        zero,
        select_if_less(region, Number(index(Region::corner)), one, in_corner));
      return share * deviator;
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
  };
} // namespace Signoton::Rheology

#endif
