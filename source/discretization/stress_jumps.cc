#include <signoton/discretization/refinement.h>
#include <signoton/discretization/stress_jumps.h>

#include <deal.II/grid/grid_tools.h>

#include <optional>

namespace Signoton
{
  template <int dim>
  StressJumps<dim>::StressJumps(
    const Space<dim>                           &space,
    const std::vector<SymmetricTensor<2, dim>> &mean_stress,
    const Function<dim>                        *initial_stress,
    const boost::container::flat_map<types::material_id, double> &shear_modulus,
    const double                                                  round_off)
    : values(mean_stress.size(), 0.)
    , space(space)
    , initial_stress(initial_stress)
    , shear_modulus(shear_modulus)
    , round_off(round_off)
    , stress(mean_stress)
  {
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        stress[cell->active_cell_index()] -= initial(cell->center());
    GridTools::exchange_cell_data_to_ghosts<SymmetricTensor<2, dim>>(
      space.mesh,
      [&](const auto &cell) {
        return std::optional<SymmetricTensor<2, dim>>(
          stress[cell->active_cell_index()]);
      },
      [&](const auto &cell, const SymmetricTensor<2, dim> &value) {
        stress[cell->active_cell_index()] = value;
      });
  }

  template <int dim>
  SymmetricTensor<2, dim>
  StressJumps<dim>::initial(const Point<dim> &p) const
  {
    SymmetricTensor<2, dim> result;
    if (initial_stress != nullptr)
      for (unsigned int c = 0; c < result.n_independent_components; ++c)
        result.access_raw_entry(c) =
          initial_stress->value(p, dim == 2 && c == 2 ? 3 : c);
    return result;
  }

  template <int dim>
  Tensor<1, dim>
  StressJumps<dim>::normal(const Cell &cell, const unsigned int f)
  {
    const auto     face = cell->face(f);
    Tensor<1, dim> n;
    if constexpr (dim == 2)
      n = cross_product_2d(face->vertex(1) - face->vertex(0));
    else
      n = cross_product_3d(face->vertex(3) - face->vertex(0),
                           face->vertex(2) - face->vertex(1));
    const bool is_outward = n * (face->center() - cell->center()) > 0.;
    return (is_outward ? 1. : -1.) / n.norm() * n;
  }

  template <int dim>
  void
  StressJumps<dim>::enter(const Cell &cell, const Tensor<1, dim> &traction)
  {
    if (traction.norm() <= round_off)
      return;
    double &value = values[cell->active_cell_index()];
    value         = std::max(value,
                     traction.norm() /
                       std::sqrt(shear_modulus.at(cell->material_id())));
  }

  template <int dim>
  void
  StressJumps<dim>::add_neighbors()
  {
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          {
            const auto look_at = [&](const Cell &other) {
              enter(cell,
                    (stress[other->active_cell_index()] -
                     stress[cell->active_cell_index()]) *
                      normal(cell, f));
            };
            if (cell->has_periodic_neighbor(f))
              {
                if (cell->periodic_neighbor(f)->is_active())
                  look_at(cell->periodic_neighbor(f));
                else
                  for (unsigned int s = 0;
                       s < GeometryInfo<dim>::max_children_per_face;
                       ++s)
                    look_at(cell->periodic_neighbor_child_on_subface(f, s));
              }
            else if (cell->at_boundary(f))
              continue;
            else if (cell->face(f)->has_children())
              for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
                look_at(cell->neighbor_child_on_subface(f, s));
            else
              look_at(cell->neighbor(f));
          }
  }

  template <int dim>
  void
  StressJumps<dim>::add_boundary(const BoundaryConditions<dim> &conditions)
  {
    boost::container::flat_map<types::boundary_id,
                               const BoundaryCondition<dim> *>
      condition_of;
    for (const auto &condition : conditions)
      condition_of[condition.id] = &condition;
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const auto f : cell->face_indices())
          if (cell->at_boundary(f) && !cell->has_periodic_neighbor(f))
            {
              const auto           face = cell->face(f);
              const Tensor<1, dim> n    = normal(cell, f);
              const auto found = condition_of.find(face->boundary_id());
              enter(cell,
                    missing_traction(found == condition_of.end() ?
                                       nullptr :
                                       found->second,
                                     face->center(),
                                     n,
                                     (stress[cell->active_cell_index()] +
                                      initial(face->center())) *
                                       n));
            }
  }

  template class StressJumps<2>;
  template class StressJumps<3>;
} // namespace Signoton
