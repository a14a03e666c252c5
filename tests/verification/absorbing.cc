// Plane waves that meet an absorbing boundary along its normal: what is left in
// the body is below one percent of what came, for P and S waves, both degrees,
// 2D and 3D, and for loosened grains where dashpots are matched to those.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** The energy left, as a part of what the source gave. */
  double
  reflected(const int dim, const unsigned int degree, const bool is_shear)
  {
    SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             dim == 2 ? "80, 1 : 0, 0 : 2, 0.025 : true" :
                        "80, 1, 1 : 0, 0, 0 : 2, 0.025, 0.025 : true");
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    const SceneFile::Path rock = {"Materials", "rock"};
    file.set(rock, "Rheology", "elastic");
    file.set(rock, "Bulk modulus", "2");
    file.set(rock, "Shear modulus", "0.9");
    file.set(rock, "Density", "1.3");
    for (const char *name : {"bottom", "top", "front", "back"})
      {
        if (dim == 2 && (name[0] == 'f' || name == std::string("back")))
          continue;
        const SceneFile::Path side = {"Boundaries", name};
        // in 3D the first sides are those of y
        if (!is_shear)
          file.set(side, "Symmetry", "true");
        else
          {
            file.set(side, "Displacement x", "0");
            if (dim == 3)
              file.set(side, "Displacement z", "0");
          }
      }
    const std::string pulse = "exp(-((t-0.4)/0.1)^2)";
    file.set({"Boundaries", "left"},
             "Traction",
             (is_shear ? "0; " + pulse : pulse + "; 0") +
               (dim == 3 ? "; 0" : ""));
    if (is_shear)
      file.set({"Boundaries", "left"}, "Displacement x", "0");
    file.set({"Boundaries", "right"}, "Absorbing", "closed");
    file.set({"Time integration"}, "End time", is_shear ? "4.4" : "3");
    std::ofstream("scene.prm") << file.text();
    const auto last = run("scene.prm", {}).back();
    return (value(last, "kinetic energy") + value(last, "stored energy")) /
           value(last, "external work");
  }

  /** The same in grains with a binder that are open in all directions, and
   *  whose tension the ends hold: what is left of the kinetic energy. */
  double
  reflected_by_loosened(const unsigned int degree, const bool is_shear)
  {
    const double binder = 0.2, bulk = 2., opening = 0.01,
                 tension = binder * 3. * bulk * opening;
    SceneFile file;
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"}, "Arguments", "80, 1 : 0, 0 : 2, 0.025 : true");
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    const SceneFile::Path grains = {"Materials", "grains"};
    file.set(grains, "Rheology", "elastic granular");
    file.set(grains, "Admissible set", "mises schleicher");
    file.set(grains, "Friction parameter", "0.5");
    file.set(grains, "Bulk modulus", std::to_string(bulk));
    file.set(grains, "Shear modulus", "0.9");
    file.set(grains, "Binder", "proportional");
    file.set(grains, "Binder ratio", std::to_string(binder));
    file.set(grains, "Density", "1.3");
    for (const std::string name : {"bottom", "top"})
      file.set({"Boundaries", name},
               is_shear ? "Displacement x" : "Symmetry",
               is_shear ? "0" : "true");
    std::string strain;
    for (unsigned int i = 0; i < 3; ++i)
      strain += std::to_string(opening) + "; ";
    file.set({"Initial state"}, "Strain", strain + "0");
    const std::string sigma = std::to_string(tension),
                      pulse = "1e-4*exp(-((t-0.9)/0.22)^2)";
    // the normal points out: left, the tension pulls to the left
    file.set({"Boundaries", "left"},
             "Traction",
             is_shear ? "0; " + pulse : "-" + sigma + "+" + pulse + "; 0");
    if (is_shear)
      {
        file.set({"Boundaries", "left"}, "Displacement x", "0");
        for (const std::string name : {"bottom", "top"})
          file.set({"Boundaries", name},
                   "Traction",
                   "0; " + std::string(name == "top" ? "" : "-") + sigma);
      }
    file.set({"Boundaries", "right"}, "Absorbing", "loosened");
    file.set({"Boundaries", "right"}, "Traction", sigma + "; 0");
    file.set({"Time integration"}, "End time", is_shear ? "9.8" : "6.7");
    file.set({"Time integration"}, "Linear shock viscosity", "0");
    file.set({"Time integration"}, "Quadratic shock viscosity", "0");
    const auto lines = run(file);
    double     most  = 0.;
    for (const auto &line : lines)
      most = std::max(most, value(line, "kinetic energy"));
    return value(lines.back(), "kinetic energy") / most;
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  for (const int dim : {2, 3})
    for (const unsigned int degree : {1, 2})
      for (const bool is_shear : {false, true})
        {
          const double      part = reflected(dim, degree, is_shear);
          const std::string name = std::string(is_shear ? "S" : "P") +
                                   " wave in " + std::to_string(dim) +
                                   "D, degree " + std::to_string(degree);
          std::cout << name << ": " << part << std::endl;
          report.require(name, part, 0.01);
        }
  for (const unsigned int degree : {1, 2})
    for (const bool is_shear : {false, true})
      {
        const double      part = reflected_by_loosened(degree, is_shear);
        const std::string name = std::string(is_shear ? "S" : "P") +
                                 " wave in loosened grains, degree " +
                                 std::to_string(degree);
        std::cout << name << ": " << part << std::endl;
        report.require(name, part, 0.01);
      }
  return report.status();
}
