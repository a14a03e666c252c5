// What shock viscosity does to grains that fall and to weak or smooth waves:
// a column falls through a gap, lands when a falling body does and comes up
// again, unless it yields or is damped; loosened ground settles; fronts of a
// tenth to a hundredth of the elastic speed are a few cells wide and as the jump
// relations have them; fibers become taut and shear fronts pass without ringing;
// smooth waves pass.

#include "verification.h"

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  /** A strip of n cells along x (along z in 3D if it stands) with one no-tension
   *  material of Poisson's ratio zero. */
  SceneFile
  strip(const int          dim,
        const unsigned int n,
        const double       length,
        const double       young_modulus,
        const bool         stands)
  {
    const std::string h = text(length / n), cells = std::to_string(n);
    const std::string sides  = dim == 2 ? "" : "1, ",
                      widths = dim == 2 ? "" : h + ", ";
    SceneFile file;
    file.set({}, "Dimension", std::to_string(dim));
    file.set({}, "Analysis", "dynamics");
    file.set({"Geometry"}, "Generator", "subdivided_hyper_rectangle");
    file.set({"Geometry"},
             "Arguments",
             (stands ? sides + "1, " + cells : cells + ", 1") + " : " +
               (dim == 2 ? "0, 0 : " : "0, 0, 0 : ") +
               (stands ? widths + h + ", " + text(length) :
                         text(length) + ", " + h) +
               " : true");
    const SceneFile::Path grains = {"Materials", "grains"};
    file.set(grains, "Rheology", "elastic granular");
    file.set(grains, "Admissible set", "no tension");
    file.set(grains, "Young modulus", text(young_modulus));
    file.set(grains, "Poisson ratio", "0");
    file.set(grains, "Density", "1");
    std::vector<std::string> planes = {"bottom", "top"};
    if (stands)
      planes = {"left", "right", "bottom"};
    if (stands && dim == 3)
      planes.insert(planes.end(), {"front", "back"});
    for (const std::string &plane : planes)
      file.set({"Boundaries", plane}, "Symmetry", "true");
    return file;
  }

  /** Elastic grains with dampers that take the motion of a column of 10 cells
   *  in its first oscillation. */
  void
  set_dampers(SceneFile &file)
  {
    const SceneFile::Path grains = {"Materials", "grains"};
    for (const char *key : {"Admissible set", "Young modulus", "Poisson ratio"})
      file.remove(grains, key);
    file.set(grains,
             "Rheology",
             "series(contact(no tension), parallel(spring(bulk = 13333, shear "
             "= 2e4), damper(bulk viscosity = 85, shear viscosity = 127)))");
  }

  /** Through a gap in the lowest cell: $t=\sqrt{2g_0/g}$, then up again, less
   *  than 2 % slower; with dampers it stays down.
   *  @param lateral pressure of the walls, by that of its weight at the base: it
   *    does not hold the column */
  void
  falling_column(Report            &report,
                 const int          dim,
                 const unsigned int n,
                 const bool         damped  = false,
                 const double       lateral = 0.)
  {
    const double h = 1. / n, landing = std::sqrt(2. * h);
    SceneFile    file = strip(dim, n, 1., 4e4, true);
    file.set({"Loads"}, "Gravity", dim == 2 ? "0; -1" : "0; 0; -1");
    file.set({"Initial state"},
             "Strain",
             (dim == 2 ? "0; (y < " : "0; 0; (z < ") + text(h) +
               (dim == 2 ? "); 0; 0" : "); 0; 0; 0"));
    if (lateral > 0.)
      {
        const std::string pressure = text(-lateral);
        file.set({"Initial state"},
                 "Stress",
                 pressure + (dim == 2 ? "; 0; " + pressure + "; 0" :
                                        "; " + pressure + "; 0; 0; 0; 0"));
      }
    file.set({"Time integration"}, "End time", text(1.5 * landing));
    if (damped)
      {
        set_dampers(file);
        file.set({"Time integration"}, "Statistics every", "20");
      }
    const std::string up   = dim == 2 ? "momentum y" : "momentum z";
    double            time = -1., fastest = -1.;
    const auto        lines = run(file);
    for (const auto &line : lines)
      {
        const double voids = value(line, "volume of voids");
        if (time < 0. && value(line, "time") > 0.5 * landing &&
            voids < 1e-6 * std::pow(h, dim))
          time = value(line, "time");
        if (time > 0.)
          fastest = std::max(fastest, value(line, up));
      }
    std::ostringstream name;
    name << (damped ? "damped " : "") << "column of " << n << " cells, " << dim
         << "D";
    if (lateral > 0.)
      name << ", lateral pressure " << lateral;
    report.require(name.str() + ", landing", time / landing - 1., 5e-3);
    // half a cell of its mass hangs at the base
    const double speed =
      fastest / ((1. - 0.5 * h) * std::pow(h, dim - 1) * landing);
    if (damped)
      report.require(name.str() + ", speed of the rebound", speed, 0.15);
    else
      report.require(name.str() + ", speed of the rebound",
                     std::max(0., 1. - speed),
                     0.02);
    report.require(name.str() + ", energy of the steps",
                   value(lines.back(), "lost by time stepping") /
                     (0.5 * std::pow(h, dim - 1) * landing * landing),
                   0.02);
  }

  /** Thrown up, a column opens its lowest cell, flies freely and lands after
   *  $2v/g$. A damper takes all of its motion, yielding takes a part. */
  void
  thrown_column(Report &report, const std::string &kind)
  {
    const unsigned int n = 10;
    const double       h = 1. / n, v = std::sqrt(2. * h), landing = 2. * v;
    SceneFile          file = strip(2, n, 1., 4e4, true);
    if (kind == "viscous")
      set_dampers(file);
    else
      {
        const SceneFile::Path grains = {"Materials", "grains"};
        for (const char *key :
             {"Admissible set", "Young modulus", "Poisson ratio"})
          file.remove(grains, key);
        file.set(grains, "Rheology", "elastic plastic granular");
        file.set(grains, "Friction parameter", "0.6");
        file.set(grains, "Shear strength", "5");
        file.set(grains, "Bulk modulus", "13333");
        file.set(grains, "Shear modulus", "2e4");
      }
    file.set({"Loads"}, "Gravity", "0; -1");
    file.set({"Initial state"}, "Velocity", "0; " + text(v) + "*(y > 1e-9)");
    file.set({"Time integration"}, "End time", text(1.5 * landing));
    if (kind == "viscous")
      file.set({"Time integration"}, "Statistics every", "20");
    const double mass   = (1. - 0.5 * h) * h;
    const auto   lines  = run(file);
    double       flight = 0., time = -1., fastest = 0.;
    for (const auto &line : lines)
      {
        const double t = value(line, "time"), up = value(line, "momentum y"),
                     off = std::abs(up / mass - (v - t)) / v;
        if (t < 0.98 * landing)
          flight = std::max(flight, off);
        if (time < 0. && off > 0.02)
          time = t;
        if (time > 0.)
          fastest = std::max(fastest, up / (mass * v));
      }
    const auto  &last       = lines.back();
    const double dissipated = (value(last, "plastic dissipation") +
                               value(last, "viscous dissipation")) /
                              (0.5 * mass * v * v);
    report.out << kind << " column: speed after the landing "
               << std::setprecision(2) << fastest << ", dissipated "
               << dissipated << '\n';
    report.require(kind + " column, flight", flight, 2e-3);
    report.require(kind + " column, landing", time / landing - 1., 5e-3);
    report.require(kind + " column, speed after the landing",
                   fastest,
                   kind == "viscous" ? 0.15 : 0.8);
    report.require(kind + " column, what did not dissipate",
                   std::max(0., 1. - dissipated),
                   kind == "viscous" ? 0.05 : 0.8);
    if (kind == "viscous")
      report.require("viscous column, rest",
                     value(last, "kinetic energy") / (0.5 * mass * v * v),
                     1e-5);
  }

  /** Loosened ground settles under gravity: of stiff grains, what the front at
   *  $X=gt^2/2e_0$ has not reached falls freely. */
  void
  settling_ground(Report &report)
  {
    const unsigned int n  = 50;
    const double       e0 = 0.03, all = std::sqrt(2. * e0), h = 1. / n;
    SceneFile          file = strip(2, n, 1., 4e4, true);
    file.set({"Loads"}, "Gravity", "0; -1");
    file.set({"Initial state"}, "Strain", "0; " + text(e0) + "; 0; 0");
    file.set({"Time integration"}, "End time", text(0.9 * all));
    file.set({"Time integration"}, "Statistics every", "5");
    double of_momentum = 0., of_voids = 0.;
    for (const auto &line : run(file))
      {
        const double t = value(line, "time"), falls = 1. - t * t / (2. * e0);
        of_momentum = std::max(of_momentum,
                               std::abs(value(line, "momentum y") / (h * all) +
                                        falls * t / all));
        of_voids =
          std::max(of_voids,
                   std::abs(value(line, "volume of voids") / (h * e0) - falls));
      }
    report.out << "settling ground: error of the momentum "
               << std::setprecision(2) << of_momentum << ", of the voids "
               << of_voids << '\n';
    // half a cell of mass hangs at the base
    report.require("settling ground, momentum", of_momentum, 0.01);
    report.require("settling ground, voids", of_voids, 5e-3);
  }

  /** Slack fibers in a matrix with a hundredth of their modulus become taut
   *  behind a front: a signoton with tension for pressure. */
  void
  fibers(Report &report)
  {
    const double e0 = 0.03, V = 0.02, binder = 0.01;
    // (y + binder e0)(y + e0) = V^2
    const double b = (1. + binder) * e0,
                 y = 0.5 *
                     (-b + std::sqrt(b * b - 4. * (binder * e0 * e0 - V * V))),
                 c               = V / (y + e0);
    SceneFile             file   = strip(2, 400, 1., 1., false);
    const SceneFile::Path grains = {"Materials", "grains"};
    for (const char *key : {"Admissible set", "Young modulus", "Poisson ratio"})
      file.remove(grains, key);
    file.set(grains,
             "Rheology",
             "parallel(spring(bulk = " + text(binder / 3.) +
               ", shear = " + text(binder / 2.) +
               "), series(spring(bulk = " + text((1. - binder) / 3.) +
               ", shear = " + text((1. - binder) / 2.) +
               "), contact(no compression)))");
    file.set({"Initial state"}, "Strain", text(-e0) + "; 0; 0; 0");
    file.set({"Boundaries", "left"}, "Velocity x", text(-V));
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    file.set({"Time integration"}, "End time", text(0.65 / c));
    file.set({"Output"}, "Probe points", "0.3, 0; 0.5, 0");
    file.set({"Output"}, "Probe quantities", "velocity, stress");
    const auto lines   = run(file);
    double     highest = 0.;
    for (const auto &line : lines)
      highest = std::max(highest, -value(line, "velocity x at probe 2") / V);
    report.require("fibers, overshoot", std::max(0., highest - 1.), 0.05);
    report.require("fibers, velocity",
                   value(lines.back(), "velocity x at probe 1") / -V - 1.,
                   5e-3);
    report.require("fibers, stress",
                   value(lines.back(), "stress xx at probe 1") / y - 1.,
                   0.01);
  }

  /** A jump of the shear velocity in closed grains. */
  void
  shear_front(Report &report)
  {
    const double V    = 1e-4;
    SceneFile    file = strip(2, 400, 1., 1., false);
    for (const char *plane : {"bottom", "top"})
      {
        file.remove({"Boundaries", plane}, "Symmetry");
        file.set({"Boundaries", plane}, "Displacement x", "0");
        file.set({"Boundaries", plane}, "Pressure", "0.1");
      }
    file.set({"Initial state"}, "Stress", "-0.1; -0.1; -0.1; 0");
    file.set({"Boundaries", "left"}, "Velocity y", text(V));
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    file.set({"Time integration"}, "End time", "1");
    file.set({"Output"}, "Probe points", "0.5, 0.00125");
    file.set({"Output"}, "Probe quantities", "velocity");
    double       highest = 0., late = 0.;
    unsigned int n = 0;
    for (const auto &line : run(file))
      {
        const double v = value(line, "velocity y at probe 1") / V;
        highest        = std::max(highest, v);
        if (value(line, "time") > 0.9)
          {
            late += v;
            ++n;
          }
      }
    report.require("shear front, overshoot", std::max(0., highest - 1.), 0.1);
    report.require("shear front, behind", late / n - 1., 2e-3);
  }

  /** Loosened grains that are pushed from the left so that a front of speed c,
   *  in units of that of the closed medium, closes them. */
  struct LoosenedStrip
  {
    LoosenedStrip(const unsigned int n, const double c, const bool by_pressure)
      : y(e0 * c * c / (1. - c * c))
      , V(std::sqrt(y * (y + e0)))
      , file(strip(2, n, 1., 1., false))
    {
      file.set({"Initial state"}, "Strain", text(e0) + "; 0; 0; 0");
      if (by_pressure)
        file.set({"Boundaries", "left"}, "Pressure", text(y));
      else
        file.set({"Boundaries", "left"}, "Velocity x", text(V));
      file.set({"Boundaries", "right"}, "Displacement x", "0");
    }

    const double e0 = 0.03; ///< how far the grains are loosened
    const double y;         ///< stress behind the front
    const double V;         ///< velocity there
    SceneFile    file;
  };

  /** Speed, jump and width of such a front. */
  void
  weak_front(Report &report, const double c, const bool by_pressure)
  {
    const unsigned int  n = 400;
    const LoosenedStrip strip(n, c, by_pressure);
    const double        e0 = strip.e0, y = strip.y, V = strip.V,
                 passage = 10. / (n * c);
    SceneFile file       = strip.file;
    file.set({"Time integration"}, "End time", text(0.61 / c + passage));
    file.set({"Time integration"}, "Statistics every", "5");
    file.set({"Output"}, "Probe points", "0.1, 0; 0.30125, 0; 0.6, 0");
    file.set({"Output"}, "Probe quantities", "displacement, velocity, stress");
    file.set({"Output"}, "Probe lines", "0, 0 : 1, 0 : 401");
    file.set({"Output"}, "Probe line samples", "1");
    const auto lines = run(file);
    const auto at    = [](const PhysicalNumbers::Line &line,
                       const std::string           &quantity,
                       const int                    probe) {
      return value(line, quantity + " at probe " + std::to_string(probe));
    };
    const auto arrival = [&](const int probe) {
      for (std::size_t i = 1; i < lines.size(); ++i)
        {
          const double a = at(lines[i - 1], "velocity x", probe) - 0.5 * V,
                       b = at(lines[i], "velocity x", probe) - 0.5 * V,
                       t = value(lines[i - 1], "time");
          if (a < 0. && b >= 0.)
            return t + a / (a - b) * (value(lines[i], "time") - t);
        }
      return -1.;
    };
    double       sum = 0., squares = 0.;
    unsigned int count = 0;
    for (const auto &line : lines)
      if (const double t = value(line, "time") - 0.6 / c;
          t >= 0. && t <= passage)
        {
          const double stress = at(line, "stress xx", 2) / -y - 1.;
          sum += stress;
          squares += stress * stress;
          ++count;
        }
    // the cells over which the strain changes by nine tenths of the jump
    double       before = 0.;
    unsigned int width = 0, cell = 0;
    for (const auto &line : PhysicalNumbers::read("results/line-1.csv"))
      if (!line.empty() && value(line, "time") > 0.5 / c)
        {
          const double u = value(line, "displacement x");
          if (cell++ > 0)
            {
              const double part = -(u - before) * n / (y + e0);
              width += part > 0.05 && part < 0.95 ? 1 : 0;
            }
          before = u;
        }
    std::ostringstream name;
    name << "front of " << c << (by_pressure ? ", pressure" : ", piston");
    const auto &last = lines.back();
    std::cout << name.str() << ": deviation of the stress behind "
              << std::setprecision(2) << std::sqrt(squares / count) << '\n';
    report.require(name.str() + ", speed",
                   0.29875 / (arrival(3) - arrival(2)) / c - 1.,
                   0.01);
    report.require(name.str() + ", jump of the strain",
                   (at(last, "displacement x", 2) -
                    at(last, "displacement x", 1)) /
                       0.20125 / -(y + e0) -
                     1.,
                   0.01);
    report.require(name.str() + ", mean stress behind", sum / count, 0.02);
    report.require(name.str() + ", width in cells", width, 20.);
    report.require(name.str() + ", samples", count > 20 ? 0. : 1., 0.);
  }

  /** The same in automatic implicit steps, which would be many crossings of a
   *  cell long: contacts that close must not gain energy. */
  void
  implicit_front(Report &report, const double c, const unsigned int n)
  {
    const LoosenedStrip strip(n, c, false);
    SceneFile           file = strip.file;
    file.set({"Time integration"}, "Scheme", "implicit");
    file.set({"Time integration"}, "End time", text(0.75 / c));
    file.set({"Output"}, "Probe points", "0.3, 0");
    file.set({"Output"}, "Probe quantities", "velocity");
    const auto lines   = run(file);
    double     highest = 0.;
    for (const auto &line : lines)
      highest =
        std::max(highest, value(line, "velocity x at probe 1") / strip.V);
    std::ostringstream name;
    name << "implicit front of " << c << " on " << n << " cells";
    report.require(name.str() + ", overshoot", std::max(0., highest - 1.), 0.1);
    report.require(name.str() + ", energy gained",
                   std::max(0.,
                            -value(lines.back(), "lost by time stepping") /
                              value(lines.back(), "external work")),
                   0.01);
    // half of the work of a piston
    report.require(name.str() + ", dissipation",
                   (value(lines.back(), "shock dissipation") +
                    value(lines.back(), "lost by time stepping")) /
                       value(lines.back(), "external work") -
                     0.5,
                   0.02);
  }

  /** A smooth pulse of 20 cells after 15 times its length. */
  void
  smooth_pulse(Report &report, const std::string &name, const bool loosened)
  {
    // the binder alone has a hundredth of the modulus
    const double modulus = loosened ? 100. : 1.;
    SceneFile    file    = strip(2, 360, 18., modulus, false);
    if (loosened)
      {
        file.set({"Materials", "grains"}, "Binder", "proportional");
        file.set({"Materials", "grains"}, "Binder ratio", "0.01");
      }
    file.set({"Initial state"},
             loosened ? "Strain" : "Stress",
             loosened ? "0.1; 0; 0; 0" : "-0.1; 0; 0; 0");
    const double sign = loosened ? -1. : 1.;
    file.set({"Boundaries", "left"},
             "Pressure",
             text(sign * 0.1) + " + 0.001*if(t < 1, sin(pi*t)^2, 0)");
    file.set({"Boundaries", "right"}, "Displacement x", "0");
    file.set({"Time integration"}, "End time", "16.5");
    file.set({"Output"}, "Probe points", "15, 0");
    file.set({"Output"}, "Probe quantities", "velocity");
    if (loosened)
      file.set({"Time integration"}, "Statistics every", "10");
    double highest = 0.;
    for (const auto &line : run(file))
      highest = std::max(highest, value(line, "velocity x at probe 1"));
    report.require(name, std::max(0., 1. - highest / 0.001), 0.03);
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    falling_column(report, 2, 10);
    falling_column(report, 2, 25);
    falling_column(report, 3, 10);
    falling_column(report, 2, 10, true);
    falling_column(report, 3, 10, true);
    for (const double lateral : {0.01, 1., 1000.})
      falling_column(report, 2, 20, false, lateral);
    falling_column(report, 3, 10, false, 1.);
    thrown_column(report, "viscous");
    thrown_column(report, "yielding");
    settling_ground(report);
    fibers(report);
    shear_front(report);
    weak_front(report, 0.1, false);
    weak_front(report, 0.1, true);
    weak_front(report, 0.03, false);
    weak_front(report, 0.01, false);
    implicit_front(report, 0.05, 100);
    implicit_front(report, 0.1, 200);
    smooth_pulse(report, "smooth pulse, closed ground", false);
    smooth_pulse(report, "smooth pulse, loosened ground", true);
  });
}
