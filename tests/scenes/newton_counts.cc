// Iterations where the whole load comes in one step, on meshes of three sizes,
// with the multigrid whatever the size.

#include "newton_counts.h"

using namespace Signoton;

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  for (const std::string degree : {"1", "2"})
    {
      verdict("plane strain, degree " + degree,
              NewtonCounts::sweep("tests/scenes/adaptive_granular.prm",
                                  "sand",
                                  {{"Geometry/Initial refinement=1"},
                                   {"Geometry/Initial refinement=2"},
                                   {"Geometry/Initial refinement=3"}},
                                  {"Load steps/Step size=1",
                                   "Refinement/Cycles in first step=0",
                                   "Linear solver/Method=cg",
                                   "Discretization/Degree=" + degree}));
    }
  return verdict.status();
}
