// The infinite slope at five angles: displacements of the surface. They are
// parabolic: degree 2 has them to round-off, degree 1 with order 2.

#include "verification.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    const std::string scene = source_directory + "/prm/inclined_layer.prm";
    const double      kappa = 0.5, mu = 0.6, k = 1.;
    const double      w = 2. * kappa / std::sqrt(3.);

    // u_x and settlement of the surface
    const auto exact = [&](const double slope) {
      const double alpha = slope * numbers::PI / 180.;
      const double psi   = root(
        [&](const double x) {
          return kappa * std::sin(x) / (1. + w * std::cos(x)) - std::tan(alpha);
        },
        0.,
        std::acos(-w));
      const double R = 1e-3 * std::cos(alpha) * (mu + kappa * kappa * k) /
                       (mu * k * (kappa + std::sqrt(3.) / 2. * std::cos(psi)) *
                        (1. + w * std::cos(psi)));
      return std::make_pair(std::sin(psi) * R / 2.,
                            std::sqrt(3.) / 4. * std::cos(psi) * R);
    };
    const auto scene_constants = [&](const double slope) {
      const auto [u, settlement] = exact(slope);
      return constants({{"slope", slope}, {"U", u}, {"W", settlement}});
    };

    const double numbers[][3] = {{25., 1.00111813e-3, 9.87851916e-5},
                                 {28., 1.65705037e-3, -1.64510922e-4},
                                 {30., 2.97227463e-3, -8.15946017e-4},
                                 {31., 5.81882339e-3, -2.41765890e-3},
                                 {31.4, 1.52134267e-2, -8.04894607e-3}};
    report.out << "degree 2: displacements of the surface in thousandths"
               << std::endl;
    for (const auto &[slope, u_x, settlement] : numbers)
      {
        const auto line = run(scene,
                              {degree(2),
                               refinement(0),
                               "Newton/Tolerance=1e-13",
                               scene_constants(slope)})
                            .back();
        const double u = value(line, "displacement x at probe 1");
        const double s = -value(line, "displacement y at probe 1");
        report.out << "  slope " << std::defaultfloat << slope << std::fixed
                   << std::setprecision(7) << ": u_x " << 1e3 * u
                   << ", settlement " << 1e3 * s << ", exact: "
                   << report.round_off("relative L2 error",
                                       value(line, "relative L2 error"),
                                       1e-7)
                   << ", as tabulated: "
                   << report.round_off("u_x against the table",
                                       u / u_x - 1.,
                                       2e-8)
                   << " "
                   << report.round_off("settlement against the table",
                                       s / settlement - 1.,
                                       2e-8)
                   << std::endl;
      }

    const bool slides =
      attempt(scene,
              {constants({{"slope", 31.6}, {"U", 1.}, {"W", 1.}}),
               "Load steps/Minimum step size=0.5"}) ==
      Signoton::ExitStatus::no_equilibrium;
    report.require("equilibrium beyond the limit", slides ? 0. : 1., 0.);
    report.out << "  slope 31.6: " << (slides ? "no " : "") << "equilibrium"
               << std::endl;

    report.out << std::endl << "degree 1, slope 30" << std::endl;
    Convergence study;
    for (unsigned int level = 0; level < 5; ++level)
      study.add(run(scene, {degree(1), refinement(level), scene_constants(30.)})
                  .back());
    study.print(report.out);
    report.require_order("degree 1", study.order(), 1.95);
    report.require("L2 error", study.last_error(), 1e-3);
  });
}
