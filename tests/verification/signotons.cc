// Plane waves in loosened media against the jump relations (Sadovskaya and
// Sadovskii 2012, Chapter 6): pistons and pressures (S1, S2), an impact (S3),
// reflections from a wall (S4), an impulse that its unloading catches (S5),
// stiff grains under a varying pressure (S6), plastic grains (S7), spall (S8).
// E = density = 1; a strip of 400 cells, and of 50 to 400 for the order. With a
// binder, loosened material is under tension, and jumps are those from there.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  std::string
  title(const std::string &what, const double e0, const double lambda)
  {
    std::ostringstream stream;
    stream << what << ", loosening " << e0 << ", binder " << lambda;
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
    // a front is few steps wide
    file.set({"Time integration"}, "Statistics every", "1");
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
    file.set({"Output"}, "Probe quantities", "displacement, velocity, stress");
  }

  /** The whole strip of n cells, twenty times: along an edge, and through
   *  centers of cells, where the stress is their mean, which the law admits. */
  void
  probe_line(SceneFile         &file,
             const int          dim,
             const double       length,
             const unsigned int n = 400)
  {
    const double      h      = length / n;
    const std::string edge   = dim == 2 ? ", 0" : ", 0, 0",
                      middle = ", " + text(0.5 * h) +
                               (dim == 2 ? "" : ", " + text(0.5 * h));
    file.set({"Output"},
             "Probe lines",
             "0" + edge + " : " + text(length) + edge + " : 201; " +
               text(0.5 * h) + middle + " : " + text(0.995 * length + 0.5 * h) +
               middle + " : 200");
    file.set({"Output"}, "Probe line samples", "20");
  }

  /** No stress, in any direction, place and sample, is above @p bound: the
   *  tension of binders, or none. */
  void
  require_no_tension(Report            &report,
                     const std::string &name,
                     const int          dim,
                     const double       bound)
  {
    double most = -1.;
    for (const auto &line : PhysicalNumbers::read("results/line-2.csv"))
      if (!line.empty())
        for (const char *entry : {"stress xx", "stress yy", "stress zz"})
          if (dim == 3 || entry[7] != 'z')
            most = std::max(most, value(line, entry));
    report.require(name + ", forbidden tension",
                   std::max(0., most - bound),
                   1e-12);
  }

  /** At the end, between two places, the velocity is @p expected but for 5 % of
   *  the jump, and the stress, if there is one. */
  void
  require_steady(Report            &report,
                 const std::string &name,
                 const double       from,
                 const double       to,
                 const double       expected,
                 const double       jump,
                 const double       pressure = 0.)
  {
    const auto   lines       = PhysicalNumbers::read("results/line-1.csv");
    double       of_velocity = 0., of_stress = 0.;
    unsigned int n   = 0;
    double       end = 0.;
    for (const auto &line : lines)
      if (!line.empty())
        end = value(line, "time");
    for (const auto &line : lines)
      if (!line.empty() && value(line, "time") >= end &&
          value(line, "distance") > from && value(line, "distance") < to)
        {
          ++n;
          of_velocity =
            std::max(of_velocity,
                     std::abs(value(line, "velocity x") - expected) / jump);
          if (pressure > 0.)
            of_stress =
              std::max(of_stress,
                       std::abs(value(line, "stress xx") / pressure + 1.));
        }
    report.require(name + ", points on the line", n > 5 ? 0. : 1., 0.);
    report.require(name + ", oscillation of velocity", of_velocity, 0.05);
    report.require(name + ", oscillation of stress", of_stress, 0.05);
  }

  /** Of the stress on the line between two places at the end: the mean of its
   *  size. */
  double
  mean_error_of_stress(const double from,
                       const double to,
                       const double expected)
  {
    const auto lines = PhysicalNumbers::read("results/line-1.csv");
    double     end   = 0.;
    for (const auto &line : lines)
      if (!line.empty())
        end = value(line, "time");
    double       sum = 0.;
    unsigned int n   = 0;
    for (const auto &line : lines)
      if (!line.empty() && value(line, "time") >= end &&
          value(line, "distance") > from && value(line, "distance") < to)
        {
          sum += std::abs(value(line, "stress xx") - expected);
          ++n;
        }
    return n > 0 ? sum / n : std::numeric_limits<double>::infinity();
  }

  double
  velocity(const PhysicalNumbers::Line &line, const unsigned int probe)
  {
    return value(line, "velocity x at probe " + std::to_string(probe));
  }

  double
  stress(const PhysicalNumbers::Line &line, const unsigned int probe)
  {
    return value(line, "stress xx at probe " + std::to_string(probe));
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

  /** When the velocity at a probe falls below a value for the last time. */
  double
  departure(const std::vector<PhysicalNumbers::Line> &lines,
            const unsigned int                        probe,
            const double                              level)
  {
    for (std::size_t i = lines.size() - 1; i > 0; --i)
      {
        const double a = velocity(lines[i - 1], probe) - level,
                     b = velocity(lines[i], probe) - level;
        if (a >= 0. && b < 0.)
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
    probe_line(file, dim, 1.);
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
    report.require(name + ", stress", stress(last, 3) / -y - 1., 5e-3);
    double highest = 0.;
    for (const auto &line : lines)
      highest = std::max(highest, velocity(line, 3));
    report.require(name + ", overshoot", std::max(0., highest / V - 1.), 0.05);
    require_no_tension(report, name, dim, lambda * e0);
    require_steady(report, name, -1., 0.75, V, V, y);
    report.require(name + ", energy", largest_gap(lines), 1e-8);
    // What a front dissipates follows from its jumps alone. The entry for what
    // the steps lose belongs to it: a cell is crossed in a few steps.
    const double section = std::pow(1. / 400., dim - 1);
    const double dissipated =
      section * 0.5 * (1. - lambda) * y * e0 * c * value(last, "time");
    report.require(name + ", dissipation",
                   value(last, "shock dissipation") / dissipated - 1.,
                   0.04);
    report.require(name + ", dissipation and loss by steps",
                   (value(last, "shock dissipation") +
                    value(last, "lost by time stepping")) /
                       dissipated -
                     1.,
                   0.025);
  }

  /** First order in L1, over every one of three halvings of the cells. */
  void
  order(Report &report, const double lambda, const bool by_pressure)
  {
    const double e0 = 0.03, y = 0.01,
                 V = std::sqrt((y + lambda * e0) * (y + e0)), c = V / (y + e0);
    const std::string name =
      title(by_pressure ? "L1 error of the velocity, pressure" :
                          "L1 error of the velocity, piston",
            e0,
            lambda);
    report.out << name << ':' << std::setprecision(2);
    double before = 0.;
    for (const unsigned int n : {50, 100, 200, 400})
      {
        SceneFile file = strip(2, n, 1., 0.5 / c, lambda);
        loosen(file, 2, text(e0));
        if (by_pressure)
          file.set({"Boundaries", "left"}, "Pressure", text(y));
        else
          file.set({"Boundaries", "left"}, "Velocity x", text(V));
        file.set({"Boundaries", "right"}, "Displacement x", "0");
        file.set({"Reference solution"},
                 "Velocity",
                 text(V) + "*(x < " + text(c) + "*t); 0");
        const double error =
          value(run(file).back(), "relative L1 error of velocity");
        report.out << ' ' << error;
        if (n > 50)
          report.require_order(name, std::log2(before / error), 0.9);
        before = error;
      }
    report.out << '\n';
    report.require(name, before, 0.01);
  }

  double
  strain_behind(const double e0, const double lambda, const double V)
  {
    return 0.5 * (-(1. + lambda) * e0 +
                  std::sqrt(std::pow((1. - lambda) * e0, 2) + 4. * V * V));
  }

  /** The velocity behind a front that leaves the strain -y. */
  double
  velocity_behind(const double y, const double e0, const double lambda)
  {
    return std::sqrt((y + lambda * e0) * (y + e0));
  }

  /** The strain, as y, that a closed body without stress makes that arrives
   *  with the velocity w. */
  double
  strain_of_impact(const double e0, const double lambda, const double w)
  {
    return root(
      [&](const double y) { return y + velocity_behind(y, e0, lambda) - w; },
      0.,
      w);
  }

  /** S3: a closed half-space hits a loosened one. */
  void
  impact(Report &report, const double e0, const double lambda)
  {
    const double w = 0.04, y = strain_of_impact(e0, lambda, w),
                 v = velocity_behind(y, e0, lambda), c = v / (y + e0);
    const std::string name = title("impact", e0, lambda);
    SceneFile         file = strip(2, 800, 2., 0.45 / c, lambda);
    loosen(file, 2, text(e0) + "*(x > 1)");
    file.set({"Initial state"}, "Velocity", "0.04*(x < 1 + 1e-9); 0");
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    probe(file, 2, {1.1, 1.2, 1.3});
    probe_line(file, 2, 2., 800);
    const auto lines = run(file);
    require_no_tension(report, name, 2, lambda * e0);
    require_steady(report, name, 1.05, 1.4, v, v, y);
    report.require(name + ", velocity",
                   velocity(lines.back(), 1) / v - 1.,
                   5e-3);
    report.require(name + ", stress", stress(lines.back(), 1) / -y - 1., 5e-3);
    report.require(
      name + ", strain",
      ((displacement(lines.back(), 2) - displacement(lines.back(), 1)) / 0.1 +
       e0) /
          -y -
        1.,
      5e-3);
    report.require(
      name + ", front speed",
      0.2 / (arrival(lines, 3, v / 2.) - arrival(lines, 1, v / 2.)) / c - 1.,
      5e-3);
    report.require(name + ", energy", largest_gap(lines), 1e-8);
  }

  /** Who looks at each step sees the motion of who looks at the last one: the
   *  laws have other ways to a stress if nobody asks for energies. */
  void
  looks(Report &report, const double lambda)
  {
    SceneFile file = strip(2, 100, 1., 1.5, lambda);
    loosen(file, 2, "0.03*(x > 0.5)");
    file.set({"Initial state"}, "Velocity", "0.04*(x < 0.5 + 1e-9); 0");
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    probe(file, 2, {0.3, 0.5, 0.6, 0.7});
    const auto often = run(file).back(),
               seldom =
                 run(file, {"Time integration/Statistics every=1000"}).back();
    double difference = 0.;
    for (const unsigned int i : {1, 2, 3, 4})
      difference = std::max(difference,
                            std::abs(velocity(often, i) - velocity(seldom, i)));
    report.require(title("looks at the motion", 0.03, lambda),
                   difference / 0.04,
                   1e-10);
  }

  /** S4: reflection from a wall. */
  void
  reflection(Report      &report,
             const double e0,
             const double lambda,
             const double V)
  {
    const double y = strain_behind(e0, lambda, V), c = V / (y + e0);
    SceneFile    file = strip(2, 400, 1., 1. / c + 0.5, lambda);
    loosen(file, 2, text(e0));
    file.set({"Boundaries", "left"}, "Velocity x", text(V));
    file.set({"Boundaries", "right"}, "Symmetry", "true");
    probe(file, 2, {0.7, 0.95});
    probe_line(file, 2, 1.);
    const auto   lines = run(file);
    const auto  &last  = lines.back();
    const double strain =
      (displacement(last, 2) - displacement(last, 1)) / 0.25 + e0;
    const std::string name = "amplification at V = " + text(V) +
                             ", loosening " + text(e0) + ", binder " +
                             text(lambda);
    report.require(name, strain / -y / (1. + V / y) - 1., 0.01);
    report.require(name + ", of stress",
                   stress(last, 2) / -y / (1. + V / y) - 1.,
                   0.01);
    require_no_tension(report, name, 2, lambda * e0);
    // at rest behind the reflected wave, which has the speed 1
    require_steady(report, name, 0.6, 1., 0., V, y + V);
    const double back =
      0.25 / (departure(lines, 1, V / 2.) - departure(lines, 2, V / 2.));
    report.require(name + ", speed of the reflected wave", back - 1., 0.01);
  }

  /** S5: the unloading of an impulse catches its front; a weaker one goes on,
   *  driven by the momentum that is left.
   *  Returns the error of the stress behind it, in parts of the pressure. */
  double
  impulse(Report            &report,
          const double       e0,
          const double       lambda,
          const double       P,
          const double       T,
          const unsigned int n = 400)
  {
    const double V = velocity_behind(P, e0, lambda), c = V / (P + e0),
                 caught = T / (1. - c), place = c * caught,
                 y = strain_of_impact(e0, lambda, V - P),
                 v = velocity_behind(y, e0, lambda), c2 = v / (y + e0);
    const double length = 1.5 * place;
    SceneFile    file = strip(2, n, length, caught + 0.4 * place / c2, lambda);
    loosen(file, 2, text(e0));
    file.set({"Boundaries", "left"},
             "Pressure",
             text(P) + "*(t < " + text(T) + ")");
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    probe(file,
          2,
          {0.4 * place, 0.8 * place, 1.1 * place, 1.2 * place, 1.3 * place});
    probe_line(file, 2, length, n);
    const auto        lines = run(file);
    const auto       &last  = lines.back();
    const std::string name  = title("impulse", e0, lambda);
    report.require(name + ", first front",
                   0.4 * place /
                       (arrival(lines, 2, V / 2.) - arrival(lines, 1, V / 2.)) /
                       c -
                     1.,
                   5e-3);
    report.require(name + ", second front",
                   0.2 * place /
                       (arrival(lines, 5, v / 2.) - arrival(lines, 3, v / 2.)) /
                       c2 -
                     1.,
                   7e-3);
    report.require(name + ", arrival of the first front",
                   arrival(lines, 2, V / 2.) * c / (0.8 * place) - 1.,
                   5e-3);
    report.require(name + ", arrival of the second front",
                   arrival(lines, 4, v / 2.) / (caught + 0.2 * place / c2) - 1.,
                   5e-3);
    report.require(name + ", velocity of the rest",
                   velocity(last, 4) / v - 1.,
                   0.02);
    // The weak rest of the impulse, in parts of what the impulse was: behind
    // the unloading, which no viscosity smoothes, ripples remain.
    const double strain =
      (displacement(last, 4) - displacement(last, 3)) / (0.1 * place) + e0;
    report.out << name << ", " << n << " cells: velocity, stress, strain"
               << std::setprecision(1) << ' ' << (velocity(last, 4) - v) / V
               << ' ' << (stress(last, 4) + y) / P << ' ' << (strain + y) / P
               << '\n';
    report.require(name + ", velocity", (velocity(last, 4) - v) / V, 6e-3);
    report.require(name + ", stress", (stress(last, 4) + y) / P, 0.01);
    report.require(name + ", strain", (strain + y) / P, 0.015);
    require_no_tension(report, name, 2, lambda * e0);
    require_steady(report, name, 1.05 * place, 1.35 * place, v, V);
    report.require(name + ", energy", largest_gap(lines), 1e-8);
    const double error =
      mean_error_of_stress(1.05 * place, 1.25 * place, -y) / P;
    report.out << name << ", " << n << " cells: mean error of stress "
               << std::setprecision(1) << error << '\n';
    return error;
  }

  /** S6: the path of the front where grains are stiff: what the pressure has
   *  pushed in is the closed pores. The sum of forces is the momentum of what
   *  has been swept. */
  void
  stiff_grains(Report &report, const double e0, const double frequency)
  {
    const double P = 4e-3 * e0, t = 6., omega = 2. * numbers::PI * frequency;
    const double impulses =
      P * (t * t / 2. + t / omega - std::sin(omega * t) / (omega * omega));
    SceneFile file = strip(2, 400, 0.5, t);
    loosen(file, 2, text(e0));
    file.set({"Boundaries", "left"},
             "Pressure",
             text(P) + "*(1 + sin(" + text(omega) + "*t))");
    const double front = std::sqrt(2. * impulses / e0);
    probe(file, 2, {0., 0.8 * front});
    probe_line(file, 2, 0.5);
    const auto        lines = run(file);
    const std::string name  = "stiff grains, loosening " + text(e0);
    report.require(name + ", pores that are closed",
                   displacement(lines.back(), 1) / e0 / front - 1.,
                   0.01);
    require_no_tension(report, name, 2, 0.);
  }

  /** S7: grains that yield; below the critical loosening there are two fronts.
   *  The binder hardens them: their stress is the mean of an elastic and a
   *  plastic one. */
  void
  yielding_grains(Report      &report,
                  const double part_of_critical,
                  const double lambda)
  {
    const double k = 1., mu = 0.6, V = 0.05, E1 = k + 4. / 3. * mu,
                 at_yield = std::sqrt(3.) * 0.01 / (2. * mu),
                 critical = 4. * mu / (3. * k) * at_yield,
                 e0 = part_of_critical * critical, tension = lambda * E1 * e0,
                 tangent   = lambda * E1 + (1. - lambda) * k;
    const auto pressure_at = [&](const double x) {
      return E1 * at_yield + tangent * (x - at_yield);
    };
    const bool   is_single = part_of_critical > 1.;
    const double c1 =
      std::sqrt((E1 * at_yield + tension) / (at_yield + e0)); // first of two
    const double v1 = c1 * (at_yield + e0), c_plastic = std::sqrt(tangent);
    const double x =
      is_single ?
        root(
          [&](const double strain) {
            return (pressure_at(strain) + tension) * (strain + e0) - V * V;
          },
          at_yield,
          1.) :
        at_yield + (V - v1) / c_plastic;
    const double c = is_single ? V / (x + e0) : c1;
    SceneFile    file =
      strip(2, 400, 1., 0.85 / (is_single ? c : c_plastic), lambda, true);
    loosen(file, 2, text(e0));
    file.set({"Boundaries", "left"}, "Velocity x", text(V));
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    probe(file, 2, {0.1, 0.3, 0.7});
    const auto        lines = run(file);
    const std::string name  = "yielding grains, " + text(part_of_critical) +
                             " of the critical loosening, binder " +
                             text(lambda);
    const double level = is_single ? V / 2. : v1 / 2.;
    report.require(name + ", front speed",
                   0.4 / (arrival(lines, 3, level) - arrival(lines, 2, level)) /
                       c -
                     1.,
                   5e-3);
    report.require(
      name + ", strain",
      ((displacement(lines.back(), 2) - displacement(lines.back(), 1)) / 0.2 +
       e0) /
          -x -
        1.,
      5e-3);
    report.require(name + ", stress",
                   stress(lines.back(), 1) / -pressure_at(x) - 1.,
                   5e-3);
    if (!is_single)
      {
        const double second = 0.5 * (v1 + V);
        report.require(name + ", second front",
                       0.4 /
                           (arrival(lines, 3, second) -
                            arrival(lines, 2, second)) /
                           c_plastic -
                         1.,
                       5e-3);
      }
    report.require(name + ", energy", largest_gap(lines), 1e-8);
  }

  /** S8: a pulse at a free end tears off a slab of half its length. */
  void
  spall(Report &report, const double P, const double T)
  {
    SceneFile file = strip(2, 400, 1., 1. + 2. * T);
    file.set({"Boundaries", "left"},
             "Pressure",
             text(P) + "*(t < " + text(T) + ")");
    probe(file,
          2,
          {1. - 0.75 * T,
           1. - 0.25 * T,
           1. - 4. / 3. * T,
           1. - 5. / 6. * T,
           1. - T / 6.,
           1.});
    probe_line(file, 2, 1.);
    const auto        lines = run(file);
    const std::string name  = "spall, duration " + text(T);
    require_no_tension(report, name, 2, 0.);
    require_steady(report, name + ", slab", 1. - 0.25 * T, 1., 2. * P, 2. * P);
    require_steady(report, name + ", rest", 0.5, 1. - 0.75 * T, 0., 2. * P);
    for (const unsigned int i : {3, 4})
      report.require(name + ", rest",
                     velocity(lines.back(), i) / (2. * P),
                     5e-3);
    for (const unsigned int i : {5, 6})
      report.require(name + ", slab",
                     velocity(lines.back(), i) / (2. * P) - 1.,
                     5e-3);
    // the slab leaves with its velocity; it was torn off at T/2 from the end
    const auto opening = [&](const PhysicalNumbers::Line &line) {
      return displacement(line, 2) - displacement(line, 1);
    };
    const std::size_t late = lines.size() - 1, early = late - late / 10;
    report.require(name + ", opening of the crack",
                   (opening(lines[late]) - opening(lines[early])) /
                       (value(lines[late], "time") -
                        value(lines[early], "time")) /
                       (2. * P) -
                     1.,
                   5e-3);
    double crack = 1.;
    for (const auto &line : PhysicalNumbers::read("results/line-1.csv"))
      if (!line.empty() && value(line, "time") > 0.999 * (1. + 2. * T) &&
          value(line, "velocity x") > P)
        crack = std::min(crack, value(line, "distance"));
    report.require(name + ", place of the crack",
                   (1. - crack) / (T / 2.) - 1.,
                   0.05);
    report.require(name + ", energy", largest_gap(lines), 1e-8);
  }

  /** The shipped scenes show what their comments say, also in 3D. */
  void
  shipped(Report &report, const std::string &suffix)
  {
    const auto scene = [&](const std::string &name) {
      return Verification::run(source_directory + "/prm/signoton_" + name +
                                 suffix + ".prm",
                               {"Output/Probe quantities=velocity, stress",
                                "Time integration/Statistics every=1"});
    };
    const auto front = [&](const std::string                        &name,
                           const std::vector<PhysicalNumbers::Line> &lines,
                           const double                              level,
                           const double                              time) {
      report.require("prm/signoton_" + name + suffix + ".prm, front",
                     arrival(lines, 2, level) / time - 1.,
                     5e-3);
    };
    const auto piston = scene("piston");
    front("piston", piston, 0.01, 0.4 / 0.5);
    report.require("prm/signoton_piston" + suffix + ".prm, stress",
                   stress(piston.back(), 2) / -0.01 - 1.,
                   5e-3);
    const auto collision = scene("collision");
    for (const unsigned int i : {1, 2})
      report.require("prm/signoton_collision" + suffix + ".prm, stress",
                     stress(collision.back(), i) / -0.03 - 1.,
                     0.01);
    front("impulse", scene("impulse"), 0.01, 0.25 / 0.5);
    if (!suffix.empty())
      return;
    const Overrides often = {"Time integration/Statistics every=5"};
    const auto      path  = source_directory + "/prm/";
    const auto      yielding =
      Verification::run(path + "elastic_plastic_signoton.prm", often);
    report.require(
      "prm/elastic_plastic_signoton.prm, front",
      0.2 / (arrival(yielding, 2, 0.01) - arrival(yielding, 1, 0.01)) / 1.1339 -
        1.,
      0.01);
    const auto torn = Verification::run(path + "spall.prm", often).back();
    report.require("prm/spall.prm, rest", velocity(torn, 1) / 0.02, 5e-3);
    report.require("prm/spall.prm, slab", velocity(torn, 2) / 0.02 - 1., 5e-3);
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;

  // S1 and S2: three loosenings, without and with binder, in 2D and 3D
  for (const double e0 : {0.01, 0.03, 0.1})
    for (const double lambda : {0., 0.2})
      {
        const double V =
          lambda > 0. ? std::max(0.02, 1.5 * std::sqrt(lambda) * e0) : 0.02;
        const double y = strain_behind(e0, lambda, V);
        steady_front(
          report, title("piston", e0, lambda), 2, e0, lambda, false, V, y);
        steady_front(
          report, title("pressure", e0, lambda), 2, e0, lambda, true, V, y);
      }
  steady_front(report, "piston in 3D", 3, 0.03, 0., false, 0.02, 0.01);

  for (const double lambda : {0., 0.2})
    for (const bool by_pressure : {false, true})
      order(report, lambda, by_pressure);

  for (const double lambda : {0., 0.05})
    {
      looks(report, lambda);
      for (const double e0 : {0.01, 0.03, 0.1})
        {
          impact(report, e0, lambda);
          reflection(report, e0, lambda, 0.05);
        }
      for (const double V : {0.01, 0.02})
        reflection(report, 0.03, lambda, V);
      impulse(report, 0.01, lambda, 0.005, 0.2);
      impulse(report, 0.02, lambda, 0.008, 0.2);
      impulse(report, 0.04, lambda, 0.01, 0.2);
      for (const double part : {0.25, 0.5, 1.5, 2.})
        yielding_grains(report, part, lambda);
    }
  reflection(report, 0.03, 0., 0.005);
  const double coarse = impulse(report, 0.03, 0., 0.01, 0.3),
               fine   = impulse(report, 0.03, 0., 0.01, 0.3, 1600);
  report.require_order("impulse, stress", 0.5 * std::log2(coarse / fine), 0.5);
  for (const double e0 : {0.03, 0.05, 0.1})
    stiff_grains(report, e0, 2.);
  spall(report, 0.01, 0.3);
  spall(report, 0.002, 0.25);
  shipped(report, "");
  shipped(report, "_3d");
  return report.status();
}
