// Curves and surfaces of a geometry of gmsh are kept under refinement: a lined
// ring, curved between its materials too, and a sphere in three dimensions
// converge as Lame's solutions on exact boundaries do. On the polygons of the
// first mesh displacements are wrong by percents.

#include "radial_study.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

namespace
{
  using namespace dealii;

  /** A, B, C, D of u = A r + B/r in the lining and C r + D/r in the ground.
   *  The radial stress is 2 (lambda + mu) A - 2 mu B/r^2. */
  Vector<double>
  lined_ring()
  {
    const double a = 1., c = 1.4, b = 2., pressure = 1e3;
    const auto   bulk = [](const double E, const double nu) {
      return E / ((1. + nu) * (1. - 2. * nu)); // 2 (lambda + mu)
    };
    const auto shear = [](const double E, const double nu) {
      return E / (1. + nu); // 2 mu
    };
    const double k1 = bulk(4e6, .2), m1 = shear(4e6, .2), k2 = bulk(1e6, .3),
                 m2 = shear(1e6, .3);
    FullMatrix<double> conditions(4, 4);
    const double       rows[4][4] = {{k1, -m1 / (a * a), 0., 0.},
                                     {0., 0., k2, -m2 / (b * b)},
                                     {k1, -m1 / (c * c), -k2, m2 / (c * c)},
                                     {c, 1. / c, -c, -1. / c}};
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        conditions(i, j) = rows[i][j];
    Vector<double> right_side(4), result(4);
    right_side[0] = -pressure;
    conditions.gauss_jordan();
    conditions.vmult(result, right_side);
    return result;
  }
} // namespace

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Verification::Report &report) {
    const std::string scenes =
      Verification::source_directory + "/tests/verification/scenes/";
    const auto                u = lined_ring();
    Verification::RadialStudy ring;
    ring.scene           = scenes + "lined_ring.prm";
    ring.space_dimension = 2;
    ring.levels          = {{{1, 4}, {0, 3}}};
    ring.allowed_error   = {{1e-3, 1e-5}};
    ring.expected_order  = {{1.9, 2.9}};
    ring(report,
         "Lined ring",
         {1.,
          2.,
          u[0] + u[1],
          2. * u[2] + u[3] / 2.,
          1.,
          {{"A", u[0]}, {"B", u[1]}, {"C", u[2]}, {"D", u[3]}}});

    Verification::RadialStudy sphere;
    sphere.scene          = scenes + "sphere_octant.prm";
    sphere.levels         = {{{1, 3}, {1, 3}}};
    sphere.allowed_error  = {{1e-2, 2e-4}};
    sphere.expected_order = {{1.8, 2.7}};
    sphere(report, "Sphere", {1., 2., 8e-4, 3e-4, 1., {}});
  });
}
