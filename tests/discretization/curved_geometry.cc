// Coarse cells with curved edges: all refinements lie on the curve, whatever
// the order of the points in an element, on any number of ranks.

#include <signoton/base/mpi_session.h>
#include <signoton/discretization/curved_geometry.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <verdicts.h>

#include <cmath>
#include <numeric>

using namespace Signoton;

namespace
{
  /** A shell between the radii 1 and 2, up to an eighth of a turn wide, by
   *  coordinates in the unit cell. */
  template <int dim>
  Point<dim>
  shell(const Point<dim> &unit)
  {
    const double r = 1. + unit[0], phi = numbers::PI / 4. * unit[1];
    Point<dim>   point;
    if constexpr (dim == 2)
      point = Point<dim>(r * std::cos(phi), r * std::sin(phi));
    else
      {
        const double theta = numbers::PI / 4. * unit[2];
        point              = Point<dim>(r * std::cos(phi) * std::cos(theta),
                           r * std::sin(phi) * std::cos(theta),
                           r * std::sin(theta));
      }
    return point;
  }

  template <int dim>
  double
  shell_volume()
  {
    const double angle = numbers::PI / 4.;
    return dim == 2 ? angle * 3. / 2. : angle * std::sin(angle) * 7. / 3.;
  }

  /** A polynomial of degree 4 in each coordinate. */
  template <int dim>
  Point<dim>
  polynomial(const Point<dim> &unit)
  {
    Point<dim> point = unit;
    for (unsigned int d = 0; d < dim; ++d)
      point[d] +=
        .1 * std::pow(unit[(d + 1) % dim], 4) * (1. + .5 * unit[d] * unit[d]);
    return point;
  }

  /** Two cells in each direction with straight edges. */
  template <int dim, class Map>
  void
  make_coarse(Triangulation<dim> &mesh, const Map &map)
  {
    GridGenerator::subdivided_hyper_cube(mesh, 2);
    GridTools::transform(map, mesh);
  }

  /** The elements of that mesh, each with its axes in another order and sense:
   *  the n-th way of looking at a square or cube. */
  template <int dim, class Map>
  CurvedElements
  make_elements(const unsigned int order, const Map &map)
  {
    CurvedElements elements;
    elements.order       = order;
    const unsigned int n = order + 1, n_points = Utilities::pow(n, dim);
    const unsigned int n_ways = dim == 2 ? 8 : 48, n_cells = 1 << dim;
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      {
        unsigned int              way = (7 * cell) % n_ways;
        std::array<unsigned, dim> axes;
        std::iota(axes.begin(), axes.end(), 0U);
        for (unsigned int i = 0; i < way >> dim; ++i)
          std::next_permutation(axes.begin(), axes.end());
        for (unsigned int p = 0; p < n_points; ++p)
          {
            Point<dim> unit;
            for (unsigned int d = 0, rest = p; d < dim; ++d, rest /= n)
              {
                const double at = double(rest % n) / order;
                unit[axes[d]] =
                  ((cell >> axes[d] & 1U) + ((way >> d & 1U) ? 1. - at : at)) /
                  2.;
              }
            const Point<dim> point = map(unit);
            for (unsigned int d = 0; d < dim; ++d)
              elements.coordinates.push_back(point[d]);
          }
      }
    return elements;
  }

  template <int dim>
  double
  volume(const Mapping<dim> &mapping, const Triangulation<dim> &mesh)
  {
    const FE_Nothing<dim> fe;
    FEValues<dim> mapped(mapping, fe, QGauss<dim>(4), update_JxW_values);
    double        sum = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          mapped.reinit(cell);
          for (const auto q : mapped.quadrature_point_indices())
            sum += mapped.JxW(q);
        }
    return Utilities::MPI::sum(sum, mesh.get_communicator());
  }

  bool
  on_all_ranks(const bool good)
  {
    return Utilities::MPI::min(good ? 1 : 0, MPI_COMM_WORLD) == 1;
  }

  /** A map of the order of the elements is met exactly. */
  template <int dim>
  void
  test_polynomial(Verdicts &verdict)
  {
    Triangulation<dim> coarse;
    make_coarse(coarse, polynomial<dim>);
    const CurvedGeometry<dim> shape(make_elements<dim>(4, polynomial<dim>),
                                    coarse);
    bool                      good = shape.attach(coarse).empty();
    coarse.refine_global(dim == 2 ? 4 : 2);
    Triangulation<dim> exact;
    GridGenerator::subdivided_hyper_cube(exact, 2);
    exact.refine_global(dim == 2 ? 4 : 2);
    const MappingQ<dim> mapping(2);
    auto                unit  = exact.begin_active();
    double              error = 0.;
    for (const auto &cell : coarse.active_cell_iterators())
      {
        for (const auto v : cell->vertex_indices())
          error = std::max(error,
                           cell->vertex(v).distance(
                             polynomial(Point<dim>(unit->vertex(v)))));
        // the point in the middle of the cell and of a face
        Point<dim> middle, face;
        for (unsigned int d = 0; d < dim; ++d)
          middle[d] = face[d] = .5;
        face[0] = 0.;
        for (const auto &point : {middle, face})
          {
            Point<dim> place = unit->vertex(0);
            place += (unit->vertex(1)[0] - place[0]) * point;
            error = std::max(error,
                             mapping.transform_unit_to_real_cell(cell, point)
                               .distance(polynomial(place)));
          }
        ++unit;
      }
    verdict(std::to_string(dim) + "D, a polynomial is met to round-off",
            good && error < 1e-13);
  }

  /** Order 2 and 4 of the volume by mappings of degree 1 and 2, on refined
   *  meshes with hanging nodes, too. */
  template <int dim>
  void
  test_shell(Verdicts &verdict)
  {
    Triangulation<dim> coarse;
    make_coarse(coarse, shell<dim>);
    const CurvedGeometry<dim> shape(make_elements<dim>(6, shell<dim>), coarse);
    bool                      good = shape.attach(coarse).empty();
    parallel::distributed::Triangulation<dim> mesh(MPI_COMM_WORLD);
    mesh.copy_triangulation(coarse);
    const std::string name = std::to_string(dim) + "D shell, ";
    for (const unsigned int degree : {1, 2})
      {
        std::vector<double> errors;
        mesh.clear();
        mesh.copy_triangulation(coarse);
        for (unsigned int level = 0; level < 3; ++level)
          {
            if (level > 0)
              mesh.refine_global(1);
            errors.push_back(std::abs(volume(MappingQ<dim>(degree), mesh) -
                                      shell_volume<dim>()));
          }
        const double order = std::log2(errors[1] / errors[2]);
        verdict(name + "order of the volume, degree " + std::to_string(degree),
                good && order > 2. * degree - .1);
      }
    // a quarter of the cells twice finer
    for (unsigned int cycle = 0; cycle < 2; ++cycle)
      {
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->is_locally_owned() &&
              cell->center()[1] > .4 * cell->center().norm())
            cell->set_refine_flag();
        mesh.execute_coarsening_and_refinement();
      }
    double radius = 0., normal = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              const bool is_inner =
                face->vertex(0).norm() < 1.0001 &&
                face->vertex((1 << (dim - 1)) - 1).norm() < 1.0001;
              if (!is_inner)
                continue;
              for (const auto v : face->vertex_indices())
                radius =
                  std::max(radius, std::abs(face->vertex(v).norm() - 1.));
              const Point<dim> middle = face->center(true);
              radius       = std::max(radius, std::abs(middle.norm() - 1.));
              const auto n = face->get_manifold().normal_vector(face, middle);
              normal       = std::max(normal,
                                1. - std::abs(n * Tensor<1, dim>(middle)) /
                                       n.norm() / middle.norm());
            }
    verdict(name + "points on the sphere", on_all_ranks(radius < 1e-10));
    verdict(name + "normals of the sphere", on_all_ranks(normal < 1e-10));
  }

  /** Corners that move take the shape with them; straight elements need none;
   *  a cell that folds leaves all straight; facets are seen. */
  template <int dim>
  void
  test_limits(Verdicts &verdict)
  {
    const std::string  name = std::to_string(dim) + "D, ";
    Triangulation<dim> coarse;
    make_coarse(coarse, shell<dim>);
    const auto facets = find_facets(coarse);
    // two facets in each direction: 22.5 degrees on the inside and outside
    verdict(name + "facets are seen",
            facets.size() == 1 && facets.begin()->second.largest < 23. &&
              facets.begin()->second.largest > 20.);
    const CurvedGeometry<dim> shape(make_elements<dim>(6, shell<dim>), coarse);
    Triangulation<dim>        moved;
    moved.copy_triangulation(coarse);
    GridTools::distort_random(.1, moved, true, 5489U);
    const bool good = shape.attach(moved).empty();
    verdict(name + "a curve is none of facets", find_facets(moved).empty());
    moved.refine_global(dim == 2 ? 3 : 2);
    verdict(name + "moved corners",
            good && std::abs(volume(MappingQ<dim>(2), moved) -
                             shell_volume<dim>()) < 1e-4);

    const auto         straight = [](const Point<dim> &unit) { return unit; };
    Triangulation<dim> box;
    make_coarse(box, straight);
    CurvedGeometry<dim>(make_elements<dim>(3, straight), box).attach(box);
    verdict(name + "straight elements need no manifold",
            box.get_manifold_ids() ==
              std::vector<types::manifold_id>{numbers::flat_manifold_id});
    const auto folding = [](const Point<dim> &unit) {
      Point<dim> point = unit;
      point[0] += 20. * unit[1] * (unit[1] - .5) * (unit[0] - 1.);
      return point;
    };
    const auto folded =
      CurvedGeometry<dim>(make_elements<dim>(3, folding), box).attach(box);
    verdict(name + "a fold is told, and edges stay straight",
            !folded.empty() && box.get_manifold_ids().size() == 1);
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Verdicts verdict(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ?
                     "output" :
                     "/dev/null");
  test_polynomial<2>(verdict);
  test_polynomial<3>(verdict);
  test_shell<2>(verdict);
  test_shell<3>(verdict);
  test_limits<2>(verdict);
  test_limits<3>(verdict);
  return verdict.status();
}
