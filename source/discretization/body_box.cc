#include <signoton/discretization/body_box.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_tools.h>

namespace Signoton
{
  template <int dim>
  BoundingBox<dim>
  body_box(const Triangulation<dim> &mesh)
  {
    auto corners = GridTools::compute_bounding_box(mesh).get_boundary_points();
    const MPI_Comm communicator = mesh.get_communicator();
    for (unsigned int d = 0; d < dim; ++d)
      {
        corners.first[d] = Utilities::MPI::min(corners.first[d], communicator);
        corners.second[d] =
          Utilities::MPI::max(corners.second[d], communicator);
      }
    return BoundingBox<dim>(corners);
  }

  template BoundingBox<2>
  body_box<2>(const Triangulation<2> &);
  template BoundingBox<3>
  body_box<3>(const Triangulation<3> &);
} // namespace Signoton
