// Hill's elastic-plastic sphere with the von Mises cylinder, axisymmetric.

#include "radial_study.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.scene         = source_directory + "/prm/plastic_sphere.prm";
    study.overrides     = {"Load steps/Step size=0.5",
                           "Linear solver/Method=direct"};
    study.coarse_edge   = 0.1;
    study.levels        = {{{2, 7}, {1, 4}}};
    study.allowed_error = {{1e-3, 1e-3}};
    const double a = 0.1, b = 0.2, E = 210e9, nu = 0.3, Y = 240e6;
    const double numbers[][3] = {{0.12, 9.7677267188e-05, 3.456e-05},
                                 {0.15, 2.1530985678e-04, 6.75e-05},
                                 {0.18, 4.0456045730e-04, 1.1664e-04}};
    for (const auto &[c, u_a, u_b] : numbers)
      {
        const double p =
          2. * Y * std::log(c / a) + 2. / 3. * Y * (1. - std::pow(c / b, 3));
        const auto u = [&, c = c](const double r, const double radial_stress) {
          return ((1. - 2. * nu) * r * radial_stress +
                  (1. - nu) * Y * c * c * c / (r * r)) /
                 E;
        };
        report.require("u(a) of the formula", u(a, -p) / u_a - 1., 1e-9);
        report.require("u(b) of the formula", u(b, 0.) / u_b - 1., 1e-9);
        // c = 0.15 is a mesh line
        study.expected_order = c == 0.15 ? std::array<double, 2>{{1.85, 2.6}} :
                                           RadialStudy().expected_order;
        study(report,
              "von Mises, c = " + std::to_string(c),
              {a, b, u_a, u_b, c, {{"p", p}, {"c", c}}, [=](const double u) {
                 return std::cbrt(u * E * b * b / ((1. - nu) * Y));
               }});
      }
  });
}
