#include "mechanics_kernel.h"

namespace Signoton
{
  namespace
  {
    template <typename Embedding>
    std::unique_ptr<Mechanics<Embedding::dim>>
    make_for_degree(const Space<Embedding::dim>           &space,
                    const std::vector<Rheology::Material> &materials)
    {
      AssertThrow(space.degree == 1 || space.degree == 2,
                  ExcMessage("The degree is 1 or 2."));
      if (space.degree == 1)
        return std::make_unique<MechanicsKernel<Embedding, 1>>(space,
                                                               materials);
      return std::make_unique<MechanicsKernel<Embedding, 2>>(space, materials);
    }
  } // namespace

  template <>
  std::unique_ptr<Mechanics<2>>
  make_mechanics<2>(const Space<2>                        &space,
                    const std::vector<Rheology::Material> &materials)
  {
    return space.axisymmetric ?
             make_for_degree<Axisymmetric>(space, materials) :
             make_for_degree<PlaneStrain>(space, materials);
  }

  template <>
  std::unique_ptr<Mechanics<3>>
  make_mechanics<3>(const Space<3>                        &space,
                    const std::vector<Rheology::Material> &materials)
  {
    return make_for_degree<Solid>(space, materials);
  }
} // namespace Signoton
