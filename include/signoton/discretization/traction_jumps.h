#ifndef signoton_discretization_traction_jumps_h
#define signoton_discretization_traction_jumps_h

#include <signoton/discretization/space.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  /** Numbers by material id. */
  using ByMaterial = boost::container::flat_map<types::material_id, double>;

  /**
   * Squared indicators of the locally owned cells, by active cell index: the
   * jumps of the traction over the faces, also those that are periodic, and the
   * mismatch with the given traction at the boundary, see Refinement.
   * @param stress ghosted field of in-plane stresses at the points
   * @param shear_modulus in Pa
   */
  template <int dim>
  Vector<float>
  traction_jumps(const Space<dim>              &space,
                 const PointSpace<dim>         &points,
                 const VectorType              &stress,
                 const BoundaryConditions<dim> &conditions,
                 const ByMaterial              &shear_modulus);

  /**
   * Set indicators to zero that are no larger than they would be by round-off
   * alone: of stresses, as they come out of the solver, relative to the largest
   * of the body, and of the strains, which are small differences of
   * displacements where a body has moved far. A body at rest, or under uniform
   * stress, then has no indicators.
   * @param stress, shear_modulus as in traction_jumps()
   * @param displacement ghosted
   * @param stiffness    a modulus by which strains become stresses, in Pa
   */
  template <int dim>
  void
  drop_round_off(const Space<dim> &space,
                 const VectorType &stress,
                 const VectorType &displacement,
                 const ByMaterial &shear_modulus,
                 const ByMaterial &stiffness,
                 Vector<float>    &indicators);
} // namespace Signoton

#endif
