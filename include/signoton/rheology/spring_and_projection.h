#ifndef signoton_rheology_spring_and_projection_h
#define signoton_rheology_spring_and_projection_h

#include <signoton/rheology/law.h>

namespace Signoton::Rheology
{
  /** Which strain of a law with a projection is remembered. */
  enum class Memory
  {
    none,     ///< rigid contact: reversible
    cylinder, ///< contact and hinge: only flow on the cylinder is plastic
    all       ///< plastic hinge
  };

  /**
   * A spring in series with an element whose stress is confined to a convex
   * set $F$, itself in parallel with an optional second spring (the binder of
   * a granular medium, kinematic hardening of a plastic one):
   * $$ \varepsilon = E^{-1}:\sigma + x,\qquad
   *    \sigma = \pi + B:x,\qquad x - x^p_n \in N_F(\pi), $$
   * where $x$ is the strain of the parallel group and $x^p_n$ the plastic part
   * of it at the last accepted step. Elimination gives, with $E_c=E+B$,
   * $$ \pi = \mathrm{proj}_F^{E_c^{-1}}(E:\varepsilon - E_c:x^p_n),\qquad
   *    \sigma = f\,E:\varepsilon + (1-f)\,\pi, $$
   * where $f$ scales spherical and deviatoric parts by $k_B/(k_E+k_B)$ and
   * $\mu_B/(\mu_E+\mu_B)$. A binder proportional to the spring, $f=\lambda$,
   * gives $\sigma=\lambda s+(1-\lambda)\pi$. The step minimizes the convex
   * $W_n(\varepsilon)=\tfrac12 f E\varepsilon:\varepsilon +
   * \langle\pi,t\rangle_c-\tfrac12|\pi|_c^2$ with $t$ the argument of the
   * projection; $\sigma = dW_n/d\varepsilon$, and
   * $T = fE+(1-f)T_\pi(1-f)$ is symmetric.
   *
   * Source: scheme 2.10b of Sadovskaya and Sadovskii (2012) in tensors;
   * implicit Euler for the plastic part. The elimination is in
   * doc/equations.md.
   */
  template <typename Set, Memory memory>
  class SpringAndProjection
  {
  public:
    static constexpr unsigned int n_tensors = memory == Memory::none ? 0 : 1;
    static constexpr unsigned int n_scalars = Set::hardens ? 1 : 0;
    static constexpr bool         has_potential = true;

    using This = SpringAndProjection<Set, memory>;

    /** @param binder moduli of the parallel spring, zero for none */
    SpringAndProjection(const Moduli &spring,
                        const Moduli &binder,
                        const Set    &set)
      : spring(spring)
      , binder(binder)
      , metric{spring.bulk + binder.bulk, spring.shear + binder.shear}
      , start_moduli(n_tensors == 0 ? spring : metric)
      , compliance(1. / (3. * metric.bulk), 1. / (2. * metric.shear))
      , to_spring{binder.bulk / metric.bulk, binder.shear / metric.shear}
      , to_set{spring.bulk / metric.bulk, spring.shear / metric.shear}
      , set(set)
    {}

    template <unsigned int request, typename Number>
    DEAL_II_ALWAYS_INLINE bool
    update(const Tensor2<Number>       &strain,
           const History<This, Number> &accepted,
           History<This, Number>       &trial,
           Response<Number>            &response) const
    {
      if constexpr ((request & (potential | energies)) == 0)
        {
          const Start<Number> start = start_of_return(strain, accepted);
          if (set.surely_contains(start.pressure,
                                  start.shear_invariant,
                                  start.hardening))
            {
              respond_inside<request>(strain, accepted, trial, response);
              return false;
            }
          if constexpr (Set::of_revolution && (request & tangent) == 0)
            {
              respond_radially<request>(
                strain, start, accepted, trial, response);
              return true;
            }
        }
      const Tensor2<Number> s = spring.stress(strain);
      Tensor2<Number>       t = s;
      if constexpr (n_tensors > 0)
        t -= metric.stress(accepted.tensors[0]);
      Projection<Number, (request & tangent) != 0> projection;
      if constexpr (n_scalars > 0)
        projection.hardening = accepted.scalars[0];
      set.project(t, metric, projection);
      response.stress = to_spring(s) + to_set(projection.stress);
      response.region = projection.region;
      if constexpr (n_tensors > 0)
        trial.tensors[0] =
          accepted.tensors[0] +
          plastic_strain(Tensor2<Number>(t - projection.stress), projection);
      if constexpr (n_scalars > 0)
        trial.scalars[0] = projection.hardening;
      if constexpr (request & tangent)
        response.tangent =
          to_set.both_sides(projection.tangent) +
          isotropic_tensor<Number>(Number(spring.bulk * to_spring.spherical),
                                   Number(2. * spring.shear *
                                          to_spring.deviatoric));
      if constexpr (request & potential)
        response.potential =
          0.5 * (to_spring(s) * strain) +
          metric.energy_product(projection.stress,
                                t - 0.5 * projection.stress) +
          projection.potential_correction;
      if constexpr (request & energies)
        account(s, projection.stress, trial, response);
      if constexpr (request & (energies | dissipation))
        {
          response.dissipation = response.viscous_dissipation = Number(0.);
          if constexpr (n_tensors > 0)
            response.dissipation =
              projection.stress * (trial.tensors[0] - accepted.tensors[0]);
          if constexpr (n_scalars > 0)
            response.dissipation -= set.hardening_stress(trial.scalars[0]) *
                                    (trial.scalars[0] - accepted.scalars[0]);
        }
      return true;
    }

    const Moduli &
    elasticity() const
    {
      return spring;
    }

  private:
    /** The argument $t$ of the projection by its invariants, and the deviator
     *  of a strain $e$ that belongs to it: the whole strain, $t=E:e$, where
     *  nothing is remembered; else $t=E_c:e$. */
    template <typename Number>
    struct Start
    {
      Tensor2<Number> deviator; ///< $e'$
      Number          pressure, shear_invariant, hardening;
    };

    template <typename Number>
    DEAL_II_ALWAYS_INLINE Start<Number>
                          start_of_return(const Tensor2<Number>       &strain,
                                          const History<This, Number> &accepted) const
    {
      Start<Number> start;
      start.hardening = Number(0.);
      if constexpr (n_scalars > 0)
        start.hardening = accepted.scalars[0];
      if constexpr (n_tensors == 0)
        {
          start.deviator = deviatoric_part(strain);
          start.pressure = -start_moduli.bulk * trace(strain);
        }
      else
        {
          start.deviator = deviatoric_part(
            Tensor2<Number>(to_set.deviatoric * strain - accepted.tensors[0]));
          start.pressure = -spring.bulk * trace(strain);
          if constexpr (memory == Memory::all) // else it is a deviator
            start.pressure += metric.bulk * trace(accepted.tensors[0]);
        }
      start.shear_invariant = (2. * start_moduli.shear * start_moduli.shear) *
                              (start.deviator * start.deviator);
      return start;
    }

    /** The answer where no lane gives way, which most points of a body get:
     *  that of the spring, short of the plastic strain. */
    template <unsigned int request, typename Number>
    DEAL_II_ALWAYS_INLINE void
    respond_inside(const Tensor2<Number>       &strain,
                   const History<This, Number> &accepted,
                   History<This, Number>       &trial,
                   Response<Number>            &response) const
    {
      if constexpr (n_tensors > 0)
        response.stress =
          spring.stress(Tensor2<Number>(strain - accepted.tensors[0]));
      else
        response.stress = spring.stress(strain);
      response.region = index(Region::interior);
      trial           = accepted;
      if constexpr (request & tangent)
        response.tangent = spring.tensor<Number>();
      if constexpr (request & dissipation)
        response.dissipation = response.viscous_dissipation = Number(0.);
    }

    /** The answer of sets that change a stress by its pressure and the size of
     *  its deviator alone: all in numbers, few of them, for explicit steps. */
    template <unsigned int request, typename Number>
    DEAL_II_ALWAYS_INLINE void
    respond_radially(const Tensor2<Number>       &strain,
                     const Start<Number>         &start,
                     const History<This, Number> &accepted,
                     History<This, Number>       &trial,
                     Response<Number>            &response) const
    {
      const RadialReturn<Number> end = set.radial_return(start.pressure,
                                                         start.shear_invariant,
                                                         start.hardening,
                                                         metric);
      response.region                = end.region;
      const double inner             = 2. * to_spring.deviatoric * spring.shear;
      const Number outer =
        (2. * to_set.deviatoric * start_moduli.shear) * end.shear_scale;
      const double inner_bulk = to_spring.spherical * spring.bulk;
      const Number outer_sum  = -to_set.spherical * end.pressure;
      if constexpr (n_tensors == 0)
        response.stress =
          add_spherical(Tensor2<Number>((inner + outer) * start.deviator),
                        Number(inner_bulk * trace(strain) + outer_sum));
      else
        {
          response.stress =
            add_spherical(Tensor2<Number>(inner * deviatoric_part(strain) +
                                          outer * start.deviator),
                          Number(inner_bulk * trace(strain) + outer_sum));
          Number share = Number(1.) - end.shear_scale;
          if constexpr (memory == Memory::cylinder)
            share *= end.cylinder_share;
          trial.tensors[0] = accepted.tensors[0] + share * start.deviator;
          if constexpr (memory == Memory::all)
            trial.tensors[0] =
              add_spherical(trial.tensors[0],
                            Number((end.pressure - start.pressure) *
                                   (1. / (3. * metric.bulk))));
          if constexpr (n_scalars > 0)
            trial.scalars[0] = end.hardening;
          if constexpr (request & dissipation)
            response.dissipation = (1. / metric.shear) * share *
                                   end.shear_scale * start.shear_invariant;
          if constexpr ((request & dissipation) && memory == Memory::all)
            response.dissipation += (1. / metric.bulk) * end.pressure *
                                    (start.pressure - end.pressure);
          if constexpr ((request & dissipation) && n_scalars > 0)
            response.dissipation -= set.hardening_stress(end.hardening) *
                                    (end.hardening - start.hardening);
        }
      if constexpr (request & dissipation)
        {
          response.viscous_dissipation = Number(0.);
          if constexpr (n_tensors == 0)
            response.dissipation = Number(0.);
        }
    }

    /** The plastic part of the strain $E_c^{-1}:(t-\pi)$. */
    template <typename Number, bool with_tangent>
    DEAL_II_ALWAYS_INLINE Tensor2<Number>
                          plastic_strain(const Tensor2<Number>                  &residual,
                                         const Projection<Number, with_tangent> &projection) const
    {
      if constexpr (memory == Memory::cylinder)
        return (compliance.deviatoric * projection.cylinder_share) *
               deviatoric_part(residual);
      else
        return compliance(residual);
    }

    /** Stored energy: both springs, isotropic hardening, and the work against
     *  the cohesion of an open contact. With the dissipation, the end-of-step
     *  stress on the hinge, less what hardens it, times the slip of the step,
     *  it grows by exactly $W_n(\varepsilon_{n+1})-W_n(\varepsilon_n)$.
     *  @param projected $\pi$ */
    template <typename Number>
    void
    account(const Tensor2<Number>       &s,
            const Tensor2<Number>       &projected,
            const History<This, Number> &trial,
            Response<Number>            &response) const
    {
      const Tensor2<Number> x = metric.strain(s - projected);
      response.stored_energy =
        0.5 * spring.energy_product(response.stress, response.stress) +
        0.5 * (binder.stress(x) * x);
      response.contact_strain = Tensor2<Number>();
      response.plastic_strain = Tensor2<Number>();
      if constexpr (n_tensors > 0)
        response.plastic_strain = trial.tensors[0];
      if constexpr (n_scalars > 0)
        response.stored_energy += set.hardening_energy(trial.scalars[0]);
      if constexpr (memory != Memory::all)
        {
          response.contact_strain = x;
          if constexpr (n_tensors > 0)
            response.contact_strain -= trial.tensors[0];
          response.stored_energy +=
            set.apex_tension() * trace(response.contact_strain);
        }
    }

    Moduli           spring;
    Moduli           binder;
    Moduli           metric;
    Moduli           start_moduli; ///< see Start
    IsotropicScaling compliance;   ///< $E_c^{-1}$
    IsotropicScaling to_spring;
    IsotropicScaling to_set;
    Set              set;
  };
} // namespace Signoton::Rheology

#endif
