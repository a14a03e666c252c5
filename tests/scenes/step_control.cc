// Steps that fail are cut and grow again; a reversible body ends where it does
// with whole steps, and nothing of a failed attempt is kept.

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <cmath>
#include <filesystem>

using namespace Signoton;
using PhysicalNumbers::value;

namespace
{
  std::vector<PhysicalNumbers::Line>
  run(const std::vector<std::string> &overrides)
  {
    Options options;
    options.scene_file =
      SIGNOTON_SOURCE_DIR "/tests/scenes/adaptive_granular.prm";
    options.output_directory = "results";
    std::filesystem::remove_all("results");
    options.overrides = {"Refinement/Cycles in first step=0",
                         "Refinement/Cycles per step=0",
                         "Geometry/Initial refinement=3",
                         "Linear solver/Method=direct",
                         "Newton/Tolerance=1e-12"};
    options.overrides.insert(options.overrides.end(),
                             overrides.begin(),
                             overrides.end());
    if (run_scene(MPI_COMM_WORLD, options) != ExitStatus::completed)
      return {};
    return PhysicalNumbers::read("results/statistics.csv");
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  const auto whole = run({});
  verdict("whole steps", whole.size() == 2);

  const auto cut  = run({"Newton/Maximum iterations=5"});
  bool       good = cut.size() > 2, grew = false;
  for (std::size_t i = 1; good && i < cut.size(); ++i)
    grew |= value(cut[i], "step size") > 1.4 * value(cut[i - 1], "step size");
  verdict("steps are cut", good);
  verdict("and grow again", grew);

  const auto easy = run({"Load steps/Step size=0.0625",
                         "Load steps/Growth=2",
                         "Load steps/Easy iterations=20",
                         "Load steps/Maximum step size=0.25"});
  good            = easy.size() > 2;
  for (std::size_t i = 0; good && i + 1 < easy.size(); ++i)
    good &= std::abs(value(easy[i], "step size") -
                     std::min(0.0625 * std::pow(2., i), 0.25)) < 1e-12;
  verdict("easy steps grow up to the largest", good);

  // the loads are functions of t: a late start is one large first step
  const auto late = run({"Load steps/Start time=0.25"});
  verdict("a late start", late.size() == 2);

  for (const auto &other : {cut, easy, late})
    {
      good = !whole.empty() && !other.empty();
      for (const char *name : {"stored energy",
                               "share of interior",
                               "displacement y at probe 1",
                               "displacement y at probe 2"})
        good = good &&
               std::abs(value(other.back(), name) / value(whole.back(), name) -
                        1.) < 1e-9;
      verdict("the same end", good);
    }
  return verdict.status();
}
