// Generalized alpha: order 2 in time on a standing wave of a bar, elastic and
// of grains under pressure or loose on their binder, for several spectral radii
// and dimensions, as central differences have it; order 1 with dampers. The same answer as central
// differences where both resolve the wave, on signotons and with yielding
// grains, dashpots and a moving boundary, and as statics where loads are slow;
// steps by local error.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  SceneFile
  read(const std::string &scene)
  {
    return SceneFile::read(source_directory + "/" + scene);
  }

  /** A bar between two planes of symmetry: its ends do not move, and what was
   *  a sine stays one, $u=A\sin(\pi x)\cos(\pi ct)$. */
  SceneFile
  standing_wave(const int dim, const std::string &kind)
  {
    SceneFile         file;
    const std::string zeros = dim == 2 ? "; 0" : "; 0; 0";
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             dim == 2 ? "48, 1 : 0, 0 : 1, 0.1 : true" :
                        "48, 1, 1 : 0, 0, 0 : 1, 0.1, 0.1 : true");
    file.set({"Discretization"}, "Degree", "2");
    const SceneFile::Path bar = {"Materials", "bar"};
    if (kind == "closed")
      {
        // the stress of the wave stays inside the cone
        file.set(bar, "Rheology", "elastic granular");
        file.set(bar, "Admissible set", "coulomb mohr");
        file.set(bar, "Friction angle", "60");
        file.set({"Initial state"},
                 "Stress",
                 dim == 2 ? "-1; -1; -1; 0" : "-1; -1; -1; 0; 0; 0");
      }
    if (kind == "open")
      {
        // so loose that the wave does not close the pores: the binder has it
        file.set(bar, "Rheology", "elastic granular");
        file.set(bar, "Admissible set", "no tension");
        file.set(bar, "Young modulus", "4.32");
        file.set(bar, "Poisson ratio", "0");
        file.set(bar, "Binder", "proportional");
        file.set(bar, "Binder ratio", "0.25");
        file.set({"Initial state"},
                 "Strain",
                 dim == 2 ? "1; 0; 0; 0" : "1; 0; 0; 0; 0; 0");
      }
    else
      {
        if (kind == "elastic")
          file.set(bar, "Rheology", kind);
        file.set(bar, "Young modulus", "0.9");
        file.set(bar, "Poisson ratio", "0.25"); // k + 4 mu / 3 = 1.08
      }
    file.set(bar, "Density", "1.08");
    for (const std::string &name :
         dim == 2 ? std::vector<std::string>{"left", "right", "bottom", "top"} :
                    std::vector<std::string>{
                      "left", "right", "front", "back", "bottom", "top"})
      file.set({"Boundaries", name}, "Symmetry", "true");
    file.set({"Initial state"}, "Velocity", "0.1*pi*sin(pi*x)" + zeros);
    file.set({"Reference solution"},
             "Displacement",
             "0.1*sin(pi*x)*sin(pi*t)" + zeros);
    file.set({"Reference solution"},
             "Velocity",
             "0.1*pi*sin(pi*x)*cos(pi*t)" + zeros);
    file.set({"Time integration"}, "Scheme", "implicit");
    file.set({"Time integration"}, "Linear shock viscosity", "0");
    file.set({"Time integration"}, "Quadratic shock viscosity", "0");
    file.set({"Time integration"}, "End time", "1.25");
    return file;
  }

  void
  order(Report &report)
  {
    report.out << "Standing wave: error in L2 of the displacement, in L1 of "
                  "the velocity\n";
    for (const int dim : {2, 3})
      for (const std::string kind : {"elastic", "closed", "open"})
        for (const double radius : {1., 0.8, 0.})
          {
            if (dim == 3 && (radius > 0.9 || radius < 0.1))
              continue;
            std::vector<double> errors, velocity_errors;
            double              gap = 0.;
            for (const int steps : {50, 100, 200})
              {
                const auto lines = run(standing_wave(dim, kind),
                                       {"Time integration/Time step=" +
                                          std::to_string(1.25 / steps),
                                        "Time integration/Spectral radius=" +
                                          std::to_string(radius)});
                errors.push_back(value(lines.back(), "relative L2 error"));
                velocity_errors.push_back(
                  value(lines.back(), "relative L1 error of velocity"));
                gap =
                  std::max(gap, std::abs(value(lines.back(), "energy gap")));
              }
            std::ostringstream name;
            name << dim << "D, " << kind << ", radius " << radius;
            report.out << name.str() << ": " << std::setprecision(3);
            for (const double e : errors)
              report.out << e << ' ';
            report.out << "| ";
            for (const double e : velocity_errors)
              report.out << e << ' ';
            report.out << '\n';
            for (const auto &e : {errors, velocity_errors})
              report.require_order(name.str(), std::log2(e[1] / e[2]), 1.9);
            report.require(name.str() + ", energy gap", gap, 1e-8);
          }
  }

  /** Central differences on the standing wave: what steps of different size
   *  differ in is of order 2. */
  void
  explicit_order(Report &report)
  {
    report.out << "Standing wave, explicit: error in time of a displacement\n";
    for (const std::string kind : {"elastic", "closed", "open"})
      {
        SceneFile file = standing_wave(2, kind);
        file.set({"Time integration"}, "Scheme", "explicit");
        file.set({"Output"}, "Probe points", "0.5, 0");
        std::vector<double> u;
        for (const int steps : {8000, 1000, 2000, 4000})
          u.push_back(value(run(file,
                                {"Time integration/Statistics every=100",
                                 "Time integration/Time step=" +
                                   std::to_string(1.25 / steps)})
                              .back(),
                            "displacement x at probe 1"));
        report.out << kind << ": " << std::setprecision(3);
        for (unsigned int i = 1; i < 4; ++i)
          report.out << (u[i] - u[0]) / u[0] << ' ';
        report.out << '\n';
        for (unsigned int i = 1; i < 3; ++i)
          report.require_order(kind + ", explicit",
                               std::log2((u[i] - u[0]) / (u[i + 1] - u[0])),
                               1.9);
      }
  }

  /** A spring with a damper in parallel: the standing wave dies out as
   *  $e^{-\delta t}\sin\omega t$, $\delta=\frac43\eta\pi^2/(2\rho)$. */
  void
  damped(Report &report)
  {
    report.out << "Damped standing wave: error in L2 of the displacement\n";
    const double eta = 0.081, rho = 1.08, pi = numbers::PI,
                 delta = 4. / 3. * eta * pi * pi / (2. * rho),
                 omega = std::sqrt(pi * pi - delta * delta);
    std::ostringstream motion, rate;
    motion << std::setprecision(17) << "0.1*sin(pi*x)*exp(-" << delta
           << "*t)*sin(" << omega << "*t); 0";
    rate << std::setprecision(17) << 0.1 * omega << "*sin(pi*x); 0";
    for (const std::string scheme : {"implicit", "explicit"})
      {
        SceneFile             file = standing_wave(2, "elastic");
        const SceneFile::Path bar  = {"Materials", "bar"};
        file.set(bar,
                 "Rheology",
                 "parallel(spring(bulk = 0.6, shear = 0.36), damper(shear "
                 "viscosity = 0.081))");
        file.remove(bar, "Young modulus");
        file.remove(bar, "Poisson ratio");
        file.set({"Initial state"}, "Velocity", rate.str());
        file.set({"Reference solution"}, "Displacement", motion.str());
        file.remove({"Reference solution"}, "Velocity");
        file.set({"Time integration"}, "Scheme", scheme);
        if (scheme == "explicit") // dampers are stiff on fine cells
          file.set({"Geometry"}, "Arguments", "12, 1 : 0, 0 : 1, 0.1 : true");
        std::vector<double> errors;
        for (const int steps : {500, 1000, 2000})
          errors.push_back(value(run(file,
                                     {"Time integration/Statistics every=100",
                                      "Time integration/Time step=" +
                                        std::to_string(1.25 / steps)})
                                   .back(),
                                 "relative L2 error"));
        report.out << scheme << ": " << std::setprecision(3);
        for (const double e : errors)
          report.out << e << ' ';
        report.out << '\n';
        report.require("damped, " + scheme, errors.back(), 5e-3);
        report.require_order("damped, " + scheme,
                             std::log2(errors[1] / errors[2]),
                             0.9);
      }
  }

  /** Prestressed bodies with dampers that loads balance stay at rest: their
   *  springs bear the stress, the dampers nothing. */
  void
  relaxed(Report &report)
  {
    const std::string spring = "spring(bulk = 1, shear = 0.6)",
                      damper = "damper(bulk viscosity = 0.05, shear viscosity "
                               "= 0.05)",
                      kelvin = "parallel(" + spring + ", " + damper + ")";
    const std::vector<std::pair<std::string, std::string>> schemes = {
      {"Kelvin-Voigt", kelvin},
      {"standard solid",
       "parallel(" + spring + ", series(spring(bulk = 0.4, shear = 0.5), " +
         damper + "))"},
      {"damped grains", "series(contact(no tension), " + kelvin + ")"}};
    for (const auto &[name, scheme] : schemes)
      for (const int dim : {2, 3})
        for (const std::string way : {"explicit", "implicit", "statics"})
          {
            SceneFile file;
            file.set({}, "Dimension", std::to_string(dim));
            file.set({}, "Analysis", way == "statics" ? way : "dynamics");
            file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
            file.set({"Geometry"},
                     "Arguments",
                     dim == 2 ? "4, 2 : 0, 0 : 2, 1 : true" :
                                "4, 2, 1 : 0, 0, 0 : 2, 1, 0.5 : true");
            file.set({"Materials", "body"}, "Rheology", scheme);
            file.set({"Materials", "body"}, "Density", "1");
            for (const char *plane : {"left", "bottom", "front"})
              if (dim == 3 || plane != std::string("front"))
                file.set({"Boundaries", plane}, "Symmetry", "true");
            file.set({"Boundaries", "right"}, "Pressure", "0.1");
            file.set({"Boundaries", "top"}, "Pressure", "0.05");
            if (dim == 3)
              file.set({"Boundaries", "back"}, "Pressure", "0.03");
            file.set({"Initial state"},
                     "Stress",
                     dim == 2 ? "-0.1; -0.05; -0.03; 0" :
                                "-0.1; -0.03; -0.05; 0; 0; 0");
            file.set({"Output"},
                     "Probe points",
                     dim == 2 ? "2, 1" : "2, 1, 0.5");
            file.set({"Output"}, "Probe quantities", "displacement, stress");
            if (way != "statics")
              {
                file.set({"Time integration"}, "Scheme", way);
                file.set({"Time integration"}, "End time", "2");
              }
            const auto        last = run(file).back();
            const std::string full =
              name + ", " + std::to_string(dim) + "D, " + way;
            for (const char *entry : {"displacement x", "displacement y"})
              report.require(full + ", " + entry,
                             value(last, std::string(entry) + " at probe 1"),
                             1e-10);
            report.require(full + ", stress",
                           value(last, "stress xx at probe 1") / -0.1 - 1.,
                           1e-9);
            if (way != "statics")
              report.require(full + ", viscous dissipation",
                             value(last, "viscous dissipation") /
                               value(last, "initial energy"),
                             1e-16);
          }
  }

  /** A bar whose end is moved, as a displacement or a velocity:
   *  $u=A\sin(2x)\sin(2t)$. Order 2, and explicit steps do the same. */
  void
  driven(Report &report)
  {
    report.out << "Driven bar: error in L2 of the displacement\n";
    for (const std::string key : {"Displacement x", "Velocity x"})
      for (const std::string scheme : {"implicit", "explicit"})
        {
          SceneFile file = standing_wave(2, "elastic");
          file.remove({"Boundaries", "right"}, "Symmetry");
          file.set({"Boundaries", "right"},
                   key,
                   key[0] == 'D' ? "0.1*sin(2)*sin(2*t)" :
                                   "0.2*sin(2)*cos(2*t)");
          file.set({"Initial state"}, "Velocity", "0.2*sin(2*x); 0");
          file.set({"Reference solution"},
                   "Displacement",
                   "0.1*sin(2*x)*sin(2*t); 0");
          file.set({"Reference solution"},
                   "Velocity",
                   "0.2*sin(2*x)*cos(2*t); 0");
          file.set({"Time integration"}, "Scheme", scheme);
          std::vector<double> errors;
          double              gap = 0.;
          for (const int steps : {50, 100, 200})
            {
              if (scheme == "explicit" && steps < 200)
                continue;
              const auto lines =
                run(file,
                    {"Time integration/Time step=" +
                     (scheme == "explicit" ? std::string("0.003") :
                                             std::to_string(1.25 / steps))});
              errors.push_back(value(lines.back(), "relative L2 error"));
              gap = std::max(gap, std::abs(value(lines.back(), "energy gap")));
            }
          const std::string name = key + ", " + scheme;
          report.out << name << ": " << std::setprecision(3);
          for (const double e : errors)
            report.out << e << ' ';
          report.out << '\n';
          report.require(name, errors.back(), 1e-3);
          if (errors.size() == 3)
            report.require_order(name, std::log2(errors[1] / errors[2]), 1.9);
          report.require(name + ", energy gap", gap, 1e-8);
        }
  }

  /** Explicit and implicit runs of a scene, as relative differences of the
   *  numbers at its end. */
  void
  agreement(Report                         &report,
            const std::string              &name,
            const SceneFile                &file,
            const Overrides                &overrides,
            const std::string              &time_step,
            const std::vector<std::string> &columns,
            const double                    bound)
  {
    Overrides implicit = overrides;
    implicit.insert(implicit.end(),
                    {"Time integration/Scheme=implicit",
                     "Time integration/Time step=" + time_step});
    const auto a = run(file, overrides).back(), b = run(file, implicit).back();
    report.out << name << ", explicit and implicit:\n";
    for (const auto &column : columns)
      {
        report.out << "  " << column << ' ' << std::setprecision(3)
                   << value(a, column) << ' ' << value(b, column) << '\n';
        report.require(name + ", " + column,
                       value(b, column) / value(a, column) - 1.,
                       bound);
      }
    report.require(name + ", energy gap", value(b, "energy gap"), 1e-8);
  }

  /** One file by all three analyses: grains under a load that comes slowly end
   *  where statics has them. */
  void
  slow_load(Report &report)
  {
    SceneFile file = standing_wave(2, "elastic");
    file.set({"Geometry"}, "Arguments", "6, 6 : 0, 0 : 1, 1 : true");
    file.set({"Discretization"}, "Degree", "1");
    const SceneFile::Path grains = {"Materials", "bar"};
    file.set(grains, "Rheology", "elastic granular");
    file.set(grains, "Admissible set", "coulomb mohr");
    file.set(grains, "Friction angle", "30");
    file.set(grains, "Cohesion", "1e-3");
    file.set(grains, "Binder", "proportional");
    file.set(grains, "Binder ratio", "0.1");
    for (const char *name : {"right", "top"})
      file.remove({"Boundaries", name}, "Symmetry");
    file.set({"Boundaries", "top"},
             "Pressure",
             "0.01*(x < 0.5)*if(t < 100, sin(pi*t/200)^2, 1)");
    file.remove({"Initial state"}, "Velocity");
    file.remove({"Reference solution"}, "Velocity");
    file.remove({"Reference solution"}, "Displacement");
    file.set({"Output"}, "Probe points", "0, 1; 0.5, 0.5; 1, 1");
    file.set({"Time integration"}, "End time", "100");
    file.set({"Load steps"}, "End time", "100");
    file.set({"Load steps"}, "Step size", "20");
    const std::vector<std::string> columns = {"stored energy", "external work"};
    std::vector<std::vector<double>> found;
    for (const Overrides &overrides :
         {Overrides{"Analysis=statics"},
          Overrides{"Analysis=dynamics",
                    "Time integration/Scheme=implicit",
                    "Time integration/Time step=0.5"},
          Overrides{"Analysis=dynamics",
                    "Time integration/Scheme=explicit",
                    "Time integration/Statistics every=1000"}})
      {
        const auto last = run(file, overrides).back();
        report.out << overrides.front() << ": " << std::setprecision(4);
        found.emplace_back();
        for (const auto &column : columns)
          {
            found.back().push_back(value(last, column));
            report.out << found.back().back() << ' ';
          }
        report.out << '\n';
        for (unsigned int i = 0; i < columns.size(); ++i)
          report.require("slow load, " + overrides.back() + ", " + columns[i],
                         found.back()[i] / found.front()[i] - 1.,
                         0.01);
      }
  }

  /** The tighter the tolerance, the smaller the error and the more steps. */
  void
  local_error(Report &report)
  {
    double old_error = 1e300, old_steps = 0.;
    report.out << "Steps by local error: tolerance, steps, error\n";
    for (const double tolerance : {1e-2, 1e-3, 1e-4})
      {
        std::ostringstream text;
        text << tolerance;
        const auto lines =
          run(standing_wave(2, "elastic"),
              {"Time integration/Error tolerance=" + text.str(),
               "Time integration/Maximum time step=1",
               "Time integration/Linear shock viscosity=0"});
        const double error = value(lines.back(), "relative L2 error"),
                     steps = value(lines.back(), "step");
        report.out << tolerance << ' ' << steps << ' ' << std::setprecision(2)
                   << error << '\n';
        report.require("the error shrinks",
                       std::max(error / old_error, 0.),
                       0.6);
        report.require("steps grow in number",
                       std::max(1.2 * old_steps - steps, 0.),
                       0.);
        for (std::size_t i = 1; i < lines.size(); ++i)
          report.require("a local error",
                         value(lines[i], "local error"),
                         2.001 * tolerance);
        old_error = error;
        old_steps = steps;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  order(report);
  explicit_order(report);
  damped(report);
  relaxed(report);
  slow_load(report);
  driven(report);
  local_error(report);
  agreement(report,
            "signoton before a piston",
            read("prm/signoton_piston.prm"),
            {"Geometry/Arguments=200, 2 : 0, 0 : 1, 0.01 : true",
             "Output/Probe points=0.2, 0; 0.4, 0; 0.6, 0"},
            "0.002",
            {"kinetic energy",
             "stored energy",
             "shock dissipation",
             "external work",
             "displacement x at probe 1",
             "displacement x at probe 3"},
            0.01);
  // Where fronts make grains yield, both are of first order in the step: at 0.01
  // the implicit plastic dissipation is 3.7 % below its limit, the explicit one,
  // in steps of 0.015, 1.8 %.
  agreement(report,
            "loosened, yielding grains",
            read("tests/scenes/loosened_pulse.prm"),
            {"Time integration/Safety=0.45"},
            "0.005",
            {"kinetic energy",
             "stored energy",
             "plastic dissipation",
             "absorbed energy",
             "external work",
             "displacement y at probe 1",
             "displacement x at probe 2"},
            0.01);
  return report.status();
}
