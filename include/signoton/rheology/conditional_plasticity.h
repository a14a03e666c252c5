#ifndef signoton_rheology_conditional_plasticity_h
#define signoton_rheology_conditional_plasticity_h

#include <signoton/rheology/spring_and_projection.h>
#include <signoton/tensors/lanes.h>

namespace Signoton::Rheology
{
  /**
   * A plastic spring whose stress the contact sees second: the *conditional*
   * stress $s=E:(\varepsilon-\varepsilon^p)$, which the medium would have with
   * its pores closed, is confined to the yield set $F$, and the contact with
   * its binder answers the elastic strain $a:s$,
   * $$ (\tilde s-s):(a:\dot s-\dot\varepsilon)\ge 0\quad\forall\tilde s\in F,
   *    \qquad \sigma=\lambda s+(1-\lambda)\pi_K(s). $$
   * In the exact series scheme, SpringAndProjection with Memory::cylinder, the
   * hinge carries the stress $\sigma$ itself. The two agree as long as $s$ is
   * in the cone; here, loosened material that is sheared yields, and remembers
   * it. The equations of waves are well-posed in this form: a variational
   * inequality of hyperbolic type (Sadovskaya and Sadovskii 2012, Chapter 6).
   *
   * By implicit Euler, $s_{n+1}=\pi_F(E:(\varepsilon_{n+1}-\varepsilon^p_n))$.
   * There is no incremental potential, and $T=T_K:a:T_F$ is not symmetric.
   */
  template <typename YieldSet, typename Cone>
  class ConditionalPlasticity
  {
  public:
    using Hinge   = SpringAndProjection<YieldSet, Memory::all>;
    using Contact = SpringAndProjection<Cone, Memory::none>;
    using This    = ConditionalPlasticity<YieldSet, Cone>;

    static constexpr unsigned int n_tensors     = Hinge::n_tensors;
    static constexpr unsigned int n_scalars     = Hinge::n_scalars;
    static constexpr bool         has_potential = false;

    /** @param binder moduli of the spring in parallel with the contact */
    ConditionalPlasticity(const Moduli   &spring,
                          const Moduli   &binder,
                          const YieldSet &yield_set,
                          const Cone     &cone)
      : hinge(spring, {0., 0.}, yield_set)
      , contact(spring, binder, cone)
    {}

    /** The region is that of the contact, or of the yield set where the contact
     *  is closed, or Region::corner where both give way. Instead of a potential
     *  there is the stored energy. */
    template <unsigned int request, typename Number>
    bool
    update(const Tensor2<Number>       &strain,
           const History<This, Number> &accepted,
           History<This, Number>       &trial,
           Response<Number>            &response) const
    {
      const History<Hinge, Number> before{accepted.tensors, accepted.scalars};
      History<Hinge, Number>       after;
      Response<Number>             plastic;
      const bool yields = hinge.template update<request &(tangent | energies)>(
        strain, before, after, plastic);
      trial.tensors = after.tensors;
      trial.scalars = after.scalars;

      constexpr unsigned int wanted =
        request & potential ? request | energies : request;
      const Moduli                  &spring = hinge.elasticity();
      const History<Contact, Number> none{};
      History<Contact, Number>       unused;
      contact.template update<wanted>(spring.strain(plastic.stress),
                                      none,
                                      unused,
                                      response);
      const Number half(0.5);
      response.region =
        select_if_less(response.region,
                       half,
                       plastic.region,
                       select_if_less(plastic.region,
                                      half,
                                      response.region,
                                      Number(index(Region::corner))));
      if constexpr (request & tangent)
        response.tangent =
          response.tangent * compliance_times<Number>(spring, plastic.tangent);
      if constexpr (request & potential)
        response.potential = response.stored_energy;
      if constexpr (request & energies)
        response.plastic_strain = plastic.plastic_strain;
      if constexpr (request & (energies | dissipation))
        response.dissipation =
          response.stress * (trial.tensors[0] - accepted.tensors[0]);
      return yields;
    }

    const Moduli &
    elasticity() const
    {
      return hinge.elasticity();
    }

  private:
    /** $a:T$ with the compliance $a$ of the spring. */
    template <typename Number>
    static Tensor4<Number>
    compliance_times(const Moduli &spring, const Tensor4<Number> &tangent)
    {
      const auto            I      = unit_symmetric_tensor<3, Number>();
      const Tensor2<Number> traces = I * tangent;
      return (0.5 / spring.shear) * tangent +
             (1. / (9. * spring.bulk) - 1. / (6. * spring.shear)) *
               tensor_product(I, traces);
    }

    Hinge   hinge;
    Contact contact;
  };
} // namespace Signoton::Rheology

#endif
