// The elastic-plastic tube with Tresca's prism, in plane strain.

#include "radial_study.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.scene =
      source_directory + "/tests/verification/scenes/plastic_cylinder.prm";
    study.space_dimension = 2;
    study.coarse_edge     = 0.1;
    study.levels          = {{{2, 5}, {1, 4}}};
    study.allowed_error   = {{5e-3, 1e-3}};
    const double a = 0.1, b = 0.2, E = 210e9, nu = 0.3,
                 Y = 480e6 / std::sqrt(3.);
    // c = 0.15 is a mesh line
    const double numbers[][2] = {{0.12, 8.6463976314e-05},
                                 {0.14, 1.1768707887e-04},
                                 {0.15, 1.3509996299e-04},
                                 {0.16, 1.5371373567e-04},
                                 {0.18, 1.9454394671e-04}};
    for (const auto &[c, u_b] : numbers)
      {
        const double p   = Y * (std::log(c / a) + 0.5 * (1. - c * c / (b * b)));
        const double u_a = (-(1. + nu) * (1. - 2. * nu) * a * p +
                            (1. - nu * nu) * Y * c * c / a) /
                           E;
        report.require("u(b) of the formula",
                       (1. - nu * nu) * Y * c * c / (E * b) / u_b - 1.,
                       1e-9);
        study.expected_order = c == 0.15 ? std::array<double, 2>{{1.85, 2.6}} :
                                           RadialStudy().expected_order;
        study(report,
              "Tresca, c = " + std::to_string(c),
              {a, b, u_a, u_b, c, {{"p", p}, {"c", c}}});
      }
  });
}
