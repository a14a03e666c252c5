// Points next to a curved boundary that the mesh leaves outside as it is
// refined: the nearest point of the body takes their place, or the run is
// refused. A force on one still acts in full.

#include "shell_scene.h"

using namespace Verification;
using namespace Signoton;

namespace
{
  /** A ring under inner pressure, three coarse cells on a quarter: the mesh of
   *  straight cells begins inside of the hole. */
  SceneFile
  ring(const unsigned int degree)
  {
    SceneFile file = quarter_shell("1 : 2", degree);
    file.set({"Boundaries", "inner"}, "Pressure", "1");
    file.set({"Load steps"}, "Step size", "1");
    file.set({"Refinement"}, "Cycles in first step", "3");
    file.set({"Refinement"}, "Refine fraction", "1");
    file.set({"Refinement"}, "Coarsen fraction", "0");
    return file;
  }

  /** What a scene is refused by, if it is. */
  std::string
  refusal(const SceneFile &file)
  {
    try
      {
        run(file);
      }
    catch (const UserError &error)
      {
        return error.what();
      }
    return "";
  }

  /** In the middle of a chord, on either side of the arc. */
  SceneFile
  with_probes(const unsigned int degree)
  {
    SceneFile file = ring(degree);
    file.set({"Output"}, "Probe points", "0.93728, 0.25114; 1.5, 0.1");
    file.set({"Output"}, "Probe quantities", "displacement, stress");
    return file;
  }

  void
  probes(Report &report)
  {
    // u = p a^2/(E (b^2 - a^2)) (1 + nu) ((1 - 2 nu) r + b^2/r)
    const double exact = 1.3 / 3000. * (0.4 + 4.);
    const auto   line  = run(with_probes(2)).back();
    const double u     = std::hypot(value(line, "displacement x at probe 1"),
                                value(line, "displacement y at probe 1"));
    report.require("displacement at the rim", u / exact - 1., 0.01);
    const double trace =
      value(line, "stress xx at probe 1") + value(line, "stress yy at probe 1");
    report.require("sum of stresses, 2 p a^2/(b^2 - a^2)",
                   trace - 2. / 3.,
                   0.1);

    SceneFile strict = with_probes(1);
    strict.set({"Discretization"}, "Points outside", "refuse");
    const std::string words = refusal(strict);
    report.require("refused with its key",
                   words.find("Probe points") != std::string::npos &&
                       words.find("0.93728") != std::string::npos ?
                     0. :
                     1.,
                   0.);
    SceneFile fixed = strict;
    fixed.set({"Refinement"}, "Cycles in first step", "0");
    report.require("accepted on the coarse mesh",
                   refusal(fixed).empty() ? 0. : 1.,
                   0.);
  }

  /** A force in the middle of a chord, inside of the arc. */
  void
  forces(Report &report)
  {
    SceneFile file = ring(1);
    file.set({"Boundaries", "inner"}, "Pressure", "0");
    file.set({"Point forces", "push"}, "Point", "0.93728, 0.25114");
    file.set({"Point forces", "push"}, "Force", "3; 2");
    const auto line = run(file).back();
    report.require("refined", value(line, "cells") >= 100. ? 0. : 1., 0.);
    // by symmetry planes: x = 0 carries x, y = 0 carries y
    double x = 0., y = 0.;
    for (const std::string side : {"plane x", "plane y"})
      {
        x += value(line, "reaction " + side + " x");
        y += value(line, "reaction " + side + " y");
      }
    report.require("balance of the force in x", x + 3., 1e-7);
    report.require("balance of the force in y", y + 2., 1e-7);
    file.set({"Discretization"}, "Points outside", "refuse");
    report.require("force refused with its key",
                   refusal(file).find("Point forces / push / Point") !=
                       std::string::npos ?
                     0. :
                     1.,
                   0.);
  }

  /** As close to one face as to the next: whoever has them, one is taken. */
  void
  tie(Report &report)
  {
    SceneFile file = ring(1);
    file.set({"Boundaries", "inner"}, "Pressure", "0");
    file.set({"Point forces", "push"}, "Point", "0.68, 0.68");
    file.set({"Point forces", "push"}, "Force", "3; 0");
    file.set({"Refinement"}, "Cycles in first step", "1");
    const auto line = run(file).back();
    report.out << "tie, " << value(line, "cells")
               << " cells: " << value(line, "external work") << std::endl;
  }

  /** What is outside at the start. */
  void
  at_the_start(Report &report)
  {
    SceneFile file = ring(2);
    file.set({"Refinement"}, "Cycles in first step", "0");
    file.set({"Point forces", "push"}, "Force", "3; 2");
    const auto refused = [&](const std::string &point) {
      file.set({"Point forces", "push"}, "Point", point);
      return !refusal(file).empty();
    };
    report.require("on the outer arc",
                   refused("1.8, 0.8717797887") ? 1. : 0.,
                   0.);
    report.require("on the axis, a digit short",
                   refused("1.5, -1e-5") ? 1. : 0.,
                   0.);
    report.require("below the flat boundary",
                   refused("1.5, -0.05") ? 0. : 1.,
                   0.);
    report.require("in the hole", refused("0.3, 0.3") ? 0. : 1., 0.);
    report.require("far away", refused("7, 7") ? 0. : 1., 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    probes(report);
    forces(report);
    tie(report);
    at_the_start(report);
  });
}
