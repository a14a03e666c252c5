#ifndef signoton_rheology_law_h
#define signoton_rheology_law_h

#include <signoton/rheology/projection.h>

#include <array>

namespace Signoton::Rheology
{
  /** What a caller wants of a material point; nothing else is computed. */
  enum Request : unsigned int
  {
    stress      = 0, ///< always delivered
    potential   = 1, ///< the incremental potential, for line searches
    tangent     = 2, ///< the consistent tangent
    energies    = 4, ///< stored and dissipated energy and internal strains
    dissipation = 8, ///< dissipated energy alone; energies include it
    all         = 7
  };

  /** What a law delivers at a point; members not requested stay untouched. */
  template <typename Number>
  struct Response
  {
    Tensor2<Number> stress;              ///< $\sigma_{n+1}$ in Pa
    Tensor4<Number> tangent;             ///< $d\sigma_{n+1}/d\varepsilon_{n+1}$
    Number          region;              ///< see Region
    Number          potential;           ///< $W_n(\varepsilon)$ in J/m^3
    Number          stored_energy;       ///< in J/m^3
    Number          dissipation;         ///< of the step, in J/m^3
    Number          viscous_dissipation; ///< the part of it in dampers
    Tensor2<Number> contact_strain;      ///< strain of the rigid contact
    Tensor2<Number> plastic_strain;      ///< strain of the plastic hinge
    /** The relative residual, the largest of all lanes, at which a local solver
     *  has given up, with its lane; zero if all is well. Closed forms do not
     *  fail, and leave it. */
    double       failure     = 0.;
    unsigned int failed_lane = 0;
  };

  /** History of a law with `n_tensors` tensors and `n_scalars` scalars. */
  template <typename Law, typename Number>
  struct History
  {
    std::array<Tensor2<Number>, Law::n_tensors> tensors;
    std::array<Number, Law::n_scalars>          scalars;
  };

  /** The isotropic spring, $\sigma=E:\varepsilon$. */
  class Elastic
  {
  public:
    static constexpr unsigned int n_tensors = 0, n_scalars = 0;
    /** Whether the stress of a step is the derivative of a potential, so that
     *  the tangent is symmetric. */
    static constexpr bool has_potential = true;

    explicit Elastic(const Moduli &spring)
      : spring(spring)
    {}

    /** One step of a material point. Returns false if the history stays as
     *  accepted for sure; so do the other laws. */
    template <unsigned int request, typename Number>
    DEAL_II_ALWAYS_INLINE bool
    update(const Tensor2<Number> &strain,
           const History<Elastic, Number> &,
           History<Elastic, Number> &,
           Response<Number> &response) const
    {
      response.stress = spring.stress(strain);
      response.region = index(Region::interior);
      if constexpr (request & tangent)
        response.tangent = spring.tensor<Number>();
      if constexpr (request & potential)
        response.potential = 0.5 * (response.stress * strain);
      if constexpr (request & energies)
        {
          response.stored_energy  = 0.5 * (response.stress * strain);
          response.contact_strain = Tensor2<Number>();
          response.plastic_strain = Tensor2<Number>();
        }
      if constexpr (request & (energies | dissipation))
        response.dissipation = response.viscous_dissipation = Number(0.);
      return false;
    }

    const Moduli &
    elasticity() const
    {
      return spring;
    }

  private:
    Moduli spring;
  };
} // namespace Signoton::Rheology

#endif
