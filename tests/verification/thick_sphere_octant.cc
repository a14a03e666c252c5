// The octant of a thick sphere of Coulomb-Mohr material, in three dimensions.
// Degree 1 is here for its order: 0.1 % would take it 300,000 unknowns.

#include "granular_sphere.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    RadialStudy study;
    study.scene          = source_directory + "/prm/thick_sphere_octant.prm";
    study.overrides      = {"Load steps/Step size=1"};
    study.levels         = {{{0, 3}, {0, 3}}};
    study.allowed_error  = {{5e-2, 1e-3}};
    study.expected_order = {{1.5, 1.5}};
    for (const double q_a : {1.90140718, 2.43149425})
      study(report,
            "Coulomb-Mohr, q_a = " + std::to_string(q_a),
            granular_sphere(3., 1., q_a));
  });
}
