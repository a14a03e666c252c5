#include <signoton/discretization/refinement.h>
#include <signoton/discretization/wave_refinement.h>

#include <deal.II/grid/grid_tools.h>

namespace Signoton
{
  void
  WaveRefinement::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Refinement");
    handler.add_parameter(
      "Follow waves",
      follow,
      "Refine at fronts and ahead of them, coarsen behind.");
    handler.add_parameter(
      "Every",
      every,
      "Look at the mesh every n-th step; ahead of fronts it "
      "is fine as far as waves go until then.",
      Patterns::Integer(1));
    handler.add_parameter("Refine threshold",
                          refine_threshold,
                          "Refine cells to whose neighbors the traction jumps "
                          "by more than this part of the largest jump so "
                          "far.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Coarsen threshold",
                          coarsen_threshold,
                          "Coarsen cells with jumps below this part.",
                          Patterns::Double(0., 1.));
    handler.add_parameter("Maximum level",
                          maximum_level,
                          "Finest level; the coarse mesh is level 0.",
                          Patterns::Integer(0, 20));
    handler.add_parameter("Minimum level",
                          minimum_level,
                          "Coarsest level; if not given, that of the initial "
                          "refinement.",
                          Patterns::Integer(0, 20));
    handler.add_parameter("Maximum unknowns",
                          maximum_unknowns,
                          "The refinement threshold rises where the mesh would "
                          "get more unknowns than about this.",
                          Patterns::Integer(1));
    handler.leave_subsection();
  }

  void
  WaveRefinement::check(const SceneFile &file) const
  {
    if (follow && minimum_level >= maximum_level)
      throw UserError(file.where({"Refinement"}, "Maximum level"),
                      std::to_string(maximum_level),
                      "more than 'Minimum level', here " +
                        std::to_string(minimum_level),
                      "without 'Minimum level', it is 'Geometry / Initial "
                      "refinement'");
    if (follow && coarsen_threshold > 0.5 * refine_threshold)
      throw UserError(file.where({"Refinement"}, "Coarsen threshold"),
                      file.value({"Refinement"}, "Coarsen threshold", "0.02"),
                      "at most half of 'Refine threshold', here " +
                        file.value({"Refinement"}, "Refine threshold", "0.1"),
                      "or cells are coarsened and refined in turns");
  }

  template <int dim>
  double
  WaveRefinement::finest_part(const Space<dim> &space) const
  {
    const int missing = static_cast<int>(maximum_level) -
                        (static_cast<int>(space.mesh.n_global_levels()) - 1);
    return follow && missing > 0 ? std::ldexp(1., -missing) : 1.;
  }

  namespace
  {
    /**
     * How far it still is to go, for cells that are within @p distance of the
     * marked ones; negative for others. By way of centers and vertices of
     * cells, on any number of ranks.
     */
    template <int dim>
    std::vector<double>
    reach(const parallel::distributed::Triangulation<dim> &mesh,
          const std::vector<bool>                         &marked,
          const double                                     distance)
    {
      std::vector<double> of_cell(mesh.n_active_cells(), -1.);
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned() && marked[cell->active_cell_index()])
          of_cell[cell->active_cell_index()] =
            distance + 0.5 * cell->diameter();
      std::vector<double> of_vertex(mesh.n_vertices());
      for (bool changes = true; changes;)
        {
          GridTools::exchange_cell_data_to_ghosts<double>(
            mesh,
            [&](const auto &cell) {
              return std_cxx17::optional<double>(
                of_cell[cell->active_cell_index()]);
            },
            [&](const auto &cell, const double value) {
              of_cell[cell->active_cell_index()] = value;
            });
          std::fill(of_vertex.begin(), of_vertex.end(), -1.);
          for (const auto &cell : mesh.active_cell_iterators())
            if (!cell->is_artificial())
              for (const auto v : cell->vertex_indices())
                {
                  double &value = of_vertex[cell->vertex_index(v)];
                  value         = std::max(value,
                                   of_cell[cell->active_cell_index()] -
                                     cell->center().distance(cell->vertex(v)));
                }
          bool own = false;
          for (const auto &cell : mesh.active_cell_iterators())
            if (cell->is_locally_owned())
              {
                double &value = of_cell[cell->active_cell_index()];
                for (const auto v : cell->vertex_indices())
                  {
                    const double from = of_vertex[cell->vertex_index(v)];
                    if (from < 0.)
                      continue;
                    // a cell that a wave enters is reached, however large
                    const double now =
                      std::max(0.,
                               from - cell->center().distance(cell->vertex(v)));
                    if (now > value + 1e-9 * distance)
                      {
                        value = now;
                        own   = true;
                      }
                  }
              }
          changes =
            Utilities::MPI::max(own ? 1U : 0U, mesh.get_communicator()) > 0;
        }
      return of_cell;
    }
  } // namespace

  template <int dim>
  bool
  WaveRefinement::mark(Space<dim>          &space,
                       const Vector<float> &indicators,
                       const double         distance,
                       double              &largest) const
  {
    auto &mesh = space.mesh;
    // jumps themselves, whatever the size of the cell
    std::vector<double> jump(mesh.n_active_cells(), 0.);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int i = cell->active_cell_index();
          jump[i] = std::sqrt(indicators[i] / std::pow(cell->diameter(), dim));
          // half percent steps: equal on any number of ranks
          if (jump[i] > 0.)
            jump[i] = std::exp(std::round(200. * std::log(jump[i])) / 200.);
          largest = std::max(largest, jump[i]);
        }
    largest = Utilities::MPI::max(largest, space.communicator);
    if (!(largest > 0.))
      return false;

    double threshold = refine_threshold;
    double n_refined = 0., n_coarsened = 0.;
    while (true)
      {
        std::vector<bool> marked(jump.size());
        for (unsigned int i = 0; i < jump.size(); ++i)
          marked[i] = jump[i] >= threshold * largest;
        const std::vector<double> to_go = reach(mesh, marked, distance);
        for (const auto &cell : mesh.active_cell_iterators())
          {
            cell->clear_refine_flag();
            cell->clear_coarsen_flag();
          }
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              to_go[cell->active_cell_index()] < 0. &&
              jump[cell->active_cell_index()] < coarsen_threshold * largest)
            cell->set_coarsen_flag();
        keep_coarsenable(mesh, minimum_level);
        n_refined = n_coarsened = 0.;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              n_coarsened += cell->coarsen_flag_set() ? 1. : 0.;
              if (to_go[cell->active_cell_index()] >= 0. &&
                  cell->level() < static_cast<int>(maximum_level))
                {
                  cell->set_refine_flag();
                  n_refined += 1.;
                }
            }
        n_refined   = Utilities::MPI::sum(n_refined, space.communicator);
        n_coarsened = Utilities::MPI::sum(n_coarsened, space.communicator);
        const double cells    = mesh.n_global_active_cells();
        const double children = 1 << dim;
        const double after    = cells + (children - 1.) * n_refined -
                             (1. - 1. / children) * n_coarsened;
        if (n_refined < 1. ||
            space.dof_handler.n_dofs() * after / cells <= maximum_unknowns)
          break;
        threshold *= 1.3;
        if (threshold > 1.)
          {
            for (const auto &cell : mesh.active_cell_iterators())
              cell->clear_refine_flag();
            n_refined = 0.;
            break;
          }
      }
    return n_refined + n_coarsened > 0.;
  }

#define INSTANTIATE(dim)                                                      \
  template double WaveRefinement::finest_part<dim>(const Space<dim> &) const; \
  template bool   WaveRefinement::mark<dim>(Space<dim> &,                     \
                                          const Vector<float> &,            \
                                          const double,                     \
                                          double &) const;

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
