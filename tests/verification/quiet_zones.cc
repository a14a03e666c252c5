// Cells that no wave has reached are skipped, with the same results to
// round-off: elastic and granular, with and without history, from rest and from
// a stressed state, on a uniform mesh and on one that follows the waves.

#include "wave_scene.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** A pressure on a part of a side of a block, whose wave does not get to the
   *  other end. */
  SceneFile
  block(const int dim, const unsigned int degree, const std::string &rheology)
  {
    SceneFile file =
      wave_box(dim,
               degree,
               dim == 2 ? "20, 20 : 0, 0 : 1, 1 : true" :
                          "12, 6, 6 : 0, 0, 0 : 1, 0.5, 0.5 : true",
               rheology);
    file.set({"Boundaries", "left"},
             "Pressure",
             "0.03*sin(pi*t/0.1)^2*(t < 0.1)*(y < 0.3)");
    file.set({"Boundaries", "right"}, "Symmetry", "true");
    file.set({"Boundaries", "bottom"}, "Symmetry", "true");
    file.set({"Time integration"}, "End time", "0.4");
    file.set({"Output"},
             "Probe points",
             dim == 2 ? "0.1, 0.1; 0.3, 0.2" : "0.1, 0.1, 0.1");
    return file;
  }

  void
  compare(Report &report, const std::string &name, const SceneFile &file)
  {
    const auto quiet = run(file, {"Time integration/Quiet zones=true"});
    const auto all   = run(file, {"Time integration/Quiet zones=false"});
    double     share = 0., active = 0.;
    report.require(name + ", lines",
                   double(quiet.size()) - double(all.size()),
                   0.);
    // by column, of the largest entry
    double difference = 0.;
    for (const std::string column : {"kinetic energy",
                                     "stored energy",
                                     "external work",
                                     "plastic dissipation",
                                     "velocity x at probe 1",
                                     "displacement x at probe 1"})
      {
        double size = 0., most = 0.;
        for (std::size_t i = 0; i < std::min(all.size(), quiet.size()); ++i)
          {
            size = std::max(size, std::abs(value(all[i], column)));
            most = std::max(most,
                            std::abs(value(all[i], column) -
                                     value(quiet[i], column)));
          }
        if (most > 0.)
          difference = std::max(difference, most / size);
      }
    for (const auto &line : quiet)
      share += value(line, "share of quiet cells") / quiet.size();
    for (const auto &line : all)
      active = std::max(active, value(line, "share of quiet cells"));
    report.out << name << ": difference "
               << report.round_off(name + ", difference", difference, 1e-11)
               << ", quiet " << std::setprecision(2) << 100. * share << " %\n";
    report.require(name + ", quiet cells", share > 0.1 ? 0. : 1., 0.);
    report.require(name + ", none if not wanted", active, 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  for (const std::string rheology :
       {"elastic", "elastic granular", "elastic plastic granular"})
    for (const int dim : {2, 3})
      for (const unsigned int degree : {1U, 2U})
        compare(report,
                rheology + ", " + std::to_string(dim) + "D, degree " +
                  std::to_string(degree),
                block(dim, degree, rheology));
  {
    SceneFile file = block(2, 1, "elastic plastic granular");
    file.set({"Initial state"}, "Stress", "-0.01; -0.01; -0.01; 0");
    for (const std::string side : {"left", "top"})
      file.set({"Boundaries", side},
               "Pressure",
               side == "top" ? "0.01" :
                               "0.01 + 0.03*sin(pi*t/0.1)^2*(t < 0.1)");
    compare(report, "under pressure", file);
  }
  {
    // what the weight adds to the stress balances it to round-off only
    SceneFile         file     = block(2, 1, "elastic plastic granular");
    const std::string pressure = "0.01 + 0.05*(1 - y)";
    file.set({"Loads"}, "Gravity", "0; -0.05");
    file.set({"Initial state"},
             "Stress",
             "-(" + pressure + "); -(" + pressure + "); -(" + pressure +
               "); 0");
    for (const std::string side : {"left", "top"})
      file.set({"Boundaries", side},
               "Pressure",
               side == "top" ? pressure :
                               pressure + " + 0.03*sin(pi*t/0.1)^2*(t < 0.1)");
    compare(report, "under weight", file);
  }
  {
    SceneFile file = block(2, 1, "elastic granular");
    file.set({"Refinement"}, "Follow waves", "true");
    file.set({"Refinement"}, "Maximum level", "2");
    compare(report, "mesh that follows the waves", file);
  }
  return report.status();
}
