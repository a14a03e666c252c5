// Every generator that deal.II knows by name makes a mesh that can be refined,
// everywhere and here and there, and stays sound. Where a transfinite
// interpolation shapes the cells between a circle and straight sides, faces on
// the circle stay there, as far as the iteration that looks points up in the
// coarse cells goes (some 1e-13), and the area converges to that of the
// geometry: as h^4, as the elements of second order do.

#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/discretization/geometry.h>

#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>

#include <cmath>
#include <iostream>

using namespace Signoton;

namespace
{
  template <int dim>
  using Mesh = parallel::distributed::Triangulation<dim>;

  template <int dim>
  BoundaryParts
  create(const std::string &generator,
         const std::string &arguments,
         Mesh<dim>         &mesh)
  {
    const SceneFile file =
      SceneFile::parse("subsection Geometry\n set "
                       "Generator = " +
                         generator + "\n set Arguments = " + arguments +
                         "\nend\n",
                       generator);
    Geometry         geometry;
    ParameterHandler handler;
    geometry.add_parameters(handler);
    file.apply_to(handler);
    std::vector<std::string> notes;
    return geometry.create(file, {}, mesh, notes);
  }

  /** The volume by elements of second order, and whether the map to each cell
   *  has a positive determinant at all points. */
  template <int dim>
  std::pair<double, bool>
  volume(const Mesh<dim> &mesh)
  {
    const MappingQ<dim>   mapping(2);
    const FE_Nothing<dim> fe;
    FEValues<dim>         values(mapping,
                         fe,
                         QGauss<dim>(4),
                         update_JxW_values | update_jacobians);
    double                sum  = 0.;
    bool                  good = true;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const auto q : values.quadrature_point_indices())
            {
              sum += values.JxW(q);
              good &= values.jacobian(q).determinant() > 0.;
            }
        }
    return {Utilities::MPI::sum(sum, mesh.get_communicator()),
            Utilities::MPI::min(good ? 1 : 0, mesh.get_communicator()) == 1};
  }

  /** The largest distance from a circle of the nodes of the faces that have
   *  their vertices there, and the number of these faces. */
  template <int dim>
  std::pair<double, unsigned int>
  distance_from_circle(const Mesh<dim> &mesh,
                       const Point<2>  &center,
                       const double     radius)
  {
    const MappingQ<dim> mapping(2);
    const auto          distance = [&](const Point<dim> &p) {
      return std::abs(std::hypot(p[0] - center[0], p[1] - center[1]) - radius);
    };
    double       largest = 0.;
    unsigned int n_faces = 0;
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto f : cell->face_indices())
          {
            double     at_vertices = 0.;
            Point<dim> middle;
            for (const auto v : cell->face(f)->vertex_indices())
              at_vertices =
                std::max(at_vertices, distance(cell->face(f)->vertex(v)));
            for (unsigned int d = 0; d < dim; ++d)
              middle[d] = d == f / 2 ? f % 2 : 0.5;
            if (!cell->face(f)->at_boundary() || at_vertices > 1e-6 * radius)
              continue;
            ++n_faces;
            largest = std::max(
              {largest,
               at_vertices,
               distance(mapping.transform_unit_to_real_cell(cell, middle))});
          }
    return {Utilities::MPI::max(largest, mesh.get_communicator()),
            Utilities::MPI::sum(n_faces, mesh.get_communicator())};
  }

  /** Refine everywhere, and then the cells that are nearest to a point. */
  template <int dim>
  void
  refine(Mesh<dim> &mesh)
  {
    mesh.refine_global(1);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && cell->center()[0] > cell->center()[1])
        cell->set_refine_flag();
    mesh.execute_coarsening_and_refinement();
  }

  template <int dim>
  void
  try_all(Verdicts &verdict)
  {
    const bool        plane  = dim == 2;
    const std::string origin = plane ? "0, 0" : "0, 0, 0";
    std::vector<std::pair<std::string, std::string>> generators = {
      {"hyper_cube", "0 : 1 : true"},
      {"subdivided_hyper_cube", "3 : 0 : 1 : true"},
      {"hyper_rectangle", origin + (plane ? ": 2, 1" : ": 2, 1, 1") + ": true"},
      {"subdivided_hyper_rectangle",
       (plane ? "2, 1 :" : "2, 1, 1 :") + origin +
         (plane ? ": 2, 1" : ": 2, 1, 1") + ": true"},
      {"cheese", plane ? "1, 1" : "1, 1, 1"},
      {"general_cell",
       plane ? "0, 0; 1, 0; 0, 1; 1.2, 1.1 : true" :
               "0,0,0; 1,0,0; 0,1,0; 1,1,0; 0,0,1; 1,0,1; 0,1,1; 1.2,1.1,1.3 "
               ": true"},
      {"hyper_cross", plane ? "1, 1, 1, 1 : true" : "1,1,1,1,1,1 : true"},
      {"simplex", plane ? "0,0; 1,0; 0,1" : "0,0,0; 1,0,0; 0,1,0; 0,0,1"},
      {"plate_with_a_hole",
       "1 : 2 : 1 : 1 : 1 : 1 : " + origin + " : 0 : 1 : 1 : 2 : true"},
      {"channel_with_cylinder", "0.03 : 2 : 2 : true"},
      {"enclosed_hyper_cube", "0 : 1 : 1 : true"},
      {"hyper_ball", origin + " : 1 : false"},
      {"quarter_hyper_ball", origin + " : 1"},
      {"half_hyper_ball", origin + " : 1"},
      {"cylinder", "1 : 1"},
      {"truncated_cone", "1 : 0.5 : 1"},
      // deal.II has no colors for it in space: 9.4 leaves them out, 9.6 refuses
      {"hyper_L", plane ? "-1 : 1 : true" : "-1 : 1 : false"},
      {"hyper_cube_slit", "0 : 1 : true"},
      {"hyper_shell", origin + " : 1 : 2 : 0 : true"},
      {"half_hyper_shell", origin + " : 1 : 2 : 0 : true"},
      {"quarter_hyper_shell", origin + " : 1 : 2 : 0 : true"},
      {"hyper_cube_with_cylindrical_hole", "0.25 : 0.5 : 0.5 : 1 : true"},
      {"concentric_hyper_shells", origin + " : 1 : 2 : 1 : 0 : 0 : true"}};
    if (plane)
      // in space deal.II's own mesh folds as it is refined, see
      // input/mesh_folds_when_refined
      generators.emplace_back("hyper_ball", origin + " : 1 : true");
    else
      {
        generators.emplace_back("cylinder_shell", "1 : 1 : 2 : 0 : 0");
        generators.emplace_back("torus", "2 : 0.5 : 6 : 6.283185307179586");
        generators.emplace_back("moebius", "8 : 0 : 2 : 0.5");
      }
    for (const auto &[name, arguments] : generators)
      {
        std::string found;
        try
          {
            Mesh<dim> mesh(MPI_COMM_WORLD);
            create(name,
                   // newer versions ask for the colors of this one as well
                   DEAL_II_VERSION_GTE(9, 6, 0) && name == "cylinder_shell" ?
                     arguments + " : true" :
                     arguments,
                   mesh);
            refine(mesh);
            found = volume(mesh).second ? "sound" : "cells that are folded";
          }
        catch (const UserError &error)
          {
            found = error.what();
          }
        verdict(std::to_string(dim) + "D " + name + "(" + arguments + ")",
                found == "sound");
        if (found != "sound")
          std::cerr << name << ":\n" << found << "\n";
      }
  }

  template <int dim>
  void
  try_hole(Verdicts          &verdict,
           const std::string &name,
           const std::string &arguments,
           const Point<2>    &center,
           const double       radius,
           const double       exact)
  {
    Mesh<dim> mesh(MPI_COMM_WORLD);
    create(name, arguments, mesh);
    double errors[2];
    for (double &error : errors)
      {
        mesh.refine_global(1);
        error = std::abs(volume(mesh).first - exact) / exact;
      }
    const std::string what = std::to_string(dim) + "D " + name;
    verdict(what + ": area within 2e-5, 14 times better at half the size",
            errors[1] < 2e-5 && errors[0] > 14. * errors[1]);
    refine(mesh);
    const auto [distance, n_faces] = distance_from_circle(mesh, center, radius);
    verdict(what + ": the hole is round",
            n_faces > 0 && distance < 1e-11 * radius);
    std::cout << what << ": " << errors[0] << " " << errors[1] << " "
              << distance << " " << n_faces << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  try_all<2>(verdict);
  try_all<3>(verdict);
  const std::string plate = "1 : 2 : 1 : 1 : 1 : 1 : ";
  try_hole<2>(verdict,
              "plate_with_a_hole",
              plate + "0, 0 : 0 : 1 : 1 : 2 : true",
              {0., 0.},
              1.,
              36. - numbers::PI);
  try_hole<3>(verdict,
              "plate_with_a_hole",
              plate + "0, 0, 0 : 0 : 1 : 1 : 2 : true",
              {0., 0.},
              1.,
              36. - numbers::PI);
  try_hole<2>(verdict,
              "channel_with_cylinder",
              "0.03 : 2 : 2 : true",
              {0.2, 0.2},
              0.05,
              2.2 * 0.41 - numbers::PI * 0.0025);
  return verdict.status();
}
