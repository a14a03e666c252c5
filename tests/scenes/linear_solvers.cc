// Conjugate gradients, GMRES and the direct solver lead to the same adaptive
// solution, with and without history.

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/scene/scene.h>

#include <deal.II/base/mpi.h>

using namespace Signoton;

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Verdicts                         verdict;
  for (const std::string scene : {"adaptive_granular", "adaptive_plastic"})
    {
      PhysicalNumbers::Line reference;
      for (const std::string method : {"direct", "cg", "gmres"})
        {
          Options options;
          options.scene_file =
            SIGNOTON_SOURCE_DIR "/tests/scenes/" + scene + ".prm";
          options.output_directory = "results";
          options.overrides        = {"Linear solver/Method=" + method};
          bool good =
            run_scene(MPI_COMM_WORLD, options) == ExitStatus::completed;
          const auto line =
            PhysicalNumbers::read("results/statistics.csv").back();
          if (reference.empty())
            reference = line;
          // numbers of a kind share a scale
          std::map<std::string, double> scale;
          for (const auto &[name, value] : reference)
            {
              double &s = scale[PhysicalNumbers::group(name)];
              s         = std::max(s, std::abs(value));
            }
          unsigned int compared = 0;
          for (unsigned int i = 0; i < line.size(); ++i)
            if (PhysicalNumbers::is_physical(line[i].first))
              {
                ++compared;
                good &= std::abs(line[i].second - reference[i].second) <=
                        1e-8 * scale[PhysicalNumbers::group(line[i].first)];
              }
          good &= compared > 10;
          verdict(scene + " by " + method, good);
        }
    }
  return verdict.status();
}
