// Gravity that is the same at all places, but varies in time, is integrated
// once: against an expression that names a place without depending on it.

#include "box_scene.h"

using namespace Verification;

namespace
{
  void
  shake(Report            &report,
        const int          dim,
        const std::string &scheme,
        const bool         axisymmetric)
  {
    SceneFile file = box_scene(dim, 3, 1);
    if (axisymmetric)
      file.set({}, "Embedding", "axisymmetric");
    const SceneFile::Path stuff = {"Materials", "stuff"};
    file.set(stuff, "Rheology", "elastic");
    file.set(stuff, "Young modulus", "1e6");
    file.set(stuff, "Poisson ratio", "0.3");
    file.set(stuff, "Density", "1000");
    for (const char axis : {'x', 'y', 'z'})
      if (axis - 'x' < dim)
        file.set({"Boundaries", "bottom"},
                 std::string("Displacement ") + axis,
                 "0");
    if (scheme == "statics")
      {
        file.set({"Load steps"}, "End time", "0.1");
        file.set({"Load steps"}, "Step size", "0.05");
      }
    else
      {
        file.set({}, "Analysis", "dynamics");
        file.set({"Time integration"}, "Scheme", scheme);
        file.set({"Time integration"}, "End time", "0.1");
      }
    PhysicalNumbers::Line lines[2];
    for (const bool by_place : {false, true})
      {
        file.set({"Loads"},
                 "Gravity",
                 std::string("3*sin(20*t)") + (by_place ? " + 0*x" : "") +
                   "; -10*t" + (dim == 3 ? "; 0: 0, 0.05: 2, 1: 2" : ""));
        lines[by_place] = run(file).back();
      }
    const std::string name = std::to_string(dim) + "D" +
                             (axisymmetric ? ", axisymmetric, " : ", ") +
                             scheme;
    for (const char *quantity : {"external work", "stored energy"})
      report.require(name + ", " + quantity,
                     value(lines[0], quantity) / value(lines[1], quantity) - 1.,
                     1e-10);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    for (const std::string scheme : {"statics", "explicit", "implicit"})
      {
        shake(report, 2, scheme, false);
        shake(report, 2, scheme, true);
        shake(report, 3, scheme, false);
      }
  });
}
