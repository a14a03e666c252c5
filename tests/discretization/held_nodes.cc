// Conditions of nodes where boundaries meet: all planes of re-entrant edges,
// also with hanging nodes; one normal on smooth surfaces, curved or of facets,
// against which a body of revolution turns freely; components and slopes; the
// first of two contradicting values. The same on any number of ranks and in
// any order of the sections.

#include <signoton/discretization/rigid_motions.h>
#include <signoton/discretization/space.h>

#include <deal.II/grid/grid_generator.h>

#include <fstream>

using namespace Signoton;

namespace
{
  std::ofstream output;

  void
  verdict(const std::string &what, const bool good)
  {
    output << what << ": "
           << (Utilities::MPI::min(good ? 1 : 0, MPI_COMM_WORLD) == 1 ?
                 "ok" :
                 "FAILED")
           << std::endl;
  }

  template <int dim>
  void
  add(BoundaryConditions<dim>        &conditions,
      const types::boundary_id        id,
      const std::vector<std::string> &displacement = {})
  {
    conditions.emplace_back("section " + std::to_string(id));
    auto &condition    = conditions.back();
    condition.id       = id;
    condition.symmetry = displacement.empty();
    for (unsigned int d = 0; d < displacement.size(); ++d)
      if (!displacement[d].empty())
        condition.displacement[d] =
          make_function<dim>({displacement[d]}, Constants(), "test");
  }

  /** Refine the cells around a point, twice. */
  template <int dim>
  void
  refine_around(Space<dim> &space, const Point<dim> &p, const double radius)
  {
    for (unsigned int cycle = 0; cycle < 2; ++cycle)
      {
        for (const auto &cell : space.mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              cell->center().distance(p) < radius / (1. + cycle))
            cell->set_refine_flag();
        space.mesh.execute_coarsening_and_refinement();
      }
  }

  /** Whether the constraints give every node what its conditions want. */
  template <int dim>
  bool
  holds(const Space<dim> &space, const BoundaryConditions<dim> &conditions)
  {
    VectorType u = space.make_relevant_vector();
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      u.local_element(i) = std::sin(1. + 3. * i);
    space.constraints.distribute(u);
    u.update_ghost_values();
    bool good = true;
    for (const auto &node : space.held.nodes())
      for (const auto &condition : node.held)
        {
          double v = 0.;
          for (unsigned int d = 0; d < dim; ++d)
            v += condition.direction[d] * u(node.dofs[d]);
          const auto *function = condition.displacement(conditions);
          good &=
            std::abs(v - (function != nullptr ? function->value(node.point) :
                                                0.)) < 1e-12;
        }
    return good;
  }

  /** Own nodes by the number of their directions. */
  template <int dim>
  std::array<unsigned int, dim + 1>
  count(const Space<dim> &space)
  {
    std::array<unsigned int, dim + 1> n{};
    for (const auto &node : space.held.nodes())
      if (space.dof_handler.locally_owned_dofs().is_element(node.dofs[0]))
        ++n[node.held.size()];
    for (auto &number : n)
      number = Utilities::MPI::sum(number, MPI_COMM_WORLD);
    return n;
  }

  /** Three, or two, planes that meet at re-entrant edges. */
  template <int dim>
  void
  reentrant(const unsigned int degree)
  {
    Space<dim> space(MPI_COMM_WORLD, degree, false);
    GridGenerator::hyper_L(space.mesh, -1., 1., false);
    for (const auto &cell : space.mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          for (unsigned int d = 0; d < dim; ++d)
            if (std::abs(face->center()[d]) < 1e-3)
              face->set_boundary_id(1 + d);
    space.mesh.refine_global(1);
    refine_around(space, Point<dim>(), 0.8);
    bool good = true;
    for (const bool reversed : {false, true})
      {
        BoundaryConditions<dim> conditions;
        for (unsigned int d = 0; d < dim; ++d)
          add<dim>(conditions, 1 + (reversed ? dim - 1 - d : d));
        space.distribute_dofs();
        space.update_constraints(conditions);
        good &= holds(space, conditions);
        // by position: a plane of the edge ends at the edge
        for (const auto &node : space.held.nodes())
          for (unsigned int d = 0; d < dim; ++d)
            {
              bool on_plane = std::abs(node.point[d]) < 1e-12;
              for (unsigned int e = 0; e < dim; ++e)
                on_plane &= node.point[e] > -1e-12;
              good &=
                std::abs(node.projector[d][d] - (on_plane ? 0. : 1.)) < 1e-12;
            }
      }
    std::ostringstream name;
    name << "re-entrant in " << dim << "D, degree " << degree << ", nodes";
    for (const auto n : count(space))
      name << ' ' << n;
    verdict(name.str(), good);
  }

  template <int dim>
  void
  make_ring(Space<dim> &space, const bool facets)
  {
    if constexpr (dim == 2)
      GridGenerator::hyper_shell(
        space.mesh, Point<dim>(), 1., 2., facets ? 16 : 5, true);
    else if (facets)
      {
        Triangulation<2> plane;
        GridGenerator::hyper_shell(plane, Point<2>(), 1., 2., 16, true);
        Triangulation<3> body;
        GridGenerator::extrude_triangulation(plane, 3, 1., body);
        for (const auto &cell : body.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              {
                bool outer = true;
                for (const auto v : face->vertex_indices())
                  outer &=
                    std::hypot(face->vertex(v)[0], face->vertex(v)[1]) > 1.9;
                const double z = face->center()[2];
                face->set_boundary_id(std::abs(z - 0.5) > 0.4 ? 5 :
                                      outer                   ? 1 :
                                                                0);
              }
        body.reset_all_manifolds();
        body.set_all_manifold_ids(numbers::flat_manifold_id);
        space.mesh.copy_triangulation(body);
      }
    else
      GridGenerator::hyper_shell(space.mesh, Point<dim>(), 1., 2., 6, true);
    if (facets && dim == 2)
      {
        space.mesh.reset_all_manifolds();
        space.mesh.set_all_manifold_ids(numbers::flat_manifold_id);
      }
  }

  /** The support around a ring or shell does not hold its rotation. */
  template <int dim>
  void
  ring(const unsigned int degree, const bool facets)
  {
    Space<dim> space(MPI_COMM_WORLD, degree, false);
    make_ring(space, facets);
    space.mesh.refine_global(1);
    if (facets)
      {
        Point<dim> somewhere;
        somewhere[1] = 2.;
        refine_around(space, somewhere, 1.5);
      }
    BoundaryConditions<dim> conditions;
    add<dim>(conditions, 1);
    space.distribute_dofs();
    space.update_constraints(conditions);
    double most = 0.;
    for (const auto &node : space.held.nodes())
      for (const auto &condition : node.held)
        most = std::max(most,
                        std::abs(node.point[0] * condition.direction[1] -
                                 node.point[1] * condition.direction[0]));
    const auto free    = free_rigid_motions(space.mapping,
                                         space.dof_handler,
                                         space.constraints,
                                         false);
    const auto normals = count(space); // one at each node
    for (unsigned int n = 2; n <= dim; ++n)
      most = std::max<double>(most, normals[n]);
    verdict((facets ? "facets in " : "ring in ") + std::to_string(dim) +
              "D, degree " + std::to_string(degree),
            normals[1] > 0 && most < 1e-10 && !free.empty() &&
              holds(space, conditions));
  }

  /** A component on the floor, symmetry on a slope of 30 degrees. */
  void
  slope(const bool reversed)
  {
    Space<2> space(MPI_COMM_WORLD, 2, false);
    GridGenerator::general_cell(space.mesh,
                                {Point<2>(0., 0.),
                                 Point<2>(2., 0.),
                                 Point<2>(-std::sqrt(3.), 1.),
                                 Point<2>(2., 2.)},
                                true);
    space.mesh.refine_global(2);
    BoundaryConditions<2> conditions;
    add<2>(conditions,
           reversed ? 2 : 0,
           reversed ? std::vector<std::string>{"0.01", ""} :
                      std::vector<std::string>());
    add<2>(conditions,
           reversed ? 0 : 2,
           reversed ? std::vector<std::string>() :
                      std::vector<std::string>{"0.01", ""});
    space.distribute_dofs();
    space.update_constraints(conditions);
    bool good = holds(space, conditions);
    for (const auto &node : space.held.nodes())
      if (node.point.norm() < 1e-12)
        {
          const auto u = node.motion([](const auto &condition) {
            return condition.component < 2 ? 0.01 : 0.;
          });
          good &=
            std::abs(u[0] - 0.01) + std::abs(u[1] + 0.01 / std::sqrt(3.)) <
            1e-14;
        }
    std::ostringstream name;
    name << "component and slope" << (reversed ? ", reversed" : "")
         << ", nodes";
    for (const auto n : count(space))
      name << ' ' << n;
    verdict(name.str(), good);
  }

  /** Two values at a corner: the first in the file. */
  void
  contradiction(const bool reversed)
  {
    Space<2> space(MPI_COMM_WORLD, 1, false);
    GridGenerator::hyper_cube(space.mesh, 0., 1., true);
    space.mesh.refine_global(3);
    BoundaryConditions<2> conditions;
    add<2>(conditions, reversed ? 2 : 0, {"", reversed ? "2" : "1"});
    add<2>(conditions, reversed ? 0 : 2, {"", reversed ? "1" : "2"});
    space.distribute_dofs();
    space.update_constraints(conditions);
    bool good = holds(space, conditions);
    for (const auto &node : space.held.nodes())
      if (node.point.norm() < 1e-12)
        good &= node.held.size() == 1 && node.held[0].section == 0;
    const auto n = Utilities::MPI::sum(
      static_cast<unsigned int>(space.held.overruled().size()), MPI_COMM_WORLD);
    verdict(std::string("contradiction") + (reversed ? ", reversed" : ""),
            good && n == 1);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    output.open("output");
  for (const unsigned int degree : {1, 2})
    {
      reentrant<2>(degree);
      reentrant<3>(degree);
      for (const bool facets : {false, true})
        {
          ring<2>(degree, facets);
          ring<3>(degree, facets);
        }
    }
  for (const bool reversed : {false, true})
    {
      slope(reversed);
      contradiction(reversed);
    }
}
