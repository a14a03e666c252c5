#include <signoton/discretization/periodic_vertices.h>

namespace Signoton
{
  template <int dim>
  std::vector<PeriodicVertex<dim>>
  periodic_vertices(const parallel::distributed::Triangulation<dim> &mesh)
  {
    std::vector<PeriodicVertex<dim>> result;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const auto f : cell->face_indices())
          if (cell->has_periodic_neighbor(f))
            {
              // a coarser neighbor faces the parent
              const auto other = cell->periodic_neighbor(f);
              typename Triangulation<dim>::cell_iterator peer = cell;
              while (peer->level() > other->level())
                peer = peer->parent();
              const auto here = cell->face(f);
              const auto there =
                other->face(cell->periodic_neighbor_face_no(f));
              const Tensor<1, dim> shift =
                peer->face(f)->center() - there->center();
              for (const auto v : here->vertex_indices())
                for (const auto w : there->vertex_indices())
                  if ((there->vertex(w) + shift).distance(here->vertex(v)) <
                      1e-6 * here->diameter())
                    result.push_back(
                      {there->vertex_index(w), here->vertex_index(v), shift});
            }
    return result;
  }

  template std::vector<PeriodicVertex<2>>
  periodic_vertices(const parallel::distributed::Triangulation<2> &);
  template std::vector<PeriodicVertex<3>>
  periodic_vertices(const parallel::distributed::Triangulation<3> &);
} // namespace Signoton
