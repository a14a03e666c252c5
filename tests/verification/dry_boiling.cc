// A column on a shaking base: at 0.97 of the amplitude A w^2 = g |cos(w L/c)| it
// stays closed and moves as the exact standing wave, at 1.05 voids open. Four
// frequencies, in 2D, and one in 3D.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** The column of the shipped scene, of a square section in 3D with the third
   *  axis up. */
  SceneFile
  column(const int dim)
  {
    SceneFile file =
      SceneFile::read(source_directory + "/prm/periodic_loading.prm");
    file.set({"Output"}, "Probe lines", "");
    if (dim == 2)
      return file;
    file.set({}, "Dimension", "3");
    file.set({"Geometry"},
             "Arguments",
             "1, 1, 60 : 0, 0, 0 : 0.01, 0.01, 1 : true");
    file.set({"Loads"}, "Gravity", "0; 0; -g");
    file.set({"Initial state"}, "Stress", "0; 0; -g*(1 - z); 0; 0; 0");
    file.set({"Initial state"},
             "Velocity",
             "0; 0; ratio*g*abs(cos(w))/w*cos(w*(1 - z))/cos(w)");
    file.remove({"Boundaries", "bottom"});
    file.set({"Boundaries", "bottom"},
             "Displacement z",
             "ratio*g*abs(cos(w))/w^2*sin(w*t)");
    for (const char *side : {"front", "back"})
      file.set({"Boundaries", side}, "Symmetry", "true");
    file.set({"Output"}, "Probe points", "0, 0, 1; 0, 0, 0.5");
    return file;
  }

  void
  threshold(Report &report, const int dim, const double w)
  {
    const double      g = 0.01, period = 2. * numbers::PI / w;
    const std::string axis = dim == 2 ? "y" : "z";
    for (const double ratio : {0.97, 1.05})
      {
        std::ostringstream constants, end;
        constants << "Loads/Constants=w = " << w
                  << ", g = 0.01, ratio = " << ratio;
        end << "Time integration/End time=" << std::setprecision(10)
            << 2. * period;
        const auto lines = run(column(dim), {constants.str(), end.str()});
        double     voids = 0., difference = 0., size = 0.;
        for (const auto &line : lines)
          {
            voids = std::max(voids, value(line, "volume of voids"));
            const double exact = ratio * g / (w * w) *
                                 std::sin(w * value(line, "time")) *
                                 (std::cos(w) > 0. ? 1. : -1.);
            difference =
              std::max(difference,
                       std::abs(
                         value(line, "displacement " + axis + " at probe 1") -
                         exact));
            size = std::max(size, std::abs(exact));
          }
        // of the volume, relative to the largest strain at rest
        voids /= (dim == 2 ? 0.01 : 1e-4) * g;
        std::ostringstream name;
        name << dim << "D, w = " << w << ", " << ratio;
        report.out << name.str() << " of the threshold: ";
        if (ratio < 1.)
          {
            report.out << "closed "
                       << report.round_off(name.str() + ", voids", voids, 1e-8)
                       << ", displacement of the top off by "
                       << std::setprecision(1) << difference / size << '\n';
            report.require(name.str() + ", exact motion",
                           difference / size,
                           0.02);
          }
        else
          {
            report.out << "voids " << std::setprecision(2) << voids << '\n';
            report.require(name.str() + ", voids",
                           std::max(1e-3 - voids, 0.),
                           0.);
          }
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  for (const double w : {0.5, 1., 2., 3.})
    threshold(report, 2, w);
  threshold(report, 3, 1.);
  return report.status();
}
