// Conjugate gradients, GMRES and the direct solver lead to the same adaptive
// solution, with and without history, whatever their parameters.

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <filesystem>

using namespace Signoton;

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;
  for (const std::string scene : {"adaptive_granular", "adaptive_plastic"})
    {
      PhysicalNumbers::Line                       reference;
      const std::vector<std::vector<std::string>> variants = {
        {"Linear solver/Method=direct"},
        {"Linear solver/Method=cg"},
        {"Linear solver/Method=gmres"},
        {"Linear solver/Method=auto"},
        {"Linear solver/Method=auto", "Linear solver/Direct below in 2D=1"},
        {"Linear solver/Method=cg",
         "Linear solver/Aggregation threshold=0.1",
         "Linear solver/Smoother sweeps=2"},
        {"Linear solver/Method=cg", "Newton/Tangent regularization=1e-3"}};
      for (const auto &variant : variants)
        {
          Options options;
          options.scene_file =
            SIGNOTON_SOURCE_DIR "/tests/scenes/" + scene + ".prm";
          options.output_directory = "results";
          std::filesystem::remove_all("results");
          options.overrides = variant;
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
          verdict(scene + " with " + join(variant, ", "), good);
        }
    }
  return verdict.status();
}
