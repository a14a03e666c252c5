#ifndef signoton_tests_granular_sphere_h
#define signoton_tests_granular_sphere_h

#include "radial_study.h"

namespace Verification
{
  /**
   * The exact solution of prm/thick_sphere.prm and its octant: k = 1,
   * mu = 0.6, a = 1, b = 2, q_b = 1. The stress on the cone is a multiple of
   * (m_r, m_f, m_f).
   */
  inline RadialSolution
  granular_sphere(const double m_r, const double m_f, const double q_a)
  {
    const double k = 1., mu = 0.6, b = 2.;
    const double n = 2. * m_f / m_r, g = (1. - n / 2.) / (1. + n);
    const auto   outer = [=](const double c) {
      return 1. + 2. * g * c * c * c / (b * b * b);
    };
    const double c = root(
      [&](const double r) {
        return q_a * std::pow(r, n - 2.) * outer(r) - (1. + 2. * g);
      },
      1.,
      b);
    const double A = -1. / outer(c), B = -A * g * c * c * c;
    const auto   outer_displacement = [=](const double r) {
      return (-b / (3. * k) + g * r * r * r / (2. * mu * b * b)) / outer(r);
    };
    const double pressure = (m_r + 2. * m_f) / 3.;
    const double shear    = (m_r - m_f) / std::sqrt(3.);
    const double D1 = -q_a * (pressure * pressure / k + shear * shear / mu) /
                      (m_r * m_r * (2. * n - 1.));
    const auto u_outer = [&](const double r) {
      return A * r / (3. * k) + B / (2. * mu * r * r);
    };
    const double B1 = (u_outer(c) - D1 * std::pow(c, n - 1.)) * std::pow(c, n);
    return {1.,
            b,
            B1 + D1,
            u_outer(b),
            c,
            {{"q_a", q_a},
             {"c", c},
             {"n", n},
             {"A", A},
             {"B", B},
             {"B1", B1},
             {"D1", D1}},
            [=](const double u) {
              return root(
                [&](const double r) { return outer_displacement(r) - u; },
                1.,
                b);
            }};
  }

  /** Hold a formula against a number known otherwise. */
  inline void
  require_same(Report            &report,
               const std::string &what,
               const double       formula,
               const double       number)
  {
    report.require(what + " of the formula", formula - number, 1.5e-8);
  }
} // namespace Verification

#endif
