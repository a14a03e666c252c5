#include <signoton/discretization/periodic_vertices.h>
#include <signoton/discretization/refinement.h>

#include <deal.II/distributed/grid_refinement.h>
#include <deal.II/grid/grid_tools.h>

#include <optional>

namespace Signoton
{
  void
  Refinement::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Refinement");
    handler.add_parameter("Cycles in first step",
                          cycles_first,
                          "How often the first step is refined and solved "
                          "again.",
                          Patterns::Integer(0, 1000));
    handler.add_parameter("Cycles per step",
                          cycles_per_step,
                          "The same for later steps.",
                          Patterns::Integer(0, 1000));
    handler.add_parameter("Every",
                          every,
                          "Refine in every n-th of the later steps.",
                          Patterns::Integer(1));
    handler.add_parameter("Refine fraction",
                          refine_fraction,
                          "Refine the worst cells, which together make up "
                          "this part of the squared indicators.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Coarsen fraction",
                          coarsen_fraction,
                          "Coarsen the best cells, which together make up "
                          "this part.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Region weight",
                          region_weight,
                          "Factor on the squared indicator of cells where the "
                          "material switches its branch; 1: no preference.",
                          Patterns::Double(1.));
    handler.add_parameter("Maximum level",
                          maximum_level,
                          "Finest level; the coarse mesh is level 0.",
                          Patterns::Integer(0, 20));
    handler.add_parameter("Minimum level",
                          minimum_level,
                          "Coarsest level; if not given, that of the initial "
                          "refinement.",
                          Patterns::Integer(0, 20));
    handler.add_parameter(
      "Maximum unknowns",
      maximum_unknowns,
      "Fewer cells are refined, if any, where the mesh would "
      "get more unknowns than about this.",
      Patterns::Integer(1));
    handler.leave_subsection();
  }

  void
  Refinement::check(const SceneFile &file) const
  {
    if (cycles_first + cycles_per_step > 0 && minimum_level > maximum_level)
      throw UserError(file.where({"Refinement"}, "Maximum level"),
                      std::to_string(maximum_level),
                      "at least 'Minimum level', here " +
                        std::to_string(minimum_level),
                      "without 'Minimum level', it is 'Geometry / Initial "
                      "refinement'");
  }

  unsigned int
  Refinement::cycles(const unsigned int step) const
  {
    if (step == 1)
      return cycles_first;
    return (step - 1) % every == 0 ? cycles_per_step : 0;
  }

  template <int dim>
  Tensor<1, dim>
  missing_traction(const BoundaryCondition<dim> *condition,
                   const Point<dim>             &p,
                   const Tensor<1, dim>         &normal,
                   const Tensor<1, dim>         &traction)
  {
    Tensor<1, dim> missing = traction;
    if (condition == nullptr)
      return missing;
    if (condition->pressure)
      missing += condition->pressure->value(p) * normal;
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (condition->traction)
          missing[d] -= condition->traction->value(p, d);
        if (condition->displacement[d] || condition->velocity[d] ||
            condition->absorbs())
          missing[d] = 0.;
      }
    if (condition->symmetry)
      missing -= (missing * normal) * normal;
    return missing;
  }

  template <int dim>
  void
  keep_coarsenable(parallel::distributed::Triangulation<dim> &mesh,
                   const unsigned int                         minimum_level)
  {
    std::vector<int> finest(mesh.n_vertices(), 0);
    for (const auto &cell : mesh.active_cell_iterators())
      if (!cell->is_artificial())
        for (const auto v : cell->vertex_indices())
          finest[cell->vertex_index(v)] =
            std::max(finest[cell->vertex_index(v)], cell->level());
    const auto images = periodic_vertices(mesh);
    for (unsigned int d = 0; d < dim; ++d) // corners have images of images
      for (const auto &image : images)
        finest[image.to] = std::max(finest[image.to], finest[image.from]);
    for (const auto &cell : mesh.active_cell_iterators())
      {
        cell->clear_refine_flag();
        bool may_coarsen = cell->is_locally_owned() &&
                           cell->level() > static_cast<int>(minimum_level);
        for (const auto v : cell->vertex_indices())
          may_coarsen &= finest[cell->vertex_index(v)] <= cell->level();
        if (!may_coarsen)
          cell->clear_coarsen_flag();
      }
    mesh.prepare_coarsening_and_refinement();
  }

  template <int dim>
  bool
  Refinement::mark(Space<dim>                      &space,
                   Vector<float>                   &indicators,
                   const std::vector<unsigned int> &region,
                   const std::vector<bool>         &mixed) const
  {
    std::vector<unsigned int> all_regions(region);
    GridTools::exchange_cell_data_to_ghosts<unsigned int>(
      space.mesh,
      [&](const auto &cell) {
        return std::optional<unsigned int>(region[cell->active_cell_index()]);
      },
      [&](const auto &cell, const unsigned int value) {
        all_regions[cell->active_cell_index()] = value;
      });

    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int i        = cell->active_cell_index();
          bool               switches = mixed[i];
          for (const auto f : cell->face_indices())
            if (!cell->at_boundary(f) || cell->has_periodic_neighbor(f))
              if (const auto other = cell->neighbor_or_periodic_neighbor(f);
                  other->is_active())
                switches |=
                  all_regions[other->active_cell_index()] != region[i];
          if (switches)
            indicators[i] *= region_weight;
          // Half percent steps: cells that are equal by symmetry stay equal.
          if (indicators[i] > 0.f)
            indicators[i] =
              std::exp(std::round(200. * std::log(indicators[i])) / 200.);
        }

    const float largest =
      Utilities::MPI::max(indicators.linfty_norm(), space.communicator);
    if (!(largest > 0.f))
      return false;
    // the search for thresholds is by powers, for which zero is too small
    const float nothing = 1e-20f * largest;
    for (float &value : indicators)
      value = std::max(value, nothing);

    using namespace parallel::distributed::GridRefinement;
    const auto owned_cells_with = [&](const auto &property) {
      double sum = 0.;
      for (const auto &cell : space.mesh.active_cell_iterators())
        if (cell->is_locally_owned() && property(cell))
          sum += 1.;
      return Utilities::MPI::sum(sum, space.communicator);
    };

    // Coarsening first: what it frees can be refined elsewhere.
    refine_and_coarsen_fixed_fraction(space.mesh,
                                      indicators,
                                      0.,
                                      coarsen_fraction,
                                      VectorTools::NormType::L1_norm);
    keep_coarsenable(space.mesh, minimum_level);
    const double coarsened = owned_cells_with(
      [](const auto &cell) { return cell->coarsen_flag_set(); });
    std::vector<bool> coarsen;
    space.mesh.save_coarsen_flags(coarsen);

    // Cells that cannot be refined do not count among those that should: at a
    // singularity they would soon be the whole fraction.
    const auto is_finest = [&](const auto &cell) {
      return cell->level() >= static_cast<int>(maximum_level);
    };
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned() && is_finest(cell))
        indicators[cell->active_cell_index()] = 0.;
    const double cells    = space.mesh.n_global_active_cells();
    const double children = 1 << dim;
    double       refined  = 0.;
    for (double fraction = refine_fraction; true; fraction *= 0.9)
      {
        for (const auto &cell : space.mesh.active_cell_iterators())
          cell->clear_refine_flag();
        refined = 0.;
        if (fraction <= 0.01 * refine_fraction)
          break;
        refine_and_coarsen_fixed_fraction(
          space.mesh, indicators, fraction, 0., VectorTools::NormType::L1_norm);
        for (const auto &cell : space.mesh.active_cell_iterators())
          if (!(indicators[cell->active_cell_index()] > nothing))
            cell->clear_refine_flag();
        refined = owned_cells_with(
          [](const auto &cell) { return cell->refine_flag_set(); });
        const double cells_after =
          cells + (children - 1.) * refined - (1. - 1. / children) * coarsened;
        if (space.dof_handler.n_dofs() * cells_after / cells <=
            maximum_unknowns)
          break;
      }
    space.mesh.load_coarsen_flags(coarsen);
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->refine_flag_set())
        cell->clear_coarsen_flag();
    // To coarsen alone, and solve again, should be worth it.
    return refined > 0. || coarsened > 0.01 * cells;
  }

#define INSTANTIATE(dim)                                                           \
  template bool           Refinement::mark<dim>(Space<dim> &,                      \
                                      Vector<float> &,                   \
                                      const std::vector<unsigned int> &, \
                                      const std::vector<bool> &) const;  \
  template Tensor<1, dim> missing_traction<dim>(                                   \
    const BoundaryCondition<dim> *,                                                \
    const Point<dim> &,                                                            \
    const Tensor<1, dim> &,                                                        \
    const Tensor<1, dim> &);                                                       \
  template void keep_coarsenable<dim>(                                             \
    parallel::distributed::Triangulation<dim> &, const unsigned int);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
