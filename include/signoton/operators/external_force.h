#ifndef signoton_operators_external_force_h
#define signoton_operators_external_force_h

#include <signoton/discretization/space.h>
#include <signoton/rheology/material.h>

namespace Signoton
{
  /**
   * The work of all loads on a virtual displacement,
   * $L(v)=\int\rho g\cdot v + \int_\Gamma (t-qn)\cdot v$, as a vector. Loads
   * are those of the time last set; they do not follow the deformation.
   * @param gravity acceleration in m/s^2, or nullptr for none
   * @param constraints space.constraints for a right hand side,
   *   space.mesh_constraints to keep the entries of prescribed unknowns
   */
  template <int dim>
  void
  external_force(const Space<dim>                      &space,
                 const BoundaryConditions<dim>         &conditions,
                 const std::vector<Rheology::Material> &materials,
                 const Function<dim>                   *gravity,
                 const AffineConstraints<double>       &constraints,
                 VectorType                            &force);
} // namespace Signoton

#endif
