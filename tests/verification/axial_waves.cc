// Plane waves along the axis of a cylinder that its rim holds: the same at the
// axis and at the rim at degree 1, whose masses are exact row sums. At degree 2
// the row sums of nodes on the axis vanish; what they have instead is seen, of
// second order in the cells.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** Of the velocities at the axis and within the body from those at the rim, by
   *  the peak, which passes after two of its lengths.
   *  @param n cells a pulse */
  double
  difference(const unsigned int degree, const unsigned int n)
  {
    SceneFile file;
    file.set({}, "Embedding", "axisymmetric");
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             std::to_string(n / 5) + ", " + std::to_string(4 * n) +
               " : 0, 0 : 0.2, 4 : true");
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    const SceneFile::Path rock = {"Materials", "rock"};
    file.set(rock, "Rheology", "elastic");
    // the speed of longitudinal waves is 1
    file.set(rock, "Bulk modulus", "0.6");
    file.set(rock, "Shear modulus", "0.3");
    file.set(rock, "Density", "1");
    for (const char *side : {"right", "bottom", "top"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Initial state"}, "Velocity", "0; if(y < 1, 1 - cos(2*pi*y), 0)");
    file.set({"Time integration"}, "End time", "2.5");
    file.set({"Output"}, "Probe points", "0.2, 2.5; 0, 2.5; 0.1, 2.5");
    file.set({"Output"}, "Probe quantities", "velocity");
    double peak = 0., largest = 0.;
    for (const auto &line : run(file))
      {
        const double rim = value(line, "velocity y at probe 1");
        peak             = std::max(peak, rim);
        for (const char *probe :
             {"velocity y at probe 2", "velocity y at probe 3"})
          largest = std::max(largest, std::abs(value(line, probe) - rim));
      }
    return largest / peak;
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    report.require("degree 1", difference(1, 15), 1e-9);
    const double coarse = difference(2, 15), fine = difference(2, 30);
    report.out << "degree 2: " << std::setprecision(2) << coarse << ' ' << fine
               << '\n';
    report.require("degree 2", coarse, 0.02);
    report.require("degree 2, of finer cells", fine / coarse, 0.35);
  });
}
