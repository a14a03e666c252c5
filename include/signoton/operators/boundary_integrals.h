#ifndef signoton_operators_boundary_integrals_h
#define signoton_operators_boundary_integrals_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /** Lengths in m in plane strain, or areas in m^2, swept around the axis in
   *  axisymmetry, by boundary ids. */
  template <int dim>
  std::map<types::boundary_id, double>
  boundary_sizes(const Space<dim> &space);

  /** Integrals over a part of the boundary in N (per metre in plane strain). */
  struct LoadOnSupport
  {
    double all;  ///< magnitude of traction and pressure
    double held; ///< of their part in directions that the same section holds
  };

  /** What of the load of a section goes straight into its support, at the time
   *  last set. */
  template <int dim>
  LoadOnSupport
  load_on_support(const Space<dim>             &space,
                  const BoundaryCondition<dim> &condition);
} // namespace Signoton

#endif
