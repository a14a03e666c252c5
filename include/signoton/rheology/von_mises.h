#ifndef signoton_rheology_von_mises_h
#define signoton_rheology_von_mises_h

#include <signoton/rheology/projection.h>
#include <signoton/tensors/lanes.h>

namespace Signoton::Rheology
{
  /**
   * The von Mises cylinder $\tau \le \tau_Y + H\gamma$ with shear strength
   * $\tau_Y$ and, if the set hardens, the isotropic hardening modulus $H$ on
   * the accumulated plastic shear $\gamma=\int\sqrt{2\,\dot e^p:\dot e^p}$.
   *
   * Radial return: with $f=\tau_t-\tau_Y-H\gamma_n>0$ the plastic shear of the
   * step is $\Delta\gamma=f/(\mu+H)$ and the deviator is scaled to
   * $\tau_t-\mu\Delta\gamma$. Incremental potential and tangent are those of
   * the implicit Euler step (Simo and Hughes, Computational Inelasticity,
   * Sec. 3.3, in terms of shear intensities).
   */
  template <bool isotropic_hardening>
  class VonMisesCylinder
  {
  public:
    static constexpr bool hardens       = isotropic_hardening;
    static constexpr bool of_revolution = true;

    /** Both arguments in Pa. */
    VonMisesCylinder(const double shear_strength,
                     const double hardening_modulus = 0.)
      : shear_strength(shear_strength)
      , hardening_modulus(isotropic_hardening ? hardening_modulus : 0.)
    {}

    /** See Projection. */
    template <typename Number, bool with_tangent>
    DEAL_II_ALWAYS_INLINE void
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Tensor2<Number> deviator = deviatoric_part(trial);
      const Number          tau_2    = shear_invariant(deviator);
      const Number          zero(0.);
      Number                plastic_shear(0.);
      if constexpr (hardens)
        plastic_shear = result.hardening;
      result.potential_correction = 0.;
      if (surely_contains(zero, tau_2, plastic_shear))
        {
          result.stress = trial;
          result.region = index(Region::interior);
          if constexpr (with_tangent)
            result.tangent = moduli.tensor<Number>();
          return;
        }

      const Return<Number> end = map(zero, tau_2, plastic_shear, moduli);
      result.stress            = trial - end.cut * deviator;
      result.region            = end.region;
      if constexpr (hardens)
        {
          result.hardening = end.hardening;
          result.potential_correction =
            (-0.5 * hardening_modulus) * end.slip * end.slip;
        }
      if constexpr (with_tangent)
        {
          const double mu    = moduli.shear;
          const Number along = select_if_less(zero,
                                              end.slip,
                                              Number(mu * hardening_modulus /
                                                     (mu + hardening_modulus)),
                                              Number(mu));
          result.tangent =
            revolution_tangent<Number>(Number(moduli.bulk),
                                       zero,
                                       along,
                                       2. * mu * end.shear_scale,
                                       end.inverse_tau * deviator);
        }
    }

    /** See Projection. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE bool
    surely_contains(const Number &,
                    const Number &shear_invariant,
                    const Number &plastic_shear) const
    {
      const Number strength = present_strength(plastic_shear);
      return all_not_greater(shear_invariant, Number(strength * strength));
    }

    /** See RadialReturn. */
    template <typename Number>
    DEAL_II_ALWAYS_INLINE RadialReturn<Number>
                          radial_return(const Number &pressure,
                                        const Number &shear_invariant,
                                        const Number &plastic_shear,
                                        const Moduli &moduli) const
    {
      return map(pressure, shear_invariant, plastic_shear, moduli);
    }

    /** What hardening adds to the shear strength, $H\gamma$ in Pa. */
    template <typename Number>
    Number
    hardening_stress(const Number &plastic_shear) const
    {
      return hardening_modulus * plastic_shear;
    }

    /** Energy stored by isotropic hardening, $H\gamma^2/2$ in J/m^3. */
    template <typename Number>
    Number
    hardening_energy(const Number &plastic_shear) const
    {
      return (0.5 * hardening_modulus) * plastic_shear * plastic_shear;
    }

    /** Initial shear strength in Pa. */
    double
    strength() const
    {
      return shear_strength;
    }

  private:
    /** With what gives potential and tangent. */
    template <typename Number>
    struct Return : RadialReturn<Number>
    {
      Number slip, cut, inverse_tau;
    };

    template <typename Number>
    DEAL_II_ALWAYS_INLINE Return<Number>
                          map(const Number &pressure,
                              const Number &tau_2,
                              const Number &plastic_shear,
                              const Moduli &moduli) const
    {
      const Number   zero(0.), one(1.), tau = std::sqrt(tau_2);
      Return<Number> r;
      r.inverse_tau    = one / select_if_less(zero, tau, tau, one);
      r.slip           = std::max(zero,
                        Number((tau - present_strength(plastic_shear)) *
                               (1. / (moduli.shear + hardening_modulus))));
      r.cut            = moduli.shear * r.slip * r.inverse_tau;
      r.pressure       = pressure;
      r.shear_scale    = one - r.cut;
      r.region         = select_if_less(zero,
                                r.slip,
                                Number(index(Region::cylinder)),
                                Number(index(Region::interior)));
      r.hardening      = plastic_shear + r.slip;
      r.cylinder_share = one;
      return r;
    }

    template <typename Number>
    DEAL_II_ALWAYS_INLINE Number
    present_strength(const Number &plastic_shear) const
    {
      Number strength(shear_strength);
      if constexpr (hardens)
        strength += hardening_stress(plastic_shear);
      return strength;
    }

    double shear_strength;
    double hardening_modulus;
  };
} // namespace Signoton::Rheology

#endif
