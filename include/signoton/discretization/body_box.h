#ifndef signoton_discretization_body_box_h
#define signoton_discretization_body_box_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/tria.h>

namespace Signoton
{
  using namespace dealii;

  /** The smallest box along the axes around the mesh of all ranks, in m.
   *  Collective. */
  template <int dim>
  BoundingBox<dim>
  body_box(const Triangulation<dim> &mesh);
} // namespace Signoton

#endif
