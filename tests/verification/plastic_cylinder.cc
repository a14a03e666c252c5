// The elastic-plastic tube in plane strain: Tresca's prism; von Mises' cylinder,
// whose solution tends to the same when the material becomes incompressible.

#include "radial_study.h"

namespace
{
  using namespace Verification;

  const double a = 0.1, b = 0.2, E = 210e9, Y = 480e6 / std::sqrt(3.);

  /** The yielded zone reaches the radius @p c. */
  RadialSolution
  tube(const double c, const double nu)
  {
    const double p = Y * (std::log(c / a) + 0.5 * (1. - c * c / (b * b)));
    const double u_a =
      (-(1. + nu) * (1. - 2. * nu) * a * p + (1. - nu * nu) * Y * c * c / a) /
      E;
    const double u_b = (1. - nu * nu) * Y * c * c / (E * b);
    return {
      a, b, u_a, u_b, c, {{"p", p}, {"c", c}, {"nu", nu}}, [=](const double u) {
        return std::sqrt(u * E * b / ((1. - nu * nu) * Y));
      }};
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.scene =
      source_directory + "/tests/verification/scenes/plastic_cylinder.prm";
    study.space_dimension  = 2;
    study.coarse_edge      = 0.1;
    study.levels           = {{{2, 6}, {1, 4}}};
    study.allowed_error    = {{1e-3, 1e-3}};
    const auto orders_with = [](const double c) {
      // c = 0.15 is a mesh line
      return c == 0.15 ? std::array<double, 2>{{1.85, 2.6}} :
                         RadialStudy().expected_order;
    };
    const double numbers[][2] = {{0.12, 8.6463976314e-05},
                                 {0.14, 1.1768707887e-04},
                                 {0.15, 1.3509996299e-04},
                                 {0.16, 1.5371373567e-04},
                                 {0.18, 1.9454394671e-04}};
    for (const auto &[c, u_b] : numbers)
      {
        const auto exact = tube(c, 0.3);
        report.require("u(b) of the formula", exact.u_b / u_b - 1., 1e-9);
        study.expected_order = orders_with(c);
        study(report, "Tresca, c = " + std::to_string(c), exact);
      }

    // Degree 1 locks in a nearly incompressible material.
    study.degrees   = {2};
    study.overrides = {"Materials/steel/Admissible set=von mises",
                       "Materials/steel/Poisson ratio=0.499"};
    for (const double c : {0.12, 0.15, 0.18})
      {
        study.expected_order = orders_with(c);
        study(report,
              "von Mises, nearly incompressible, c = " + std::to_string(c),
              tube(c, 0.499));
      }

    // A compressible tube of von Mises has no closed form. The displacement is
    // that of an independent radial solution with quadratic elements in 120
    // steps. Its limit load is the incompressible one, where all rates are
    // plastic.
    const auto run_to = [&](const double p, const std::string &step) {
      return Overrides{"Materials/steel/Admissible set=von mises",
                       refinement(4),
                       degree(2),
                       "Load steps/Step size=" + step,
                       constants({{"p", p}, {"c", b}, {"nu", 0.3}})};
    };
    const double u_b =
      value(run(study.scene, run_to(1.892194e8, "0.01")).back(),
            "displacement x at probe 2");
    report.out << "von Mises, compressible, p = 189.2194 MPa: u(b) = "
               << std::scientific << u_b << std::endl;
    report.require("u(b), compressible", u_b / 1.97950109e-04 - 1., 5e-4);

    const double limit    = Y * std::log(b / a);
    auto         too_high = run_to(1.01 * limit, "0.25");
    too_high.emplace_back("Load steps/Minimum step size=5e-4");
    report.require("status above the limit load",
                   attempt(study.scene, too_high) !=
                     Signoton::ExitStatus::no_equilibrium,
                   0.);
    const double reached =
      1.01 *
      value(PhysicalNumbers::read("results/statistics.csv").back(), "time");
    report.out << "von Mises, compressible: reached "
               << report.round_off("load over limit load", reached - 1., 1e-3)
               << " of the limit load" << std::endl;
  });
}
