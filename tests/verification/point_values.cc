// Stresses and strains at points, along lines and over surfaces: a linear
// displacement has the same at any point of a mesh with hanging nodes; a column
// at rest has stresses that grow with depth, with a jump at an interface; a ring
// and a sphere under pressure, and a plate with a hole, at their rims.

#include "box_scene.h"
#include "shell_scene.h"

#include <signoton/drivers/nodal_fields.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include <fstream>

using namespace Verification;
using namespace Signoton;

namespace
{
  const std::string quantities =
    "displacement, stress, strain, principal stress, pressure, shear "
    "intensity, energy density, region, contact strain, plastic strain";

  /** Everything that is told of a point, from its strain, of which all is
   *  elastic. */
  std::map<std::string, double>
  elastic_state(const Tensor2<> &strain, const Moduli &moduli)
  {
    const std::array<const char *, 6> entries = {
      {"xx", "yy", "zz", "xy", "xz", "yz"}};
    const Tensor2<>               stress = moduli.stress(strain);
    const auto                    sorted = eigenvalues(stress);
    std::map<std::string, double> result;
    for (unsigned int e = 0; e < 6; ++e)
      {
        const std::string entry           = entries[e];
        result["stress " + entry]         = stress.access_raw_entry(e);
        result["strain " + entry]         = strain.access_raw_entry(e);
        result["contact strain " + entry] = 0.;
        result["plastic strain " + entry] = 0.;
      }
    for (unsigned int i = 0; i < 3; ++i)
      result["principal stress " + std::to_string(i + 1)] = sorted[i];
    result["pressure"]        = -trace(stress) / 3.;
    result["shear intensity"] = std::sqrt(
      0.5 * dealii::deviator(stress).norm() * dealii::deviator(stress).norm());
    result["energy density"] = 0.5 * (stress * strain);
    result["region"]         = 0.;
    return result;
  }

  void
  patch(Report &report, const int dim, const unsigned int degree)
  {
    const double      H[3][3] = {{1e-2, 6e-3, 3e-3},
                                 {-2e-3, -4e-3, 5e-3},
                                 {1e-3, 7e-3, -8e-3}};
    const std::string axes    = "xyz";
    SceneFile         file    = box_scene(dim, 2, degree);
    file.set({"Geometry"}, "Distortion", "0");
    const SceneFile::Path stuff = {"Materials", "stuff"};
    file.set(stuff, "Rheology", "elastic");
    file.set(stuff, "Bulk modulus", "1");
    file.set(stuff, "Shear modulus", "0.6");
    Tensor2<> strain;
    for (int i = 0; i < dim; ++i)
      {
        std::string u;
        for (int j = 0; j < dim; ++j)
          {
            u +=
              std::string(j > 0 ? " + " : "") + text(H[i][j]) + "*" + axes[j];
            strain[i][j] = 0.5 * (H[i][j] + H[j][i]);
          }
        for (const std::string side :
             {"left", "right", "front", "back", "bottom", "top"})
          if (dim == 3 || (side != "front" && side != "back"))
            file.set({"Boundaries", side},
                     std::string("Displacement ") + axes[i],
                     u + " + (1 - t)*1e-2*exp(-20*(x^2 + y^2))");
      }
    file.set({"Load steps"}, "Step size", "0.5");
    file.set({"Refinement"}, "Cycles in first step", dim == 2 ? "3" : "1");
    // vertices, edges, faces, insides, of coarse and of fine cells
    const std::vector<std::string> points =
      dim == 2 ? std::vector<std::string>{"0, 0",
                                          "0.5, 0.5",
                                          "0.5, 0.25",
                                          "0.25, 0.375",
                                          "0.125, 0.0625",
                                          "1, 0.75",
                                          "0.31, 0.77",
                                          "0.03, 0.02"} :
                 std::vector<std::string>{"0, 0, 0",
                                          "0.5, 0.5, 0.5",
                                          "0.5, 0.5, 0.25",
                                          "0.25, 0.5, 0.25",
                                          "1, 1, 0.3",
                                          "0.21, 0.62, 0.83"};
    std::string all;
    for (const auto &point : points)
      all += (all.empty() ? "" : "; ") + point;
    file.set({"Output"}, "Probe points", all);
    file.set({"Output"}, "Probe quantities", quantities);
    file.set({"Output"},
             "Probe lines",
             dim == 2 ? "0, 0 : 1, 1 : 17" : "0, 0.5, 0.5 : 1, 0.5, 0.5 : 17");
    const auto lines = run(file);
    report.require("hanging nodes",
                   value(lines.back(), "cells") > (dim == 2 ? 4 : 8) ? 0. : 1.,
                   0.);
    const auto exact = elastic_state(strain, {1., 0.6});
    double     worst = 0.;
    for (unsigned int i = 1; i <= points.size(); ++i)
      for (const auto &[name, number] : exact)
        if (dim == 3 || (name.find("xz") == std::string::npos &&
                         name.find("yz") == std::string::npos))
          worst =
            std::max(worst,
                     std::abs(value(lines.back(),
                                    name + " at probe " + std::to_string(i)) -
                              number));
    unsigned int n_rows = 0;
    for (const auto &row : PhysicalNumbers::read("results/line-1.csv"))
      if (!row.empty() && value(row, "time") == 1.)
        {
          ++n_rows;
          for (const auto &[name, number] : exact)
            if (dim == 3 || (name.find("xz") == std::string::npos &&
                             name.find("yz") == std::string::npos))
              worst = std::max(worst, std::abs(value(row, name) - number));
        }
    report.require("rows of the line", n_rows - 17., 0.);
    report.out << "patch, " << dim << "D, degree " << degree << ": "
               << report.round_off("patch", worst, 1e-12) << std::endl;
  }

  /** Two layers under pressure and their own weight. */
  SceneFile
  column(const int dim)
  {
    SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             dim == 2 ? "2, 10 : 0, 0 : 2, 10 : true" :
                        "2, 1, 10 : 0, 0, 0 : 2, 1, 10 : true");
    const std::string up = dim == 2 ? "y" : "z";
    file.set({"Geometry"}, "Material ids", "1: " + up + " > 5");
    const SceneFile::Path lower = {"Materials", "lower"},
                          upper = {"Materials", "upper"};
    for (const auto &path : {lower, upper})
      file.set(path, "Rheology", "elastic");
    file.set(lower, "Young modulus", "1e8");
    file.set(lower, "Poisson ratio", "0");
    file.set(lower, "Density", "2000");
    file.set(upper, "Material id", "1");
    file.set(upper, "Young modulus", "1e7");
    file.set(upper, "Poisson ratio", "0.4");
    file.set(upper, "Density", "1500");
    for (const std::string side : {"left", "right", "front", "back"})
      if (dim == 3 || side == "left" || side == "right")
        file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Boundaries", "bottom"}, "Displacement " + up, "0");
    file.set({"Boundaries", "top"}, "Pressure", "1e4*t");
    file.set({"Loads"}, "Gravity", dim == 2 ? "0; -10*t" : "0; 0; -10*t");
    file.set({"Discretization"}, "Degree", "2");
    return file;
  }

  /** By the height: vertical and lateral stress. */
  std::pair<double, double>
  column_stress(const double height, const bool is_upper)
  {
    const double vertical =
      is_upper ? -1e4 - 1.5e4 * (10. - height) : -8.5e4 - 2e4 * (5. - height);
    return {vertical, is_upper ? 0.4 / 0.6 * vertical : 0.};
  }

  void
  column_at_rest(Report &report, const int dim)
  {
    SceneFile         file   = column(dim);
    const std::string up     = dim == 2 ? "y" : "z",
                      middle = dim == 2 ? "" : "0.4, ";
    std::string points;
    for (const std::string height : {"10", "5", "0", "7.3", "2"})
      points += (points.empty() ? "1, " : "; 1, ") + middle + height;
    file.set({"Output"}, "Probe points", points);
    file.set({"Output"}, "Probe surfaces", "top, bottom, left");
    file.set({"Output"}, "Probe quantities", "displacement, stress");
    file.set({"Output"},
             "Probe lines",
             "1, " + middle + "0 : 1, " + middle + "10 : 21");
    const auto line    = run(file).back();
    double     worst   = 0.;
    const auto compare = [&](const double found, const double exact) {
      worst = std::max(worst, std::abs(found - exact) / 1.85e5);
    };
    const auto at_probe =
      [&](const std::string &probe, const double height, const bool is_upper) {
        const auto [vertical, lateral] = column_stress(height, is_upper);
        compare(value(line, "stress " + up + up + " at probe " + probe),
                vertical);
        compare(value(line, "stress xx at probe " + probe), lateral);
      };
    at_probe("1", 10., true);
    at_probe("2 in upper", 5., true);
    at_probe("2 in lower", 5., false);
    at_probe("3", 0., false);
    at_probe("4", 7.3, true);
    at_probe("5", 2., false);
    compare(value(line, "traction " + up + " at top"), -1e4);
    compare(value(line, "traction x at top"), 0.);
    compare(value(line, "traction " + up + " at bottom"), 1.85e5);
    // half of the side is of the upper layer, whose mean is half way down
    compare(value(line, "traction x at left"),
            -0.5 * column_stress(7.5, true).second);

    unsigned int n_rows = 0;
    for (const auto &row : PhysicalNumbers::read("results/line-1.csv"))
      if (!row.empty() && value(row, "time") == 1.)
        {
          ++n_rows;
          const auto [vertical, lateral] =
            column_stress(value(row, "distance"),
                          value(row, "material id") == 1.);
          compare(value(row, "stress " + up + up), vertical);
          compare(value(row, "stress xx"), lateral);
        }
    report.require("rows of the line, two on the interface", n_rows - 22., 0.);
    report.out << "column at rest, " << dim
               << "D: " << report.round_off("column", worst, 1e-9) << std::endl;
  }

  /** The displacement of the column, of which the stresses are linear. */
  template <int dim>
  class ColumnDisplacement : public Function<dim>
  {
  public:
    ColumnDisplacement()
      : Function<dim>(dim)
    {}

    double
    value(const Point<dim> &p, const unsigned int c) const override
    {
      if (c + 1 < dim)
        return 0.;
      // E (1 - nu)/(1 + nu)/(1 - 2 nu)
      const double lower = 1e8, upper = 1e7 * 0.6 / 1.4 / 0.2;
      const auto   below = [](const double y) {
        return -8.5e4 * y - 2e4 * (5. * y - 0.5 * y * y);
      };
      const auto above = [](const double y) {
        return -1e4 * y - 1.5e4 * (10. * y - 0.5 * y * y);
      };
      const double y = p[dim - 1];
      return y <= 5. ? below(y) / lower :
                       below(5.) / lower + (above(y) - above(5.)) / upper;
    }
  };

  template <int dim>
  void
  nodal_stress(Report &report)
  {
    Scene<dim> scene(MPI_COMM_WORLD, column(dim));
    scene.build();
    auto &space = *scene.model.space;
    scene.model.mechanics->reinit();
    VectorType u, interpolated = space.make_relevant_vector();
    scene.model.mechanics->initialize_vector(u);
    VectorTools::interpolate(space.mapping,
                             space.dof_handler,
                             ColumnDisplacement<dim>(),
                             interpolated);
    u.copy_locally_owned_data_from(interpolated);
    const NodalFields<dim> nodes(scene.model, u);
    double                 worst = 0.;
    for (unsigned int k = 0; k < nodes.fields.size(); ++k)
      for (const auto &cell : nodes.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            std::vector<types::global_dof_index> dofs(
              GeometryInfo<dim>::vertices_per_cell);
            cell->get_dof_indices(dofs);
            for (const auto v : cell->vertex_indices())
              {
                const auto [vertical, lateral] =
                  column_stress(cell->vertex(v)[dim - 1],
                                cell->material_id() == 1);
                const double found = nodes.fields[k][dofs[v]];
                if (nodes.names[k] ==
                    (dim == 2 ? "nodal_stress_yy" : "nodal_stress_zz"))
                  worst = std::max(worst, std::abs(found - vertical));
                if (nodes.names[k] == "nodal_stress_xx")
                  worst = std::max(worst, std::abs(found - lateral));
                if (nodes.names[k] == "nodal_pressure")
                  worst =
                    std::max(worst,
                             std::abs(found + (vertical + 2. * lateral) / 3.));
              }
          }
    worst = Utilities::MPI::max(worst, MPI_COMM_WORLD) / 1.85e5;
    // of single precision
    report.out << "column, nodal fields, " << dim
               << "D: " << report.round_off("nodal fields", worst, 1e-6)
               << std::endl;
  }

  /** A key tells whether fields for ParaView have it. */
  void
  nodal_key(Report &report)
  {
    const std::string ending =
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 ? "vtu" : "pvtu";
    for (const std::string key : {"true", "false"})
      {
        Options options;
        options.scene_file = source_directory + "/tests/scenes/plate_hole.prm";
        options.output_directory = "fields " + key;
        options.overrides        = {"Output/Fields every=1",
                                    "Output/Nodal stress=" + key};
        report.require(
          "a run with fields",
          run_scene(MPI_COMM_WORLD, options) == ExitStatus::completed ? 0. : 1.,
          0.);
        MPI_Barrier(MPI_COMM_WORLD); // one rank writes what all read
        std::ifstream     file("fields " + key + "/fields-0001." + ending,
                           std::ios::binary);
        const std::string text((std::istreambuf_iterator<char>(file)),
                               std::istreambuf_iterator<char>());
        const auto        has = [&](const std::string &name) {
          return text.find('"' + name + '"') != std::string::npos;
        };
        report.require("cell fields", has("stress_yy") ? 0. : 1., 0.);
        report.require("nodal fields, " + key,
                       has("nodal_stress_yy") == (key == "true") ? 0. : 1.,
                       0.);
      }
  }

  /** Stresses at the rim under refinement: their error at the end, and its
   *  order in the last step. */
  void
  study(Report                                            &report,
        const std::string                                 &name,
        const SceneFile                                   &file,
        const std::array<unsigned int, 2>                 &levels,
        const std::vector<std::pair<std::string, double>> &exact,
        const double                                       order,
        const double                                       bound)
  {
    std::vector<double> errors;
    for (unsigned int level = levels[0]; level <= levels[1]; ++level)
      {
        const auto line = run(file, {refinement(level)}).back();
        errors.push_back(0.);
        for (const auto &[column, number] : exact)
          errors.back() =
            std::max(errors.back(), std::abs(value(line, column) - number));
      }
    report.out << name << ": errors";
    for (const double error : errors)
      report.out << ' ' << std::setprecision(2) << std::scientific << error;
    report.out << std::endl;
    report.require(name, errors.back(), bound);
    report.require_order(name,
                         std::log2(errors[errors.size() - 2] / errors.back()),
                         order);
  }

  void
  rims(Report &report)
  {
    const std::string slope =
      "0.9396926207859084, 0.3420201433256687"; // 20 deg
    for (const unsigned int p : {1U, 2U})
      {
        const std::string of_degree = ", degree " + std::to_string(p);
        SceneFile         ring      = quarter_shell("1 : 2", p);
        ring.set({"Boundaries", "inner"}, "Pressure", "1");
        ring.set({"Output"}, "Probe points", "1, 0; " + slope);
        ring.set({"Output"}, "Probe quantities", "stress, principal stress");
        // hoop (b^2 + a^2)/(b^2 - a^2), radial -1
        study(report,
              "ring" + of_degree,
              ring,
              {{2, 4}},
              {{"stress yy at probe 1", 5. / 3.},
               {"stress xx at probe 1", -1.},
               {"principal stress 1 at probe 2", 5. / 3.},
               {"principal stress 3 at probe 2", -1.}},
              p == 1 ? 0.85 : 1.8,
              p == 1 ? 0.15 : 5e-3);
        SceneFile sphere = ring;
        sphere.set({}, "Embedding", "axisymmetric");
        // hoop (b^3 + 2 a^3)/(2 (b^3 - a^3))
        study(report,
              "sphere" + of_degree,
              sphere,
              {{2, 4}},
              {{"stress yy at probe 1", 10. / 14.},
               {"stress zz at probe 1", 10. / 14.},
               {"stress xx at probe 1", -1.},
               {"principal stress 1 at probe 2", 10. / 14.},
               {"principal stress 3 at probe 2", -1.}},
              p == 1 ? 0.85 : 1.8,
              p == 1 ? 0.2 : 8e-3);
      }
    // Kirsch: a hole in a sheet pulled along x, cut out at four radii, where
    // the traction of the infinite sheet acts
    SceneFile plate = quarter_shell("1 : 4", 2);
    plate.set({"Output"}, "Probe quantities", "stress");
    const std::string c2 = "((x^2 - y^2)/16)", s2 = "(2*x*y/16)",
                      radial =
                        "0.5*((1 - 1/16) + (1 - 4/16 + 3/256)*" + c2 + ")",
                      shear = "(-0.5)*(1 + 2/16 - 3/256)*" + s2;
    plate.set({"Boundaries", "outer"},
              "Traction",
              "(" + radial + ")*x/4 - (" + shear + ")*y/4; (" + radial +
                ")*y/4 + (" + shear + ")*x/4");
    plate.set({"Output"}, "Probe points", "0, 1; 1, 0");
    study(report,
          "Kirsch",
          plate,
          {{2, 5}},
          {{"stress xx at probe 1", 3.}, {"stress yy at probe 2", -1.}},
          1.5,
          0.02);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    for (const int dim : {2, 3})
      {
        for (const unsigned int p : {1U, 2U})
          patch(report, dim, p);
        column_at_rest(report, dim);
      }
    nodal_stress<2>(report);
    nodal_stress<3>(report);
    nodal_key(report);
    if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      rims(report);
  });
}
