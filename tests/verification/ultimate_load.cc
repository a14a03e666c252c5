// The strip with edge cuts carries, pulled, a load between the bounds of limit
// analysis by linear programming (stress field, velocity field), and pushed more
// than a column of the width of its ligament.

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <filesystem>
#include <iostream>

using namespace Signoton;

namespace
{
  /** Reaction of the grip over cohesion and ligament by steps. */
  std::vector<double>
  loads(const std::string &scene, const std::string &friction_angle)
  {
    Options options;
    options.scene_file       = SIGNOTON_SOURCE_DIR "/prm/" + scene + ".prm";
    options.output_directory = "results";
    std::filesystem::remove_all("results");
    options.overrides = {"Output/Fields every=0",
                         "Materials/soil/Friction angle=" + friction_angle};
    std::vector<double> result;
    if (run_scene(MPI_COMM_WORLD, options) == ExitStatus::completed)
      for (const auto &line : PhysicalNumbers::read("results/statistics.csv"))
        result.push_back(
          std::abs(PhysicalNumbers::value(line, "reaction grip y")) /
          (1e5 * 0.5));
    return result;
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  Verdicts   verdict;

  const auto check = [&](const std::string         &what,
                         const std::vector<double> &load,
                         const double               lower,
                         const double               upper) {
    // at the end of the run it levels off, between the bounds
    bool good = load.size() >= 2;
    if (good)
      {
        std::cout << what << ": " << lower << " <= " << load.back()
                  << " <= " << upper << ", last growth "
                  << load.back() - load[load.size() - 2] << std::endl;
        good = load.back() >= lower && load.back() <= upper &&
               load.back() - load[load.size() - 2] < 0.02 * load.back();
      }
    verdict(what, good);
  };
  check("pulled, 30 degrees", loads("cut_specimen", "30"), 1.478, 1.607);
  check("pulled, 20 degrees", loads("cut_specimen", "20"), 1.859, 2.013);
  check("pushed, 30 degrees",
        loads("cut_specimen_compression", "30"),
        2. * std::tan(numbers::PI / 3.),
        std::numeric_limits<double>::max());
  return verdict.status();
}
