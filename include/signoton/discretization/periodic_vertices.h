#ifndef signoton_discretization_periodic_vertices_h
#define signoton_discretization_periodic_vertices_h

#include <deal.II/distributed/tria.h>

namespace Signoton
{
  using namespace dealii;

  /** A vertex and the same one at the opposite side of a periodic body. */
  template <int dim>
  struct PeriodicVertex
  {
    unsigned int   from, to; ///< `to` belongs to a locally owned cell
    Tensor<1, dim> shift;    ///< of places, from `from` to `to`, in m
  };

  /** Of the vertices of locally owned cells. Those that hang on one side only
   *  have no image, as a hanging vertex inside the body is no vertex of the
   *  coarse cell. */
  template <int dim>
  std::vector<PeriodicVertex<dim>>
  periodic_vertices(const parallel::distributed::Triangulation<dim> &mesh);
} // namespace Signoton

#endif
