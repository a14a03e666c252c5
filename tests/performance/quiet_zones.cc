// What skipping the cells that no wave has reached saves: seconds of whole runs
// with and without, by scene. On any number of ranks.

#include "../verification/verification.h"

#include <deal.II/base/conditional_ostream.h>

using namespace Verification;

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  ConditionalOStream   out(std::cout,
                         Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  out << "| scene | quiet cells, mean | seconds | without quiet zones | ratio "
         "|\n|---|--:|--:|--:|--:|\n";
  const std::vector<std::pair<std::string, Overrides>> scenes = {
    {"lamb_2d", {"Geometry/Initial refinement=1"}},
    {"lamb_2d_granular", {"Geometry/Initial refinement=1"}},
    {"loosened_block",
     {"Refinement/Follow waves=false", "Geometry/Initial refinement=4"}},
    {"signoton_piston_3d", {}}};
  for (const auto &[name, overrides] : scenes)
    {
      double seconds[2] = {1e300, 1e300}, share = 0.;
      // in turns, the better of two: the machine may be busy
      for (unsigned int turn = 0; turn < 4; ++turn)
        {
          const bool quiet = turn % 2 == 0;
          Overrides  all   = overrides;
          all.insert(all.end(),
                     {"Output/Probe points=",
                      "Output/Probe lines=",
                      "Time integration/Snapshots=0",
                      "Time integration/Statistics every=10",
                      std::string("Time integration/Quiet zones=") +
                        (quiet ? "true" : "false")});
          const auto lines =
            Verification::run(source_directory + "/prm/" + name + ".prm", all);
          double &best = seconds[quiet ? 0 : 1];
          best         = std::min(best, value(lines.back(), "seconds"));
          if (turn == 0)
            for (const auto &line : lines)
              share += value(line, "share of quiet cells") / lines.size();
        }
      out << "| `" << name << ".prm` | " << std::setprecision(3) << 100. * share
          << " % | " << seconds[0] << " | " << seconds[1] << " | "
          << seconds[0] / seconds[1] << " |" << std::endl;
    }
}
