// Runs a scene for a test and prints the physical numbers of every step. A
// scene that is refused, or has no equilibrium, prints its message and status.
// Further arguments are passed on to the scene as --set does.

#include "physical_numbers.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <filesystem>
#include <iostream>

int
main(int argc, char **argv)
{
  using namespace Signoton;
  MPISession mpi(argc, argv);
  const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  Options    options;
  options.scene_file       = argv[1];
  options.output_directory = "results";
  if (root)
    std::filesystem::remove_all("results");
  MPI_Barrier(MPI_COMM_WORLD);
  options.overrides = std::vector<std::string>(argv + 2, argv + argc);

  std::ofstream output;
  if (root)
    output.open("output");
  try
    {
      const ExitStatus status = run_scene(MPI_COMM_WORLD, options);
      if (!root)
        return 0;
      for (const auto &line : PhysicalNumbers::read("results/statistics.csv"))
        {
          output << "step\n";
          PhysicalNumbers::print(output, line);
        }
      output << "status " << static_cast<int>(status) << "\n";
    }
  catch (const UserError &error)
    {
      std::string       text = error.what();
      const std::string source(SIGNOTON_SOURCE_DIR "/tests/");
      for (auto at = text.find(source); at != std::string::npos;
           at      = text.find(source))
        text.erase(at, source.size());
      if (root)
        output << text << "status " << static_cast<int>(error.status) << "\n";
    }
  return 0;
}
