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
    static constexpr bool hardens       = false;
    static constexpr bool of_revolution = true;

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
    DEAL_II_ALWAYS_INLINE void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Number          p        = pressure(trial);
      const Tensor2<Number> deviator = deviatoric_part(trial);
      const Number          tau_2    = shear_invariant(deviator);
      result.potential_correction    = 0.;
      if (surely_contains(p, tau_2, Number(0.)))
        {
          result.stress         = trial;
          result.region         = index(Region::interior);
          result.cylinder_share = Number(0.);
          if constexpr (with_tangent)
            result.tangent = moduli.tensor<Number>();
          return;
        }

      const Return<Number> end = map(p, tau_2, moduli);
      result.stress = add_spherical(Tensor2<Number>(end.shear_scale * deviator),
                                    Number(-end.pressure));
      result.cylinder_share = end.cylinder_share;
      result.region         = end.region;
      if constexpr (with_tangent)
        {
          const double k = moduli.bulk, mu = moduli.shear;
          const double c = k * mu / (mu + friction * friction * k);
          const Number zero(0.);
          result.tangent = revolution_tangent<Number>(
            pick(end, zero, Number(c), zero, Number(k), Number(k)),
            pick(end, zero, Number(-friction * c), zero, zero, zero),
            pick(end,
                 zero,
                 Number(friction * friction * c),
                 zero,
                 zero,
                 Number(mu)),
            2. * mu * end.shear_scale,
            end.inverse_tau * deviator);
        }
    }

    /** See Projection. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE bool
    surely_contains(const Number &pressure,
                    const Number &shear_invariant,
                    const Number &) const
    {
      const Number strength =
        std::min(Number(friction * (pressure + apex)), Number(shear_strength));
      return all_not_greater(Number(0.), strength) &&
             all_not_greater(shear_invariant, Number(strength * strength));
    }

    /** See RadialReturn. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE RadialReturn<Number>
                          radial_return(const Number &pressure,
                                        const Number &shear_invariant,
                                        const Number &,
                                        const Moduli &moduli) const
    {
      return map(pressure, shear_invariant, moduli);
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
    /** With what tells the regions and gives the tangent. */
    template <typename Number>
    struct Return : RadialReturn<Number>
    {
      Number P, tau, strength, P_face, inverse_tau;
    };

    template <typename Number>
    DEAL_II_ALWAYS_INLINE Return<Number>
    map(const Number &p, const Number &tau_2, const Moduli &moduli) const
    {
      const double   k = moduli.bulk, mu = moduli.shear;
      const double   share = 1. / (mu + friction * friction * k);
      const Number   zero(0.), one(1.), yield(shear_strength);
      Return<Number> r;
      r.P        = p + apex;
      r.strength = std::min(Number(friction * r.P), yield);
      r.tau      = std::sqrt(tau_2);
      r.P_face   = (mu * share) * r.P +
                 (friction * k * share) * r.tau; // on the extended cone

      // Outside, P < P_face: the larger of the two is P in the cylinder only.
      const Number new_P =
        std::max(r.P,
                 std::min(std::max(r.P_face, zero), Number(corner_pressure)));
      const Number new_tau =
        std::min(r.tau, std::min(Number(friction * new_P), yield));
      r.inverse_tau = one / select_if_less(zero, r.tau, r.tau, one);
      r.shear_scale = new_tau * r.inverse_tau;
      r.pressure    = new_P - apex;
      r.hardening   = zero;

      // In the corner, the contact takes (theta, theta / kappa) of the strain
      // (theta, gamma); on the cone it takes all. Here mu kappa k times the
      // shears.
      const Number excess  = (friction * k) * (r.tau - new_tau);
      const Number contact = mu * (new_P - r.P);
      const Number flow    = std::max(zero, Number(excess - contact)) /
                          select_if_less(zero, excess, excess, one);
      r.cylinder_share =
        select_if_not_greater(r.P_face, Number(corner_pressure), zero, flow);
      r.region = pick(r,
                      Number(index(Region::corner)),
                      Number(index(Region::face)),
                      Number(index(Region::vertex)),
                      Number(index(Region::cylinder)),
                      Number(index(Region::interior)));
      return r;
    }

    /** The value of the region of every lane, by the sequential rule of the
     *  class comment from last to first. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE Number
    pick(const Return<Number> &r,
         const Number         &in_corner,
         const Number         &on_face,
         const Number         &at_vertex,
         const Number         &on_cylinder,
         const Number         &inside) const
    {
      const Number corner_P(corner_pressure);
      Number       value =
        select_if_not_greater(r.P_face, corner_P, on_face, in_corner);
      value = select_if_not_greater(r.P_face, Number(0.), at_vertex, value);
      value = select_if_not_greater(corner_P, r.P, on_cylinder, value);
      return select_if_not_greater(r.tau, r.strength, inside, value);
    }

    double friction;
    double apex;
    double shear_strength;
    double corner_pressure; ///< $\tau_Y/\kappa$
  };
} // namespace Signoton::Rheology

#endif
