// A thick sphere of granular material with both cones, axisymmetric: growth of
// the loosened zone.

#include "granular_sphere.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.overrides = {"Load steps/Step size=1", "Linear solver/Method=direct"};
    study.levels    = {{{2, 6}, {1, 4}}};

    study.scene             = source_directory + "/prm/thick_sphere.prm";
    const double kappa      = 0.5;
    const double m_r        = 1. + 2. * kappa / std::sqrt(3.);
    const double m_f        = 1. - kappa / std::sqrt(3.);
    const double mises[][4] = {
      {1.67203118, 1.16301478, 0.04183184, -0.51373586},
      {1.87288517, 1.36194328, 0.23273322, -0.43536227},
      {2.07373915, 1.67126724, 0.56645999, -0.28867439}};
    for (const auto &[q_a, c, u_a, u_b] : mises)
      {
        const auto exact = granular_sphere(m_r, m_f, q_a);
        require_same(report, "c", exact.c, c);
        require_same(report, "u(a)", exact.u_a, u_a);
        require_same(report, "u(b)", exact.u_b, u_b);
        study(report, "Mises-Schleicher, q_a = " + std::to_string(q_a), exact);
      }

    // the mesh line r = 1.5 as the edge of the loosened zone
    const double n = 2. * m_f / m_r, g = (1. - n / 2.) / (1. + n);
    const double q_a_of_line = (1. + 2. * g) /
                               (1. + 2. * g * std::pow(1.5 / 2., 3)) *
                               std::pow(1.5, 2. - n);
    study.expected_order = {{1.85, 2.6}};
    study(report,
          "Mises-Schleicher, edge on a mesh line",
          granular_sphere(m_r, m_f, q_a_of_line));
    study.expected_order = RadialStudy().expected_order;

    study.scene = source_directory +
                  "/tests/verification/scenes/thick_sphere_coulomb_mohr.prm";
    const double coulomb[][4] = {
      {1.90140718, 1.16245164, 0.16306873, -0.46303185},
      {2.43149425, 1.66702412, 0.75261173, -0.19177435}};
    for (const auto &[q_a, c, u_a, u_b] : coulomb)
      {
        const auto exact = granular_sphere(3., 1., q_a);
        require_same(report, "c", exact.c, c);
        require_same(report, "u(a)", exact.u_a, u_a);
        require_same(report, "u(b)", exact.u_b, u_b);
        study(report, "Coulomb-Mohr, q_a = " + std::to_string(q_a), exact);
      }
  });
}
