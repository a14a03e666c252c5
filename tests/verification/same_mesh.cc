// Meshes that must not change: with the place at which a periodic body is cut,
// and not at all where the indicator is round-off.

#include "box_scene.h"

using namespace Verification;

namespace
{
  SceneFile
  elastic_box(const int dim, const unsigned int n, const unsigned int p)
  {
    SceneFile file = box_scene(dim, n, p);
    file.set({"Geometry"}, "Distortion", "0");
    const SceneFile::Path stuff = {"Materials", "stuff"};
    file.set(stuff, "Rheology", "elastic");
    file.set(stuff, "Young modulus", "1e6");
    file.set(stuff, "Poisson ratio", "0.3");
    file.set(stuff, "Density", "1000");
    return file;
  }

  /** A periodic layer with a stiff inclusion, which begins at @p x: as sheets
   *  in space, too. */
  SceneFile
  layer(const int dim, const double x)
  {
    SceneFile         file = elastic_box(dim, dim == 2 ? 8 : 4, 1);
    const std::string up   = dim == 2 ? "y" : "z";
    file.set({"Geometry"}, "Periodic boundaries", "left: right");
    file.set({"Geometry"},
             "Material ids",
             "1: x > " + text(x) + " && x < " + text(x + 0.25) + " && abs(" +
               up + " - 0.5) < 0.26");
    const SceneFile::Path stiff = {"Materials", "stiff"};
    file.set(stiff, "Material id", "1");
    file.set(stiff, "Rheology", "elastic");
    file.set(stiff, "Young modulus", "1e8");
    file.set(stiff, "Poisson ratio", "0.3");
    file.set(stiff, "Density", "1000");
    file.set({"Boundaries", "bottom"}, "Displacement x", "0");
    file.set({"Boundaries", "bottom"}, "Displacement " + up, "0");
    if (dim == 3)
      for (const std::string side : {"front", "back"})
        file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Loads"}, "Gravity", dim == 2 ? "3; -10" : "3; 0; -10");
    file.set({"Refinement"}, "Cycles in first step", dim == 2 ? "5" : "2");
    file.set({"Refinement"}, "Maximum level", "6");
    file.set({"Refinement"}, "Refine fraction", "0.3");
    return file;
  }

  void
  periodic(Report &report, const int dim)
  {
    double cells = 0., estimate = 0.;
    for (const double x : {0., 0.5, 0.75})
      {
        const auto line = run(layer(dim, x)).back();
        if (x == 0.)
          {
            cells    = value(line, "cells");
            estimate = value(line, "estimated error");
          }
        report.require("refined", cells > 64. ? 0. : 1., 0.);
        report.require("cells of the layer cut elsewhere",
                       value(line, "cells") - cells,
                       0.);
        report.require("estimated error of the layer cut elsewhere",
                       value(line, "estimated error") / estimate - 1.,
                       1e-6);
      }
  }

  /** A block that is uniformly compressed, or only carried along. */
  void
  uniform(Report            &report,
          const int          dim,
          const std::string &what,
          const std::string &displacement,
          const std::string &pressure)
  {
    SceneFile         file    = elastic_box(dim, 4, dim == 2 ? 2 : 1);
    const std::string axes    = dim == 2 ? "xy" : "xyz";
    const std::string near[3] = {"left",
                                 dim == 2 ? "bottom" : "front",
                                 "bottom"};
    const std::string far[3]  = {"right", dim == 2 ? "top" : "back", "top"};
    for (int d = 0; d < dim; ++d)
      {
        file.set({"Boundaries", near[d]},
                 std::string("Displacement ") + axes[d],
                 displacement);
        file.set({"Boundaries", far[d]}, "Pressure", pressure);
      }
    file.set({"Refinement"}, "Cycles in first step", "3");
    const auto line = run(file).back();
    report.require(what + ": cells",
                   value(line, "cells") - std::pow(4., dim),
                   0.);
  }

  /** The same at rest in dynamics. */
  void
  at_rest(Report &report, const std::string &stress)
  {
    SceneFile file = elastic_box(2, 4, 1);
    file.set({}, "Analysis", "dynamics");
    file.set({"Initial state"}, "Stress", stress);
    file.set({"Boundaries", "left"}, "Symmetry", "true");
    file.set({"Boundaries", "bottom"}, "Symmetry", "true");
    file.set({"Boundaries", "right"}, "Pressure", "1e5/3");
    file.set({"Boundaries", "top"}, "Pressure", "2e5/3");
    file.set({"Refinement"}, "Follow waves", "true");
    file.set({"Refinement"}, "Maximum level", "3");
    file.set({"Time integration"}, "End time", "0.02");
    file.remove({"Newton"}, "");
    const auto line = run(file).back();
    report.require("at rest: cells", value(line, "cells") - 16., 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    periodic(report, 2);
    periodic(report, 3);
    for (const int dim : {2, 3})
      {
        uniform(report, dim, "pressed", "0", "1e5/3");
        uniform(report, dim, "carried", "1/3", "0");
        uniform(report, dim, "carried and pressed", "1/3", "1e2/3");
      }
    at_rest(report, "-1e5/3; -2e5/3; -1e5/3; 0");
  });
}
