#ifndef signoton_rheology_laws_h
#define signoton_rheology_laws_h

#include <signoton/rheology/conditional_plasticity.h>
#include <signoton/rheology/general.h>

#include <variant>

namespace Signoton::Rheology
{
  /** Every law: those with a closed form, and the general one. The choice is
   *  made once for a run of cells, never inside the loop over their points. */
  using Law = std::variant<
    Elastic,
    SpringAndProjection<MisesSchleicherCone, Memory::none>,
    SpringAndProjection<PrincipalSet, Memory::none>,
    SpringAndProjection<MisesSchleicherCone, Memory::cylinder>,
    SpringAndProjection<VonMisesCylinder<false>, Memory::all>,
    SpringAndProjection<VonMisesCylinder<true>, Memory::all>,
    SpringAndProjection<MisesSchleicherCone, Memory::all>,
    SpringAndProjection<PrincipalSet, Memory::all>,
    ConditionalPlasticity<VonMisesCylinder<false>, MisesSchleicherCone>,
    ConditionalPlasticity<VonMisesCylinder<false>, PrincipalSet>,
    General>;

  /** Whether the stress of a step is the derivative of a potential. */
  inline bool
  has_potential(const Law &law)
  {
    return std::visit(
      [](const auto &l) { return std::decay_t<decltype(l)>::has_potential; },
      law);
  }

  /** Strains, as tensors, that a point of a law remembers. */
  template <typename Law>
  unsigned int
  n_tensors(const Law &law)
  {
    if constexpr (std::is_same_v<Law, General>)
      return law.n_tensors();
    else
      return Law::n_tensors;
  }

  /** Numbers, besides, that a point of a law remembers. */
  template <typename Law>
  unsigned int
  n_scalars(const Law &law)
  {
    if constexpr (std::is_same_v<Law, General>)
      return law.n_scalars();
    else
      return Law::n_scalars;
  }

  /** A history of zeros. */
  template <typename Number, typename Law>
  History<Law, Number>
  make_history(const Law &law)
  {
    History<Law, Number> result{};
    if constexpr (std::is_same_v<Law, General>)
      {
        result.tensors.resize(law.n_tensors());
        result.scalars.resize(law.n_scalars(), Number(0.));
      }
    return result;
  }
} // namespace Signoton::Rheology

#endif
