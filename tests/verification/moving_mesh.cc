// A mesh that follows waves: on a free body, elastic and granular, of degree 1
// and 2, in 2D, 3D and axisymmetry, also of curved and distorted cells, momentum
// stays to round-off through refinement and coarsening, and no change of the
// mesh gains energy; the receipt closes. The waves of a pulse are those of a
// uniform mesh of the finest cells, for a part of its unknowns.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** A body that nothing holds, with a bump of velocity that moves away and
   *  spreads. */
  SceneFile
  free_body(const int          dim,
            const unsigned int degree,
            const bool         granular,
            const std::string &kind)
  {
    SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    const bool box = kind != "disk";
    file.set({"Geometry"},
             "Generator",
             box ? "subdivided_hyper_rectangle" : "hyper_ball");
    file.set({"Geometry"},
             "Arguments",
             !box     ? "0.5, 0.5 : 0.5 : true" :
             dim == 2 ? "4, 4 : 0, 0 : 1, 1 : true" :
                        "3, 3, 3 : 0, 0, 0 : 1, 1, 1 : true");
    if (kind == "axisymmetric")
      file.set({}, "Embedding", kind);
    if (kind == "loosened")
      file.set({"Initial state"},
               "Strain",
               "0.02*(x > 0.5); 0.02*(x > 0.5); 0.02*(x > 0.5); 0");
    file.set({"Geometry"}, "Initial refinement", "1");
    if (kind == "distorted")
      file.set({"Geometry"}, "Distortion", "0.2");
    file.set({"Discretization"}, "Degree", std::to_string(degree));
    const SceneFile::Path sand = {"Materials", "sand"};
    file.set(sand,
             "Rheology",
             granular ? "elastic plastic granular" : "elastic");
    if (granular)
      {
        file.set(sand, "Friction parameter", "0.6");
        file.set(sand, "Shear strength", "0.01");
        file.set(sand, "Binder", "proportional");
        file.set(sand, "Binder ratio", "0.05");
      }
    file.set(sand, "Bulk modulus", "1");
    file.set(sand, "Shear modulus", "0.6");
    file.set(sand, "Density", "1");
    const std::string bump = "*exp(-100*((x-0.4)^2+(y-0.4)^2" +
                             std::string(dim == 3 ? "+(z-0.4)^2" : "") + "))";
    file.set({"Initial state"},
             "Velocity",
             (kind == "axisymmetric" ? "0.00" : "0.02") + bump + "; 0.05" +
               bump + (dim == 3 ? "; 0.03" + bump : ""));
    file.set({"Time integration"}, "End time", dim == 3 ? "0.4" : "0.6");
    file.set({"Refinement"}, "Follow waves", "true");
    file.set({"Refinement"}, "Every", "5");
    file.set({"Refinement"}, "Maximum level", dim == 3 ? "2" : "3");
    file.set({"Refinement"}, "Refine threshold", "0.5");
    file.set({"Refinement"}, "Coarsen threshold", "0.25");
    return file;
  }

  void
  conservation(Report            &report,
               const int          dim,
               const unsigned int degree,
               const bool         granular,
               const std::string &kind,
               const std::string &scheme = "explicit")
  {
    std::ostringstream name;
    name << dim << "D, degree " << degree << ", "
         << (granular ? "granular" : "elastic") << ", " << kind << ", "
         << scheme;
    Overrides overrides = {"Time integration/Scheme=" + scheme};
    if (scheme == "implicit")
      overrides.emplace_back("Time integration/Time step=0.01");
    const auto lines =
      Verification::run(free_body(dim, degree, granular, kind), overrides);
    double drift = 0., gap = 0., gain = 0., most = 0., least = 1e300,
           initial    = 0.;
    bool        grows = false, shrinks = false;
    const char *axes[] = {"momentum x", "momentum y", "momentum z"};
    // on an axis only the momentum along it is one of the body
    const int first = kind == "axisymmetric" ? 1 : 0;
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const double size = std::abs(value(lines[0], "momentum y"));
        for (int d = first; d < dim; ++d)
          drift = std::max(drift,
                           std::abs(value(lines[i], axes[d]) -
                                    value(lines[0], axes[d])) /
                             size);
        gap = std::max(gap, std::abs(value(lines[i], "energy gap")));
        // cells that resolve the initial fields see the same ones
        initial            = std::max(initial,
                           std::abs(value(lines[i], "initial energy") /
                                      value(lines[0], "initial energy") -
                                    1.));
        const double cells = value(lines[i], "cells");
        most               = std::max(most, cells);
        least              = std::min(least, cells);
        if (i > 0)
          {
            grows |= cells > value(lines[i - 1], "cells");
            shrinks |= cells < value(lines[i - 1], "cells");
            gain = std::max(gain,
                            (value(lines[i - 1], "lost by transfer") -
                             value(lines[i], "lost by transfer")) /
                              value(lines[0], "initial energy"));
          }
      }
    report.out << name.str() << ": cells from " << least << " to " << most
               << ", momentum "
               << report.round_off(name.str() + ", momentum", drift, 1e-12)
               << ", energy gap "
               << report.round_off(name.str() + ", gap", gap, 1e-8)
               << ", initial energy "
               << report.round_off(name.str() + ", initial", initial, 1e-12)
               << ", energy gained "
               << report.round_off(name.str() + ", gain", gain, 1e-13)
               << ", lost " << std::setprecision(2)
               << value(lines.back(), "lost by transfer") /
                    value(lines[0], "initial energy")
               << '\n';
    report.require(name.str() + ", a mesh that changes",
                   grows || shrinks ? 0. : 1.,
                   0.);
    // what is lost is a matter of the thresholds, here coarse ones
    report.require(name.str() + ", energy lost by changes of the mesh",
                   value(lines.back(), "lost by transfer") /
                     value(lines[0], "initial energy"),
                   0.3);
  }

  /** Dampers in parallel with a spring, whose history and strain are both
   *  interpolated: a change of the mesh is no jerk. What the uniform mesh
   *  dissipates, the moving one does, too. */
  void
  viscous(Report &report)
  {
    SceneFile file = free_body(2, 1, false, "box");
    file.set({"Materials", "sand"},
             "Rheology",
             "parallel(spring(bulk = 1, shear = 0.6), damper(shear viscosity "
             "= 0.01))");
    file.remove({"Materials", "sand"}, "Bulk modulus");
    file.remove({"Materials", "sand"}, "Shear modulus");
    const auto moving = run(file).back();
    const auto uniform =
      run(file,
          {"Refinement/Follow waves=false", "Geometry/Initial refinement=3"})
        .back();
    report.out << "viscous: dissipated " << std::setprecision(2)
               << value(moving, "viscous dissipation") << ", on a uniform mesh "
               << value(uniform, "viscous dissipation")
               << ", lost by time stepping "
               << value(moving, "lost by time stepping") << ", "
               << value(uniform, "lost by time stepping") << '\n';
    report.require("viscous dissipation",
                   value(moving, "viscous dissipation") /
                       value(uniform, "viscous dissipation") -
                     1.,
                   0.02);
    report.require("lost by time stepping",
                   (value(moving, "lost by time stepping") -
                    value(uniform, "lost by time stepping")) /
                     value(moving, "initial energy"),
                   2e-3);
    report.require("gap", value(moving, "energy gap"), 1e-8);
  }

  /** Waves that leave through a periodic boundary come in at the other one, and
   *  the mesh is ready there: all is as where the body is cut elsewhere. */
  void
  periodic(Report &report, const int dim)
  {
    std::vector<std::vector<PhysicalNumbers::Line>> runs;
    // lengths that binary numbers do not have
    for (const std::string x : {"(x-0.35)", "min(x, 0.7-x)"})
      {
        SceneFile file = free_body(dim, 1, true, "box");
        file.set({"Geometry"},
                 "Arguments",
                 dim == 2 ? "4, 6 : 0, 0 : 0.7, 1 : true" :
                            "4, 2, 2 : 0, 0, 0 : 0.7, 0.35, 0.35 : true");
        file.set({"Geometry"},
                 "Periodic boundaries",
                 dim == 2 ? "left: right" : "left: right; front: back");
        file.set({"Refinement"}, "Maximum level", dim == 3 ? "2" : "4");
        const std::string bump = "*exp(-100*(" + x + "^2+(y-0.4)^2" +
                                 (dim == 3 ? "+(z-0.2)^2" : "") + "))";
        file.set({"Initial state"},
                 "Velocity",
                 "0.02" + bump + "; 0.05" + bump + (dim == 3 ? "; 0" : ""));
        runs.push_back(run(file));
      }
    report.require("steps",
                   double(runs[0].size()) - double(runs[1].size()),
                   0.);
    double cells = 0., energy = 0., most = 0., gap = 0.;
    for (std::size_t i = 0; i < std::min(runs[0].size(), runs[1].size()); ++i)
      {
        const auto difference = [&](const std::string &column) {
          return std::abs(value(runs[0][i], column) -
                          value(runs[1][i], column));
        };
        cells  = std::max(cells, difference("cells"));
        most   = std::max(most, value(runs[0][i], "cells"));
        energy = std::max(energy,
                          difference("kinetic energy") /
                            value(runs[0][0], "initial energy"));
        for (const auto &lines : runs)
          gap = std::max(gap, std::abs(value(lines[i], "energy gap")));
      }
    report.out << dim << "D, across a periodic boundary: up to " << most
               << " cells, as elsewhere but for " << cells << ", energy "
               << report.round_off("energy", energy, 1e-12) << '\n';
    report.require("cells", cells, 0.);
    report.require("gap", gap, 1e-8);
  }

  /** The pulse of the shipped scene before and in the loosened inclusion, on
   *  its moving mesh and on one of finest cells: near, and the nearer the finer
   *  the thresholds; and so if the mesh changes often, since the viscous stress
   *  at fronts goes along. */
  void
  against_uniform(Report &report)
  {
    const SceneFile file =
      SceneFile::read(source_directory + "/prm/loosened_block.prm");
    const Overrides common = {"Refinement/Maximum level=3",
                              "Output/Probe lines=",
                              "Time integration/Statistics every=5",
                              "Output/Probe points=0, 0.8; 0, 0.6; 0.6, 0.5"};
    const auto      run    = [&](const Overrides &more) {
      Overrides all = common;
      all.insert(all.end(), more.begin(), more.end());
      return Verification::run(file, all);
    };
    const auto uniform =
      run({"Refinement/Follow waves=false", "Geometry/Initial refinement=3"});
    const auto difference = [&](const auto &lines) {
      double result = 0., size = 0.;
      for (std::size_t i = 0; i < std::min(lines.size(), uniform.size()); ++i)
        for (const std::string column : {"velocity y at probe 1",
                                         "velocity y at probe 2",
                                         "velocity x at probe 3"})
          {
            result +=
              std::abs(value(lines[i], column) - value(uniform[i], column));
            size += std::abs(value(uniform[i], column));
          }
      return result / size;
    };
    const auto lost = [](const auto &lines) {
      return value(lines.back(), "lost by time stepping") /
             value(lines.back(), "external work");
    };
    double old_difference = 1e300;
    for (const std::string threshold : {"0.4", "0.1", "0.02"})
      {
        const auto lines =
          run({"Refinement/Refine threshold=" + threshold,
               "Refinement/Coarsen threshold=" +
                 std::to_string(0.2 * std::atof(threshold.c_str()))});
        const double of_run = difference(lines);
        const double part   = value(lines.back(), "unknowns by steps") /
                            value(uniform.back(), "unknowns by steps");
        report.out << "threshold " << threshold
                   << ": velocities differ from the uniform mesh by "
                   << std::setprecision(2) << of_run << ", unknowns by steps "
                   << part << '\n';
        report.require("steps",
                       double(lines.size()) - double(uniform.size()),
                       0.);
        report.require("threshold " + threshold + ", difference", of_run, 0.02);
        report.require("threshold " + threshold + ", of the one before",
                       of_run / old_difference,
                       1.);
        report.require("unknowns by steps", part, 0.6);
        old_difference = of_run;
      }
    const auto often = run({"Refinement/Every=5",
                            "Refinement/Refine threshold=0.002",
                            "Refinement/Coarsen threshold=0.0004"});
    report.out << "a change every five steps: velocities differ by "
               << std::setprecision(2) << difference(often)
               << ", lost by time stepping " << lost(often)
               << " of the work, on a uniform mesh " << lost(uniform) << '\n';
    report.require("many changes, difference", difference(often), 0.02);
    report.require("many changes, lost by time stepping",
                   lost(often) - lost(uniform),
                   3e-3);
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  for (const bool granular : {false, true})
    for (const unsigned int degree : {1U, 2U})
      {
        conservation(report, 2, degree, granular, "box");
        conservation(report, 2, degree, granular, "distorted");
        conservation(report, 2, degree, granular, "disk");
        conservation(report, 2, degree, granular, "axisymmetric");
        if (granular)
          conservation(report, 2, degree, granular, "loosened");
      }
  conservation(report, 3, 1, false, "box");
  conservation(report, 3, 1, true, "distorted");
  conservation(report, 3, 2, false, "box");
  conservation(report, 2, 1, true, "box", "implicit");
  conservation(report, 2, 2, false, "box", "implicit");
  viscous(report);
  periodic(report, 2);
  periodic(report, 3);
  against_uniform(report);
  return report.status();
}
