// Lamb's problem against exact solutions: the line load on a half-plane (Lamb
// 1904; Cagniard and de Hoop) and the point load on a half-space (Pekeris 1955),
// in axisymmetry and in space; the speeds of P, S and Rayleigh waves.

#include "verification.h"

#include <deal.II/base/quadrature_lib.h>

#include <complex>

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  const double mu = 8e7, c_s = 200., pi = numbers::PI; // rho is 2000

  /** Ratio of the speeds of Rayleigh and S waves. */
  double
  rayleigh(const double nu)
  {
    const double x = (1. - 2. * nu) / (2. * (1. - nu));
    return root(
      [&](const double r) {
        return std::pow(2. - r * r, 2) -
               4. * std::sqrt(1. - r * r) * std::sqrt(1. - x * r * r);
      },
      0.5,
      1. - 1e-12);
  }

  /** Integral over (a, b) with nodes that crowd at both ends, where integrands
   *  may be singular. */
  double
  integral(const std::function<double(double)> &f,
           const double                         a,
           const double                         b)
  {
    if (!(b > a))
      return 0.;
    static const QGauss<1> rule(200);
    double                 sum = 0.;
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double y = rule.point(q)[0];
        sum += rule.weight(q) * 6. * y * (1. - y) *
               f(a + (b - a) * y * y * (3. - 2. * y));
      }
    return (b - a) * sum;
  }

  /** Vertical displacement, down, of the surface of a half-plane at x after a
   *  vertical line load P delta(t); has a simple pole when the Rayleigh wave
   *  passes. */
  double
  line_impulse(const double t, const double x, const double nu)
  {
    const double a = std::sqrt((1. - 2. * nu) / (2. * (1. - nu))) / c_s,
                 b = 1. / c_s, z = t / x;
    if (z <= a)
      return 0.;
    using Complex    = std::complex<double>;
    const double k_a = std::sqrt(z * z - a * a), k_b = b * b - z * z,
                 d  = std::pow(b * b - 2. * z * z, 2);
    const Complex D = k_b > 0. ?
                        Complex(d, -4. * z * z * k_a * std::sqrt(k_b)) :
                        Complex(d - 4. * z * z * k_a * std::sqrt(-k_b), 0.);
    return b * b / (pi * mu * x) * (Complex(0., -k_a) / D).imag();
  }

  /** The load of the scenes at time t, and its rate. */
  double
  ramp(const double t, const double T)
  {
    return t <= 0. ? 0. : t < T ? std::pow(std::sin(pi * t / (2. * T)), 2) : 1.;
  }
  double
  ramp_rate(const double t, const double T)
  {
    return t <= 0. || t >= T ? 0. : pi / (2. * T) * std::sin(pi * t / T);
  }

  /** The same after the load P ramp(t): a convolution, with the principal value
   *  at the pole taken over pairs of points. */
  double
  line_load(const double t,
            const double x,
            const double nu,
            const double P,
            const double T)
  {
    const double a   = std::sqrt((1. - 2. * nu) / (2. * (1. - nu))) / c_s,
                 t_S = x / c_s, t_R = x / (c_s * rayleigh(nu)),
                 half = 0.5 * (t_R - t_S);
    const auto f      = [&](const double s) {
      return P * ramp(t - s, T) * line_impulse(s, x, nu);
    };
    double     sum = 0.;
    const auto add = [&](const double from, const double to) {
      // the load has a kink where its ramp ends
      const double kink = t - T, end = std::min(to, t);
      if (kink > from && kink < end)
        sum += integral(f, from, kink) + integral(f, kink, end);
      else
        sum += integral(f, from, end);
    };
    add(a * x, t_S);
    add(t_S, t_R - half);
    sum += integral([&](const double y) { return f(t_R + y) + f(t_R - y); },
                    0.,
                    half);
    add(t_R + half, std::max(t, t_R + half));
    return sum;
  }

  /** The surface of a half-space of nu = 1/4 at r after a vertical point load
   *  P H(t), down (Pekeris). */
  double
  point_step(const double t, const double r)
  {
    const double T = c_s * t / r, w = std::sqrt(3.), g = (3. + w) / 4.;
    if (T < 1. / w)
      return 0.;
    if (T < 1.)
      return 1. / (32. * pi * mu * r) *
             (6. - w / std::sqrt(T * T - 0.25) -
              std::sqrt(3. * w + 5.) / std::sqrt(g - T * T) +
              std::sqrt(3. * w - 5.) / std::sqrt(T * T + (w - 3.) / 4.));
    if (T < std::sqrt(g))
      return 1. / (16. * pi * mu * r) *
             (6. - std::sqrt(3. * w + 5.) / std::sqrt(g - T * T));
    return 3. / (8. * pi * mu * r);
  }

  double
  point_load(const double t, const double r, const double P, const double T)
  {
    const double w = std::sqrt(3.), g = std::sqrt((3. + w) / 4.);
    // break at the arrivals
    std::vector<double> breaks = {0., std::min(T, t)};
    for (const double speed : {w, 1., 1. / g})
      {
        const double at = t - r / (c_s * speed);
        if (at > 0. && at < breaks.back())
          breaks.push_back(at);
      }
    std::sort(breaks.begin(), breaks.end());
    double sum = 0.;
    for (unsigned int i = 1; i < breaks.size(); ++i)
      sum += integral(
        [&](const double y) {
          return P * ramp_rate(y, T) * point_step(t - y, r);
        },
        breaks[i - 1],
        breaks[i]);
    return sum;
  }

  /** Largest difference from an exact history, by its largest value. */
  double
  error_of(const std::vector<PhysicalNumbers::Line> &lines,
           const std::string                        &column,
           const std::function<double(double)>      &exact)
  {
    double difference = 0., size = 0.;
    for (const auto &line : lines)
      {
        const double u = exact(value(line, "time"));
        difference = std::max(difference, std::abs(value(line, column) + u));
        size       = std::max(size, std::abs(u));
      }
    return difference / size;
  }

  void
  line(Report &report)
  {
    const SceneFile file =
      SceneFile::read(source_directory + "/prm/lamb_2d.prm");
    report.out << "Line load: error of the vertical displacement at 5, 10 and "
                  "15 m, of its largest value\n";
    double last = 0.;
    for (const std::string cells : {"24, 20", "48, 40", "96, 80"})
      {
        const auto lines =
          run(file,
              {"Geometry/Arguments=" + cells + " : 0, -20 : 24, 0 : true",
               "Output/Probe lines="});
        report.out << cells << " cells:" << std::setprecision(2);
        for (const int probe : {1, 2, 3})
          {
            last = error_of(lines,
                            "displacement y at probe " + std::to_string(probe),
                            [&](const double t) {
                              return line_load(t, 5. * probe, 0.25, 1e6, 0.02);
                            });
            report.out << ' ' << last;
            if (cells == "96, 80")
              report.require("line load at " + std::to_string(5 * probe) + " m",
                             last,
                             0.02);
          }
        report.out << '\n';
      }
  }

  void
  point(Report &report)
  {
    const SceneFile file =
      SceneFile::read(source_directory + "/prm/lamb_3d.prm");
    const auto compare = [&](const std::string         &name,
                             const auto                &lines,
                             const std::string         &axis,
                             const std::vector<double> &radii,
                             const double               T,
                             const double               bound) {
      report.out << name << ", error at";
      for (unsigned int i = 0; i < radii.size(); ++i)
        {
          const double e = error_of(lines,
                                    "displacement " + axis + " at probe " +
                                      std::to_string(i + 1),
                                    [&](const double t) {
                                      return point_load(t, radii[i], 1e6, T);
                                    });
          report.out << std::setprecision(3) << "  " << radii[i]
                     << " m: " << std::setprecision(2) << e;
          report.require(name, e, bound);
        }
      report.out << '\n';
    };
    compare("Point load in space",
            run(file, {"Output/Probe lines="}),
            "z",
            {6., 10., std::sqrt(98.)},
            0.04,
            0.05);

    SceneFile axial = SceneFile::read(source_directory + "/prm/lamb_2d.prm");
    axial.set({}, "Embedding", "axisymmetric");
    compare("Point load in axisymmetry",
            run(axial,
                {"Output/Probe lines=",
                 "Loads/Constants=P = 2e6, T = 0.02", // all of it
                 "Output/Probe points=5, 0; 10, 0"}),
            "y",
            {5., 10.},
            0.02,
            0.03);
  }

  /** When a column has its extreme value between two times. */
  double
  time_of_extreme(const std::vector<PhysicalNumbers::Line> &lines,
                  const std::string                        &column)
  {
    std::size_t best = 1;
    for (std::size_t i = 1; i + 1 < lines.size(); ++i)
      if (std::abs(value(lines[i], column)) >
          std::abs(value(lines[best], column)))
        best = i;
    const double a = value(lines[best - 1], column),
                 b = value(lines[best], column),
                 c = value(lines[best + 1], column),
                 h =
                   value(lines[best + 1], "time") - value(lines[best], "time");
    return value(lines[best], "time") + 0.5 * h * (a - c) / (a - 2. * b + c);
  }

  void
  speeds(Report &report)
  {
    for (const double nu : {0.25, 0.3})
      {
        const double c_p = c_s * std::sqrt(2. * (1. - nu) / (1. - 2. * nu));
        SceneFile file = SceneFile::read(source_directory + "/prm/lamb_2d.prm");
        const auto constants = [&](const double young) {
          std::ostringstream text;
          text << std::setprecision(17) << young;
          return text.str();
        };
        file.set({"Materials", "soil"},
                 "Young modulus",
                 constants(2. * (1. + nu) * mu));
        file.set({"Materials", "soil"}, "Poisson ratio", std::to_string(nu));
        file.set({"Output"}, "Probe lines", "");
        file.set({"Time integration"}, "Statistics every", "1");
        const auto report_speed =
          [&](const std::string &name, const double found, const double exact) {
            report.out << name << " wave, nu = " << std::setprecision(2) << nu
                       << ": speed off by " << std::setprecision(1)
                       << found / exact - 1. << '\n';
            report.require(name + " wave", found / exact - 1., 0.005);
          };
        {
          const auto lines =
            run(file,
                {"Geometry/Arguments=100, 30 : 0, -15 : 50, 0 : true",
                 "Time integration/End time=0.27",
                 "Point forces/hammer/Force=0; "
                 "-P/2*if(t < 2*T, sin(pi*t/(2*T))^2, 0)",
                 "Output/Probe points=20, 0; 40, 0"});
          report_speed("Rayleigh",
                       20. / (time_of_extreme(lines, "velocity y at probe 2") -
                              time_of_extreme(lines, "velocity y at probe 1")),
                       c_s * rayleigh(nu));
        }
        // a strip that moves along itself, or across
        for (const bool shear : {false, true})
          {
            SceneFile strip = file;
            strip.remove({"Point forces"});
            strip.remove({"Boundaries"});
            strip.set({"Geometry"}, "Arguments", "80, 1 : 0, 0 : 40, 1 : true");
            strip.set({"Geometry"}, "Periodic boundaries", "bottom: top");
            strip.set({"Boundaries", "left"},
                      "Traction",
                      shear ? "0; 1e3*sin(pi*t/0.02)^2*(t < 0.02)" :
                              "1e3*sin(pi*t/0.02)^2*(t < 0.02); 0");
            strip.set({"Output"}, "Probe points", "10, 0.5; 30, 0.5");
            const double c = shear ? c_s : c_p;
            const auto   lines =
              run(strip,
                  {"Time integration/End time=" + std::to_string(36. / c)});
            const std::string column =
              std::string("velocity ") + (shear ? "y" : "x") + " at probe ";
            report_speed(shear ? "S" : "P",
                         20. / (time_of_extreme(lines, column + "2") -
                                time_of_extreme(lines, column + "1")),
                         c);
          }
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  Report               report;
  // the exact solutions against numbers computed by other means
  report.require("line load, exact at 0.06 s",
                 line_load(0.06, 10., 0.25, 1e6, 0.02) / -5.0530284e-4 - 1.,
                 1e-5);
  report.require("line load, exact at 0.08 s",
                 line_load(0.08, 10., 0.25, 1e6, 0.02) / 1.5042114e-3 - 1.,
                 1e-5);
  line(report);
  point(report);
  speeds(report);
  return report.status();
}
