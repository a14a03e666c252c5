#ifndef signoton_drivers_point_quantities_h
#define signoton_drivers_point_quantities_h

#include <signoton/operators/mechanics.h>

#include <functional>

namespace Signoton
{
  /** A number that is told of a point, such as `stress xx`. */
  struct PointQuantity
  {
    std::string                               name;
    std::function<double(const PointState &)> value;
  };

  /** The numbers that quantities consist of, one after the other. Quantities
   *  are stress, strain, contact strain, plastic strain, principal stress (the
   *  largest first, positive in tension), pressure, shear intensity, energy
   *  density and region; others are passed over.
   *  @param dim of the mesh: in 2D tensors have no entries xz and yz */
  std::vector<PointQuantity>
  point_quantities(const std::vector<std::string> &wanted,
                   const unsigned int              dim);
} // namespace Signoton

#endif
