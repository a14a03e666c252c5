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
    static constexpr bool hardens = isotropic_hardening;

    /** Both arguments in Pa. */
    VonMisesCylinder(const double shear_strength,
                     const double hardening_modulus = 0.)
      : shear_strength(shear_strength)
      , hardening_modulus(isotropic_hardening ? hardening_modulus : 0.)
    {}

    /** See Projection. */
    template <typename Number, bool with_tangent>
    bool
    project(const Tensor2<Number>            &trial,
            const Moduli                     &moduli,
            Projection<Number, with_tangent> &result) const
    {
      const Tensor2<Number> deviator = deviatoric_part(trial);
      const Number          tau_2    = shear_invariant(deviator);
      Number                strength = shear_strength;
      if constexpr (hardens)
        strength += hardening_stress(result.hardening);
      result.potential_correction = 0.;

      if (all_not_greater(tau_2, Number(strength * strength)))
        {
          result.stress = trial;
          result.region = index(Region::interior);
          if constexpr (with_tangent)
            result.tangent = moduli.tensor<Number>();
          return true;
        }

      const double k = moduli.bulk, mu = moduli.shear,
                   stiffness = mu + hardening_modulus;
      const Number zero(0.), one(1.);
      const Number tau         = std::sqrt(tau_2);
      const Number inverse_tau = one / select_if_less(zero, tau, tau, one);
      const Number slip =
        std::max(zero, Number((tau - strength) * (1. / stiffness)));
      const Number cut = mu * slip * inverse_tau;
      result.stress    = trial - cut * deviator;
      result.region    = select_if_less(zero,
                                     slip,
                                     Number(index(Region::cylinder)),
                                     Number(index(Region::interior)));
      if constexpr (hardens)
        {
          result.hardening += slip;
          result.potential_correction =
            (-0.5 * hardening_modulus) * slip * slip;
        }
      if constexpr (with_tangent)
        {
          const Number along = select_if_less(
            zero, slip, Number(mu * hardening_modulus / stiffness), Number(mu));
          result.tangent = revolution_tangent<Number>(Number(k),
                                                      zero,
                                                      along,
                                                      2. * mu * (one - cut),
                                                      inverse_tau * deviator);
        }
      return false;
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
    double shear_strength;
    double hardening_modulus;
  };
} // namespace Signoton::Rheology

#endif
