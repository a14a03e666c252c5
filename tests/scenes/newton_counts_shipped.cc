// Iterations of the shipped scenes that have a binder, adaptive as they are. The
// pulled specimen is loaded to where its mechanism of collapse begins; the
// footing is on a smaller mesh.

#include "newton_counts.h"

using namespace Signoton;

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  const auto count = [&](const std::string              &scene,
                         const std::string              &material,
                         const std::vector<std::string> &settings) {
    verdict(
      scene,
      NewtonCounts::sweep("prm/" + scene + ".prm", material, {{}}, settings));
  };
  count("quickstart", "ground", {});
  count("cut_specimen", "soil", {"Load steps/End time=0.4"});
  count("cut_specimen_compression", "soil", {});
  count("footing_3d",
        "ground",
        {"Geometry/Arguments=3, 3, 2: 0, 0, 0: 6, 6, 4: true",
         "Geometry/Boundary names=footing: z > 3.999 && x < 2 && y < 2",
         "Geometry/Initial refinement=0",
         "Refinement/Cycles in first step=2",
         "Refinement/Maximum unknowns=6000"});
  return verdict.status();
}
