// A manufactured plane strain solution on distorted meshes, displacements
// prescribed, with forces per volume. Smooth: order p + 1.

#include "verification.h"

int
main(int argc, char **argv)
{
  using namespace Verification;
  return Verification::main(argc, argv, [](Report &report) {
    for (const unsigned int p : {1U, 2U})
      {
        Convergence study;
        for (unsigned int level = 0; level < 6 - p; ++level)
          study.add(run(source_directory +
                          "/tests/verification/scenes/manufactured.prm",
                        {degree(p), refinement(level)})
                      .back());
        report.out << "degree " << p << std::endl;
        study.print(report.out);
        report.require_order("L2 norm", study.order(), p + 0.9);
        report.require("L2 error", study.last_error(), p == 1 ? 1e-3 : 3e-5);
      }
  });
}
