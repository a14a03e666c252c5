// The energy receipt closes to round-off in explicit runs whatever meets at a
// corner: prescribed motions, symmetry, absorbing boundaries, loads; and what is
// written does not depend on how often statistics are, also with dampers and
// hinges, whose answer depends on the step. What the steps lose, the one entry
// that no other number stands for, falls with their square.

#include "wave_scene.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  SceneFile
  block(const int dim, const unsigned int degree, const std::string &rheology)
  {
    SceneFile file =
      wave_box(dim,
               degree,
               dim == 2 ? "8, 6 : 0, 0 : 1, 0.75 : true" :
                          "4, 3, 3 : 0, 0, 0 : 1, 0.75, 0.75 : true",
               rheology);
    file.set({"Geometry"}, "Distortion", "0.1");
    file.set({"Time integration"}, "End time", "0.8");
    return file;
  }

  const std::string viscous =
    "parallel(spring(bulk = 1, shear = 0.6), damper(shear viscosity = 0.05))";

  void
  corners(Report &report, const int dim, const unsigned int degree)
  {
    for (const std::string side : {"Velocity x", "Displacement y", "Symmetry"})
      for (const std::string rheology : {"elastic", "elastic plastic granular"})
        {
          SceneFile file = block(dim, degree, rheology);
          file.set({"Boundaries", "left"},
                   side,
                   side[0] == 'V' ? "0.02*sin(4*t)" :
                   side[0] == 'D' ? "0.01*sin(3*t)" :
                                    "true");
          file.set({"Boundaries", "top"}, "Absorbing", "closed");
          file.set({"Boundaries", "top"},
                   "Pressure",
                   "0.01*(t < 0.2)*(x < 0.5)");
          file.set({"Boundaries", "right"}, "Absorbing", "closed");
          file.set({"Boundaries", "bottom"}, "Symmetry", "true");
          double gap = 0.;
          for (const auto &line : run(file))
            gap = std::max(gap, std::abs(value(line, "energy gap")));
          std::ostringstream name;
          name << dim << "D, degree " << degree << ", " << rheology << ", "
               << side;
          report.out << name.str() << ": gap "
                     << report.round_off(name.str(), gap, 1e-12) << '\n';
        }
  }

  /** The entry for what steps lose, where nothing dissipates. */
  void
  lost_by_steps(Report &report)
  {
    SceneFile file = block(2, 1, "elastic");
    file.set({"Boundaries", "left"}, "Velocity x", "0.02*sin(4*t)^2");
    file.set({"Boundaries", "right"}, "Symmetry", "true");
    std::vector<double> lost;
    for (const std::string safety : {"0.8", "0.4", "0.2"})
      {
        double most = 0., work = 0.;
        for (const auto &line :
             run(file, {"Time integration/Safety=" + safety}))
          {
            most =
              std::max(most, std::abs(value(line, "lost by time stepping")));
            work = std::max(work, value(line, "external work"));
          }
        lost.push_back(most / work);
      }
    report.out << "lost by time stepping, part of the work:"
               << std::setprecision(2);
    for (const double part : lost)
      report.out << ' ' << part;
    report.out << '\n';
    report.require("lost by time stepping", lost[0], 0.01);
    for (unsigned int i = 1; i < 3; ++i)
      report.require_order("lost by time stepping",
                           std::log2(lost[i - 1] / lost[i]),
                           1.8);
  }

  void
  sampling(Report &report, const std::string &name, const std::string &rheology)
  {
    SceneFile file = block(2, 1, rheology);
    file.set({"Boundaries", "left"}, "Velocity x", "0.05*sin(8*t)");
    file.set({"Boundaries", "right"}, "Symmetry", "true");
    file.set({"Output"}, "Probe lines", "0, 0.3 : 1, 0.3 : 20");
    file.set({"Output"}, "Probe line samples", "10");
    std::vector<std::vector<PhysicalNumbers::Line>> lines;
    for (const std::string every : {"1", "7"})
      {
        run(file, {"Time integration/Statistics every=" + every});
        lines.push_back(PhysicalNumbers::read("results/line-1.csv"));
      }
    double difference = 0., size = 0.;
    report.require(name + ", lines",
                   double(lines[0].size()) - double(lines[1].size()),
                   0.);
    for (std::size_t i = 0; i < std::min(lines[0].size(), lines[1].size()); ++i)
      for (std::size_t j = 0; j < lines[0][i].size(); ++j)
        if (lines[0][i][j].first.rfind("stress", 0) == 0)
          {
            size = std::max(size, std::abs(lines[0][i][j].second));
            difference =
              std::max(difference,
                       std::abs(lines[0][i][j].second - lines[1][i][j].second));
          }
    report.require(name + ", a stress", size > 1e-3 ? 0. : 1., 0.);
    report.out << "stress on a line, " << name << ": "
               << report.round_off(name + ", stress", difference / size, 1e-7)
               << '\n';
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  for (const unsigned int degree : {1U, 2U})
    corners(report, 2, degree);
  corners(report, 3, 1);
  lost_by_steps(report);
  sampling(report, "damper", viscous);
  sampling(report, "hinge", "elastic plastic granular");
  return report.status();
}
