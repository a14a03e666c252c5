// Elastic bodies whose loads are far below the forces of their elements, and
// grains that bear nothing at all: each has an answer, and linear bodies have it
// after one iteration; a body that flies off has none. Cantilevers of 100 and 1000 to 1 against the theory of
// Timoshenko, columns of two layers whose moduli differ up to 1e8 times against
// their weight, stiff plates on grains, lifted grains, blocks that follow their supports.

#include "verification.h"

using namespace Verification;
using Signoton::ExitStatus;
using Signoton::SceneFile;

namespace
{
  SceneFile
  box(const std::string &arguments, const std::string &young_modulus)
  {
    SceneFile file;
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"}, "Arguments", arguments + " : true");
    file.set({"Materials", "m"}, "Rheology", "elastic");
    file.set({"Materials", "m"}, "Young modulus", young_modulus);
    file.set({"Materials", "m"}, "Poisson ratio", "0");
    file.set({"Discretization"}, "Degree", "2");
    return file;
  }

  /** An elastic material with the id 1, where the condition holds. */
  void
  add_stiff_part(SceneFile         &file,
                 const std::string &condition,
                 const double       young_modulus,
                 const std::string &poisson_ratio)
  {
    file.set({"Geometry"}, "Material ids", "1: " + condition);
    const SceneFile::Path stiff = {"Materials", "stiff"};
    file.set(stiff, "Rheology", "elastic");
    file.set(stiff, "Material id", "1");
    file.set(stiff, "Young modulus", text(young_modulus));
    file.set(stiff, "Poisson ratio", poisson_ratio);
  }

  void
  require_one_iteration(Report                      &report,
                        const std::string           &name,
                        const PhysicalNumbers::Line &line)
  {
    report.require(name + ", iterations",
                   value(line, "most newton iterations of a solve"),
                   1.);
  }

  /** A cantilever of height 1 under a unit shear force at its end. */
  void
  cantilever(Report &report, const double length)
  {
    SceneFile file = box("100, 2 : 0, 0 : " + text(length) + ", 1", "1e6");
    file.set({"Boundaries", "left"}, "Displacement x", "0");
    file.set({"Boundaries", "left"}, "Displacement y", "0");
    file.set({"Boundaries", "right"}, "Traction", "0; 1");
    file.set({"Output"}, "Probe points", text(length) + ", 0.5");
    const auto         line = run(file).back();
    std::ostringstream name;
    name << "cantilever of " << length;
    const double bending = 4. * std::pow(length, 3) / 1e6,
                 shear   = length / (5. / 6. * 0.5e6);
    // Round-off by the condition of the matrix, which goes with the fourth power
    // of the slenderness, and what quadratic cells leave.
    report.require(name.str(),
                   value(line, "displacement y at probe 1") /
                       (bending + shear) -
                     1.,
                   std::max(1e-3, 1e-14 * std::pow(length, 4)));
    require_one_iteration(report, name.str(), line);
  }

  /** A heavy column of height 2, one half stiff: linear in the pieces. */
  void
  two_layers(Report &report, const double contrast, const bool stiff_on_top)
  {
    SceneFile file = box("4, 8 : 0, 0 : 1, 2", "1");
    add_stiff_part(file, stiff_on_top ? "y > 1" : "y < 1", contrast, "0");
    file.set({"Materials", "stiff"}, "Density", "1e-3");
    file.set({"Materials", "m"}, "Density", "1e-3");
    file.set({"Loads"}, "Gravity", "0; -1");
    for (const char *side : {"left", "right", "bottom"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Output"}, "Probe points", "0.5, 2");
    const auto line = run(file).back();
    // settlement of a layer under its weight and what lies on it
    const double lower = 1.5e-3, upper = 0.5e-3,
                 exact = -(stiff_on_top ? lower + upper / contrast :
                                          lower / contrast + upper);
    std::ostringstream name;
    name << "contrast of " << contrast << (stiff_on_top ? " on top" : " below");
    report.require(name.str(),
                   value(line, "displacement y at probe 1") / exact - 1.,
                   std::max(1e-7, 1e-14 * contrast));
    require_one_iteration(report, name.str(), line);
  }

  /** Grains with a binder that carry a stiff plate, pressed or pulled: of width,
   *  heights and modulus 1, pulled the modulus is that of the binder. */
  void
  plate_on_grains(Report      &report,
                  const int    dim,
                  const double contrast,
                  const double traction)
  {
    SceneFile file =
      box(dim == 2 ? "4, 8 : 0, 0 : 1, 2" : "2, 2, 4 : 0, 0, 0 : 1, 1, 2", "1");
    const std::string up = dim == 2 ? "y" : "z";
    file.set({}, "Dimension", std::to_string(dim));
    file.set({"Materials", "m"}, "Rheology", "elastic granular");
    file.set({"Materials", "m"}, "Admissible set", "no tension");
    file.set({"Materials", "m"}, "Binder", "proportional");
    file.set({"Materials", "m"}, "Binder ratio", "0.02");
    add_stiff_part(file, up + " > 1", contrast, "0");
    std::vector<std::string> sides = {"left", "right", "bottom"};
    if (dim == 3)
      sides.insert(sides.end(), {"front", "back"});
    for (const std::string &side : sides)
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Boundaries", "top"},
             "Traction",
             (dim == 2 ? "0; " : "0; 0; ") + text(traction));
    file.set({"Output"}, "Probe points", dim == 2 ? "0.5, 2" : "0.5, 0.5, 2");
    const auto         line    = run(file).back();
    const double       modulus = traction > 0. ? 0.02 : 1.;
    std::ostringstream name;
    name << "plate of " << contrast << " on grains, " << dim << "D, "
         << (traction > 0. ? "pulled" : "pressed");
    report.require(name.str(),
                   value(line, "displacement " + up + " at probe 1") /
                       (traction * (1. / modulus + 1. / contrast)) -
                     1.,
                   std::max(1e-7, 1e-14 * contrast / modulus));
  }

  /** A block of von Mises between a rough base and a stiff plate as wide as it
   *  is high bears twice its shear strength: slip goes from corner to corner. */
  void
  plate_on_plastic_block(Report &report, const double contrast)
  {
    SceneFile file = box("4, 8 : 0, 0 : 1, 2", "1");
    file.set({"Materials", "m"}, "Rheology", "elastic plastic");
    file.set({"Materials", "m"}, "Admissible set", "von mises");
    file.set({"Materials", "m"}, "Shear strength", "1e-3");
    file.set({"Materials", "m"}, "Poisson ratio", "0.3");
    add_stiff_part(file, "y > 1", contrast, "0.3");
    for (const char *component : {"x", "y"})
      file.set({"Boundaries", "bottom"},
               std::string("Displacement ") + component,
               "0");
    file.set({"Load steps"}, "Step size", "0.25");
    file.set({"Load steps"}, "Minimum step size", "0.05");
    for (const bool too_much : {false, true})
      {
        file.set({"Boundaries", "top"},
                 "Pressure",
                 text((too_much ? 1.2 : 0.98) * 2e-3));
        std::ofstream("block.prm") << file.text();
        std::ostringstream name;
        name << "plate of " << contrast << " on a plastic block, "
             << (too_much ? "too much" : "what it bears");
        report.require(name.str(),
                       attempt("block.prm", {}) ==
                           (too_much ? ExitStatus::no_equilibrium :
                                       ExitStatus::completed) ?
                         0. :
                         1.,
                       0.);
      }
  }

  /** Grains without cohesion that are lifted at once, or pressed before. */
  void
  lifted_grains(Report &report, const int dim, const std::string &motion)
  {
    SceneFile file =
      box(dim == 2 ? "4, 4 : 0, 0 : 1, 1" : "2, 2, 2 : 0, 0, 0 : 1, 1, 1",
          "1e8");
    file.set({}, "Dimension", std::to_string(dim));
    file.set({"Materials", "m"}, "Rheology", "elastic granular");
    file.set({"Materials", "m"}, "Admissible set", "mises schleicher");
    file.set({"Materials", "m"}, "Friction parameter", "0.5");
    file.set({"Materials", "m"}, "Poisson ratio", "0.3");
    file.set({"Discretization"}, "Degree", "1");
    for (const std::string side : {"left", "right", "front", "back"})
      if (dim == 3 || side[0] == 'l' || side[0] == 'r')
        file.set({"Boundaries", side}, "Symmetry", "true");
    const std::string up = dim == 2 ? "y" : "z";
    file.set({"Boundaries", "bottom"}, "Displacement " + up, "0");
    file.set({"Boundaries", "top"}, "Displacement " + up, motion);
    file.set({"Load steps"}, "End time", "2");
    file.set({"Load steps"}, "Step size", "0.25");
    file.set({"Output"}, "Probe surfaces", "top");
    file.set({"Output"}, "Probe quantities", "stress");
    const auto line = run(file).back();
    report.require("grains moved by " + motion + " in " + std::to_string(dim) +
                     "D, traction",
                   value(line, "traction " + up + " at top") / 1e8,
                   1e-12);
  }
  /** A block that its supports carry along, and a second one that nothing
   *  holds: an answer only if nothing pulls at it. */
  void
  carried(Report &report)
  {
    for (const std::string kind : {"elastic", "grains", "bound grains"})
      for (const int dim : {2, 3})
        for (const std::string motion : {"1/3", "1e-3"})
          {
            SceneFile file = box(dim == 2 ? "4, 4 : 0, 0 : 1, 1" :
                                            "4, 4, 4 : 0, 0, 0 : 1, 1, 1",
                                 "1e6");
            file.set({}, "Dimension", std::to_string(dim));
            file.set({"Materials", "m"}, "Poisson ratio", "0.3");
            if (kind != "elastic")
              {
                file.set({"Materials", "m"}, "Rheology", "elastic granular");
                file.set({"Materials", "m"},
                         "Admissible set",
                         "mises schleicher");
                file.set({"Materials", "m"}, "Friction parameter", "0.6");
              }
            if (kind == "bound grains")
              file.set({"Materials", "m"}, "Binder", "proportional");
            file.set({"Discretization"}, "Degree", "1");
            const std::string sides[] = {"left",
                                         dim == 2 ? "bottom" : "front",
                                         "bottom"},
                              axes[]  = {"x", "y", "z"};
            for (int d = 0; d < dim; ++d)
              file.set({"Boundaries", sides[d]},
                       "Displacement " + axes[d],
                       motion);
            file.set({"Output"},
                     "Probe points",
                     dim == 2 ? "0.7, 0.8" : "0.7, 0.8, 0.9");
            const auto line = run(file).back();
            for (int d = 0; d < dim; ++d)
              report.require(kind + " carried by " + motion + " along " +
                               axes[d],
                             value(line,
                                   "displacement " + axes[d] + " at probe 1") /
                                 (motion == "1/3" ? 1. / 3. : 1e-3) -
                               1.,
                             1e-9);
          }

    std::ofstream("two.geo")
      << "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};\n"
         "Rectangle(2) = {2, 0, 0, 1, 1};\n"
         "Transfinite Surface{1, 2}; Recombine Surface{1, 2};\n"
         "Transfinite Curve{1:8} = 4;\n"
         "Physical Surface(\"both\", 1) = {1, 2};\n"
         "Physical Curve(\"left\", 1) = {4};\n"
         "Physical Curve(\"free\", 2) = {6};\n";
    SceneFile two = box("1, 1 : 0, 0 : 1, 1", "1e6");
    two.remove({"Geometry"}, "");
    two.set({"Geometry"}, "Mesh file", "two.geo");
    two.set({"Materials", "m"}, "Material id", "1");
    two.set({"Load steps"}, "Minimum step size", "0.5");
    for (const std::string motion : {"0", "1"})
      for (const std::string pressure : {"1", "-1e-3"})
        {
          two.set({"Boundaries", "left"}, "Displacement x", motion);
          two.set({"Boundaries", "left"}, "Displacement y", "0");
          two.set({"Boundaries", "free"}, "Pressure", pressure);
          std::ofstream("two.prm") << two.text();
          report.require("a block pushed by " + pressure +
                           " beside one that is moved by " + motion,
                         attempt("two.prm", {}) == ExitStatus::no_equilibrium ?
                           0. :
                           1.,
                         0.);
        }
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  cantilever(report, 100.);
  cantilever(report, 1000.);
  for (const double contrast : {1e4, 1e6, 1e8})
    for (const bool stiff_on_top : {true, false})
      two_layers(report, contrast, stiff_on_top);
  for (const int dim : {2, 3})
    for (const double contrast : {1e5, 1e6, 1e8})
      for (const double traction : {-1e-3, 1e-3})
        plate_on_grains(report, dim, contrast, traction);
  for (const double contrast : {1e3, 1e6, 1e8})
    plate_on_plastic_block(report, contrast);
  for (const int dim : {2, 3})
    {
      lifted_grains(report, dim, "1e-3*t");
      lifted_grains(report, dim, "if(t < 1, -1e-3*t, 2e-3*t - 3e-3)");
    }
  carried(report);
  return report.status();
}
