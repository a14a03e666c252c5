// What a mesh that follows the waves saves at equal error: prm/loosened_block.prm
// on uniform meshes and on moving ones, against a finer uniform mesh. The error
// is that of the velocity on lines through the body, every twentieth of a second,
// in L1 and relative; what a uniform mesh of the same error would take is
// interpolated, in logarithms, between the uniform runs. Seconds are those of the
// whole run but for its output.
// usage: moving_mesh_benchmark [LEVEL_OF_REFERENCE], by default 6; on any number
// of ranks

#include "../verification/verification.h"

#include <deal.II/base/conditional_ostream.h>

using namespace Verification;
using Signoton::SceneFile;

namespace
{
  constexpr unsigned int n_lines = 9;

  struct Run
  {
    std::vector<double> velocity; ///< all components, points, times
    double              unknown_steps, seconds;

    double
    error(const Run &reference) const
    {
      double difference = 0., size = 0.;
      AssertDimension(velocity.size(), reference.velocity.size());
      for (std::size_t i = 0; i < velocity.size(); ++i)
        {
          difference += std::abs(velocity[i] - reference.velocity[i]);
          size += std::abs(reference.velocity[i]);
        }
      return difference / size;
    }
  };

  Run
  run(const unsigned int level, const std::string &threshold)
  {
    std::string lines;
    for (unsigned int l = 1; l <= n_lines; ++l)
      {
        const std::string y = std::to_string(l / (n_lines + 1.));
        lines += (l > 1 ? "; 0, " : "0, ") + y + " : 1, " + y + " : 200";
      }
    // a twentieth of a second is a number of steps
    std::ostringstream step;
    step << std::setprecision(17) << std::ldexp(0.1 / 12., 2 - int(level));
    Overrides overrides = {"Output/Probe points=",
                           "Output/Probe quantities=velocity",
                           "Output/Probe lines=" + lines,
                           "Output/Probe line samples=12",
                           "Time integration/Snapshots=0",
                           "Time integration/Time step=" + step.str(),
                           "Time integration/Statistics every=1000000"};
    if (threshold.empty())
      {
        overrides.emplace_back("Refinement/Follow waves=false");
        overrides.emplace_back("Geometry/Initial refinement=" +
                               std::to_string(level));
      }
    else
      {
        overrides.emplace_back("Refinement/Maximum level=" +
                               std::to_string(level));
        overrides.emplace_back("Refinement/Refine threshold=" + threshold);
        overrides.emplace_back("Refinement/Coarsen threshold=" +
                               std::to_string(0.2 * std::stod(threshold)));
      }
    const auto statistics =
      Verification::run(source_directory + "/prm/loosened_block.prm",
                        overrides);
    Run result;
    result.unknown_steps = value(statistics.back(), "unknowns by steps");
    result.seconds       = value(statistics.back(), "seconds") -
                     value(statistics.back(), "seconds of output");
    for (unsigned int l = 1; l <= n_lines; ++l)
      for (const auto &line :
           PhysicalNumbers::read("results/line-" + std::to_string(l) + ".csv"))
        if (!line.empty())
          for (const std::string component : {"velocity x", "velocity y"})
            result.velocity.push_back(value(line, component));
    return result;
  }

  /** The work of a uniform mesh at an error, by the runs next to it. */
  double
  interpolate(const std::vector<std::pair<double, double>> &error_and_work,
              const double                                  error)
  {
    std::size_t i = 0;
    while (i + 2 < error_and_work.size() && error_and_work[i + 1].first > error)
      ++i;
    const auto &[e0, w0] = error_and_work[i];
    const auto &[e1, w1] = error_and_work[i + 1];
    const double part    = std::log(error / e0) / std::log(e1 / e0);
    return w0 * std::pow(w1 / w0, part);
  }
} // namespace

int
main(int argc, char **argv)
{
  Signoton::MPISession mpi(argc, argv);
  ConditionalOStream   out(std::cout,
                         Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  const unsigned int   finest    = argc > 1 ? std::stoi(argv[1]) : 6;
  const Run            reference = run(finest, "");
  std::vector<std::pair<double, double>> unknown_steps, seconds;
  out << "| mesh | error | million unknowns by steps | seconds | unknowns by "
         "steps of uniform | seconds of uniform |\n"
         "|---|--:|--:|--:|--:|--:|\n";
  for (unsigned int level = 1; level < finest; ++level)
    {
      const Run    result = run(level, "");
      const double error  = result.error(reference);
      unknown_steps.emplace_back(error, result.unknown_steps);
      seconds.emplace_back(error, result.seconds);
      out << "| uniform, level " << level << std::setprecision(3) << " | "
          << error << " | " << 1e-6 * result.unknown_steps << " | "
          << result.seconds << " | 1 | 1 |" << std::endl;
    }
  for (unsigned int level = finest - 2; level < finest; ++level)
    for (const std::string threshold : {"0.2", "0.1", "0.05"})
      {
        const Run    result = run(level, threshold);
        const double error  = result.error(reference);
        out << "| up to level " << level << ", threshold " << threshold << " | "
            << error << " | " << 1e-6 * result.unknown_steps << " | "
            << result.seconds << " | "
            << result.unknown_steps / interpolate(unknown_steps, error) << " | "
            << result.seconds / interpolate(seconds, error) << " |"
            << std::endl;
      }
}
