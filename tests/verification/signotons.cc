// Plane waves in loosened media against the jump relations (Sadovskaya and
// Sadovskii 2012, Chapter 6): pistons and pressures (S1, S2), an impact (S3),
// reflections from a wall (S4), an impulse that its unloading catches (S5),
// stiff grains under a varying pressure (S6), plastic grains (S7), spall (S8).
// E = density = 1; a strip of 400 cells, and of 50 to 400 for the order.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  std::string
  text(const double number)
  {
    std::ostringstream stream;
    stream << std::setprecision(17) << number;
    return stream.str();
  }

  /** The strip: cells of size length/n, in 2D or 3D. */
  SceneFile
  strip(const int          dim,
        const unsigned int n,
        const double       length,
        const double       end_time,
        const double       lambda = 0.,
        const bool         yields = false)
  {
    SceneFile         file;
    const std::string h = text(length / n);
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             std::to_string(n) +
               (dim == 2 ? ", 1 : 0, 0 : " : ", 1, 1 : 0, 0, 0 : ") +
               text(length) + ", " + h + (dim == 2 ? "" : ", " + h) +
               " : true");
    const SceneFile::Path grains = {"Materials", "grains"};
    if (yields)
      {
        // this cone opens under the loosening, and contains compression
        file.set(grains, "Rheology", "elastic plastic granular");
        file.set(grains, "Friction parameter", "0.8");
        file.set(grains, "Bulk modulus", "1");
        file.set(grains, "Shear modulus", "0.6");
        file.set(grains, "Shear strength", "0.01");
      }
    else
      {
        file.set(grains, "Rheology", "elastic granular");
        file.set(grains, "Admissible set", "no tension");
        file.set(grains, "Young modulus", "1");
        file.set(grains, "Poisson ratio", "0");
      }
    file.set(grains, "Density", "1");
    if (lambda > 0.)
      {
        file.set(grains, "Binder", "proportional");
        file.set(grains, "Binder ratio", text(lambda));
      }
    for (const char *name : {"bottom", "top", "front", "back"})
      if (dim == 3 || name[0] == 't' || name[1] == 'o')
        file.set({"Boundaries", name}, "Symmetry", "true");
    file.set({"Time integration"}, "End time", text(end_time));
    file.set({"Time integration"}, "Statistics every", "5");
    return file;
  }

  void
  loosen(SceneFile &file, const int dim, const std::string &strain)
  {
    file.set({"Initial state"},
             "Strain",
             strain + (dim == 2 ? "; 0; 0; 0" : "; 0; 0; 0; 0; 0"));
  }

  void
  probe(SceneFile &file, const int dim, const std::vector<double> &places)
  {
    std::string points;
    for (const double x : places)
      points +=
        (points.empty() ? "" : "; ") + text(x) + (dim == 2 ? ", 0" : ", 0, 0");
    file.set({"Output"}, "Probe points", points);
  }

  double
  velocity(const PhysicalNumbers::Line &line, const unsigned int probe)
  {
    return value(line, "velocity x at probe " + std::to_string(probe));
  }

  double
  displacement(const PhysicalNumbers::Line &line, const unsigned int probe)
  {
    return value(line, "displacement x at probe " + std::to_string(probe));
  }

  /** When the velocity at a probe passes a value. */
  double
  arrival(const std::vector<PhysicalNumbers::Line> &lines,
          const unsigned int                        probe,
          const double                              level)
  {
    for (std::size_t i = 1; i < lines.size(); ++i)
      {
        const double a = velocity(lines[i - 1], probe) - level,
                     b = velocity(lines[i], probe) - level;
        if (a < 0. && b >= 0.)
          return value(lines[i - 1], "time") +
                 a / (a - b) *
                   (value(lines[i], "time") - value(lines[i - 1], "time"));
      }
    return -1.;
  }

  double
  largest_gap(const std::vector<PhysicalNumbers::Line> &lines)
  {
    double result = 0.;
    for (const auto &line : lines)
      result = std::max(result, std::abs(value(line, "energy gap")));
    return result;
  }

  /** Piston (V) or pressure (P), and what it makes. */
  void
  steady_front(Report            &report,
               const std::string &name,
               const int          dim,
               const double       e0,
               const double       lambda,
               const bool         by_pressure,
               const double       V,
               const double       y)
  {
    const double c    = V / (y + e0);
    SceneFile    file = strip(dim, 400, 1., 0.8 / c, lambda);
    loosen(file, dim, text(e0));
    if (by_pressure)
      file.set({"Boundaries", "left"}, "Pressure", text(y));
    else
      file.set({"Boundaries", "left"}, "Velocity x", text(V));
    // holds the tension of the binders
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    probe(file, dim, {0., 0.1, 0.3, 0.6});
    const auto  lines = run(file);
    const auto &last  = lines.back();
    report.require(
      name + ", front speed",
      0.3 / (arrival(lines, 4, V / 2.) - arrival(lines, 3, V / 2.)) / c - 1.,
      5e-3);
    report.require(name + ", velocity", velocity(last, 3) / V - 1., 5e-3);
    // the total strain is the initial one and that of the displacement
    const double strain =
      (displacement(last, 3) - displacement(last, 2)) / 0.2 + e0;
    report.require(name + ", strain", strain / -y - 1., 5e-3);
    double highest = 0.;
    for (const auto &line : lines)
      highest = std::max(highest, velocity(line, 3));
    report.require(name + ", overshoot", std::max(0., highest / V - 1.), 0.05);
    report.require(name + ", energy", largest_gap(lines), 1e-8);
  }

  double
  strain_behind(const double e0, const double lambda, const double V)
  {
    return 0.5 * (-(1. + lambda) * e0 +
                  std::sqrt(std::pow((1. - lambda) * e0, 2) + 4. * V * V));
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Report                           report;

  // S1 and S2: three loosenings, without and with binder, in 2D and 3D
  for (const double e0 : {0.01, 0.03, 0.1})
    for (const double lambda : {0., 0.2})
      {
        const double V =
          lambda > 0. ? std::max(0.02, 1.5 * std::sqrt(lambda) * e0) : 0.02;
        const double       y = strain_behind(e0, lambda, V);
        std::ostringstream name;
        name << "loosening " << e0 << ", binder " << lambda;
        steady_front(
          report, "piston, " + name.str(), 2, e0, lambda, false, V, y);
        steady_front(
          report, "pressure, " + name.str(), 2, e0, lambda, true, V, y);
      }
  steady_front(report, "piston in 3D", 3, 0.03, 0., false, 0.02, 0.01);

  // first order in L1
  {
    double before = 0.;
    for (const unsigned int n : {50, 100, 200, 400})
      {
        SceneFile file = strip(2, n, 1., 1.);
        loosen(file, 2, "0.03");
        file.set({"Boundaries", "left"}, "Velocity x", "0.02");
        file.set({"Reference solution"}, "Velocity", "0.02*(x < 0.5*t); 0");
        const double error =
          value(run(file).back(), "relative L1 error of velocity");
        std::cout << n << " " << error << std::endl;
        if (n == 400)
          report.require_order("L1 error", std::log2(before / error), 0.9);
        before = error;
      }
    report.require("L1 error", before, 0.01);
  }

  // S3: a closed half-space hits a loosened one
  {
    const double e0 = 0.03, w = 0.04, y = w * w / (e0 + 2. * w),
                 v = std::sqrt(y * (y + e0)), c = v / (y + e0);
    SceneFile file = strip(2, 800, 2., 0.8);
    loosen(file, 2, "0.03*(x > 1)");
    file.set({"Initial state"}, "Velocity", "0.04*(x < 1 + 1e-9); 0");
    probe(file, 2, {1.1, 1.3});
    const auto lines = run(file);
    report.require("impact, velocity",
                   velocity(lines.back(), 1) / v - 1.,
                   5e-3);
    report.require(
      "impact, front speed",
      0.2 / (arrival(lines, 2, v / 2.) - arrival(lines, 1, v / 2.)) / c - 1.,
      5e-3);
    report.require("impact, energy", largest_gap(lines), 1e-8);
  }

  // S4: reflection from a wall
  for (const double V : {0.005, 0.01, 0.02, 0.05})
    {
      const double e0 = 0.03, y = strain_behind(e0, 0., V), c = V / (y + e0);
      SceneFile    file = strip(2, 400, 1., 1. / c + 0.5);
      loosen(file, 2, "0.03");
      file.set({"Boundaries", "left"}, "Velocity x", text(V));
      file.set({"Boundaries", "right"}, "Symmetry", "true");
      probe(file, 2, {0.7, 0.95});
      const auto   last = run(file).back();
      const double strain =
        (displacement(last, 2) - displacement(last, 1)) / 0.25 + e0;
      report.require("amplification at V = " + text(V),
                     strain / -y / (1. + std::sqrt(1. + e0 / y)) - 1.,
                     0.01);
    }

  // S5: unloading catches the front of an impulse at t = 0.6, then a weaker
  // front of speed 0.25 goes on
  {
    SceneFile file = strip(2, 800, 0.5, 0.72);
    loosen(file, 2, "0.03");
    file.set({"Boundaries", "left"}, "Pressure", "0.01*(t < 0.3)");
    probe(file, 2, {0.25, 0.32});
    const auto lines = run(file);
    report.require("impulse, first front",
                   arrival(lines, 1, 0.01) / 0.5 - 1.,
                   5e-3);
    report.require("impulse, second front",
                   arrival(lines, 2, 0.004) / 0.68 - 1.,
                   5e-3);
    report.require("impulse, velocity",
                   velocity(lines.back(), 2) / 0.008 - 1.,
                   0.02);
    report.require("impulse, energy", largest_gap(lines), 1e-8);
  }

  // S6: the path of the front where grains are rigid: what the pressure has
  // pushed in is the closed pores
  {
    SceneFile file = strip(2, 400, 0.5, 6.);
    loosen(file, 2, "0.05");
    file.set({"Boundaries", "left"}, "Pressure", "2e-4*(1 + sin(4*pi*t))");
    probe(file, 2, {0.});
    const double closed = displacement(run(file).back(), 1) / 0.05;
    report.require("stiff grains, front", closed / 0.38447 - 1., 0.01);
  }

  // S7: grains that yield; below and above the critical loosening
  for (const bool is_high : {false, true})
    {
      const double k = 1., mu = 0.6, V = 0.05, at_yield = 0.0144338,
                   critical = 4. * mu / (3. * k) * at_yield,
                   e0       = (is_high ? 2. : 0.5) * critical,
                   c        = is_high ? 0.891175 : 1.133893,
                   x        = is_high ? V / c - e0 : at_yield + V - 0.022913;
      SceneFile file        = strip(2, 400, 1., 0.85, 0., true);
      loosen(file, 2, text(e0));
      file.set({"Boundaries", "left"}, "Velocity x", text(V));
      probe(file, 2, {0.1, 0.3, 0.7});
      const auto   lines = run(file);
      const double level = is_high ? V / 2. : 0.5 * 0.022913;
      report.require(
        "yielding grains, front speed",
        0.4 / (arrival(lines, 3, level) - arrival(lines, 2, level)) / c - 1.,
        5e-3);
      report.require(
        "yielding grains, strain",
        ((displacement(lines.back(), 2) - displacement(lines.back(), 1)) / 0.2 +
         e0) /
            -x -
          1.,
        5e-3);
      if (!is_high)
        {
          const double second = 0.5 * (0.022913 + V);
          report.require(
            "yielding grains, second front",
            0.4 / (arrival(lines, 3, second) - arrival(lines, 2, second)) - 1.,
            5e-3);
        }
      report.require("yielding grains, energy", largest_gap(lines), 1e-8);
    }

  // S8: a pulse at a free end tears off a slab of half its length
  {
    SceneFile file = strip(2, 400, 1., 1.6);
    file.set({"Boundaries", "left"}, "Pressure", "0.01*(t < 0.3)");
    probe(file, 2, {0.6, 0.75, 0.95, 1.});
    const auto lines = run(file);
    for (const unsigned int i : {3, 4})
      report.require("spall, slab",
                     velocity(lines.back(), i) / 0.02 - 1.,
                     5e-3);
    for (const unsigned int i : {1, 2})
      report.require("spall, rest", velocity(lines.back(), i) / 0.02, 5e-3);
    report.require("spall, energy", largest_gap(lines), 1e-8);
  }
  return report.status();
}
