// Lame's sphere, axisymmetric: all integrals of the axisymmetric embedding,
// curved boundaries and pressure.

#include "radial_study.h"

int
main(int argc, char **argv)
{
  return Verification::main(argc, argv, [](Verification::Report &report) {
    Verification::RadialStudy study;
    study.scene = Verification::source_directory +
                  "/tests/verification/scenes/elastic_sphere.prm";
    study.coarse_edge    = 0.1;
    study.levels         = {{{2, 6}, {1, 5}}};
    study.allowed_error  = {{5e-4, 5e-6}};
    study.expected_order = {{1.9, 2.9}};
    study(report, "Lame", {0.1, 0.2, 4e-5, 1.5e-5, 0.1, {}});
  });
}
