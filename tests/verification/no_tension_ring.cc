// The no-tension ring in plane strain: growth of the zone of radial cracks.

#include "radial_study.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.scene           = source_directory + "/prm/no_tension_ring.prm";
    study.overrides       = {"Load steps/Step size=1"};
    study.space_dimension = 2;
    study.levels          = {{{2, 5}, {1, 4}}};
    study.allowed_error   = {{1e-3, 2e-4}};
    const double a = 1., b = 2., E = 10. / (1. - 0.25 * 0.25), nu = 1. / 3.;
    // with the last of them the mesh line r = 1.5 is the edge of the cracks
    for (const double q_a : {1.7, 1.9, 1.92})
      {
        if (q_a == 1.92)
          study.expected_order = {{1.85, 2.6}};
        const double c =
          (b * b - std::sqrt(b * b * b * b - q_a * q_a * b * b)) / q_a;
        const double A = -q_a / (2. * c), B = q_a * c / 2.;
        const auto   u = [&](const double r) {
          return ((1. - nu) * A * r + (1. + nu) * B / r) / E;
        };
        study(report,
              "No tension, q_a = " + std::to_string(q_a),
              {a,
               b,
               u(c) + q_a / E * std::log(c),
               u(b),
               c,
               {{"q_a", q_a}, {"c", c}}});
      }
  });
}
