// A mesh that has all the unknowns it may have follows what moves: it coarsens
// behind and refines ahead, on any number of ranks.

#include <signoton/base/mpi_session.h>
#include <signoton/discretization/refinement.h>

#include <deal.II/grid/grid_generator.h>

#include <fstream>

using namespace Signoton;

namespace
{
  template <int dim>
  void
  follow(std::ostream &out, const double maximum_unknowns)
  {
    Space<dim> space(MPI_COMM_WORLD, 1, false);
    GridGenerator::hyper_cube(space.mesh);
    space.mesh.refine_global(2);
    space.distribute_dofs();

    ParameterHandler handler;
    Refinement       refinement;
    refinement.add_parameters(handler);
    handler.parse_input_from_string(
      "subsection Refinement\n"
      "  set Maximum level    = 6\n"
      "  set Minimum level    = 2\n"
      "  set Maximum unknowns = " +
      std::to_string(static_cast<int>(maximum_unknowns)) + "\nend\n");

    bool         is_fine_there = true, stays_below = true;
    unsigned int meshes = 0, cells = 0;
    for (double x = 0.1; x < 0.95; x += 0.1)
      {
        Point<dim> peak;
        for (unsigned int d = 0; d < dim; ++d)
          peak[d] = x;
        for (unsigned int cycle = 0; cycle < 6; ++cycle)
          {
            const unsigned int n = space.mesh.n_active_cells();
            Vector<float>      indicators(n);
            for (const auto &cell : space.mesh.active_cell_iterators())
              if (cell->is_locally_owned())
                {
                  const double h = cell->diameter();
                  indicators[cell->active_cell_index()] =
                    std::pow(h, dim + 2) /
                    std::pow(h + cell->center().distance(peak), 4);
                }
            if (!refinement.mark(space,
                                 indicators,
                                 std::vector<unsigned int>(n),
                                 std::vector<bool>(n)))
              break;
            space.mesh.execute_coarsening_and_refinement();
            space.distribute_dofs();
            ++meshes;
            cells += space.mesh.n_global_active_cells();
            stays_below &= space.dof_handler.n_dofs() < 1.2 * maximum_unknowns;
          }
        double level = 0.;
        for (const auto &cell : space.mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              cell->center().distance(peak) < cell->diameter())
            level = std::max<double>(level, cell->level());
        is_fine_there &= Utilities::MPI::max(level, MPI_COMM_WORLD) >= 6.;
      }
    out << dim << "D: finest at the peak: " << (is_fine_there ? "yes" : "no")
        << ", below the maximum: " << (stays_below ? "yes" : "no") << ", "
        << meshes << " meshes of " << cells << " cells together" << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession    mpi(argc, argv);
  std::ofstream out;
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    out.open("output");
  follow<2>(out, 1200.);
  follow<3>(out, 9000.);
}
