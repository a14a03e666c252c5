// Newton's method takes at most 15 iterations, and conjugate gradients at most
// 80 an iteration, for binders from strong to nearly none and on all meshes:
// the whole load in one step. The counts go to the log, the verdict is compared.

#include "physical_numbers.h"

#include <signoton/scene/scene.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/table_handler.h>

#include <iostream>

using namespace Signoton;

namespace
{
  bool
  sweep(const std::string              &scene,
        const std::vector<std::string> &meshes,
        const std::vector<std::string> &always)
  {
    TableHandler table;
    bool         ok = true;
    for (const std::string &mesh : meshes)
      for (const std::string lambda :
           {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"})
        {
          Options options;
          options.scene_file =
            SIGNOTON_SOURCE_DIR "/tests/scenes/" + scene + ".prm";
          options.output_directory = "counts";
          options.overrides        = always;
          options.overrides.push_back("Materials/sand/Binder ratio=" + lambda);
          options.overrides.push_back("Geometry/Initial refinement=" + mesh);
          const bool completed =
            run_scene(MPI_COMM_WORLD, options) == ExitStatus::completed;
          const auto line =
            PhysicalNumbers::read("counts/statistics.csv").back();
          const auto value = [&](const std::string &name) {
            return PhysicalNumbers::value(line, name);
          };
          const double newton = value("newton iterations of all solves"),
                       cg     = value("most linear iterations");
          table.add_value("unknowns", value("unknowns"));
          table.add_value("lambda", lambda);
          table.add_value("Newton", newton);
          table.add_value("most CG", cg);
          table.add_value("on the cone", 1. - value("share of interior"));
          ok &= completed && newton <= 15 && cg <= 80;
        }
    std::cout << scene << ":\n";
    table.write_text(std::cout);
    return ok;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::ofstream                    output("output");
  const std::vector<std::string>   common = {"Load steps/Step size=1",
                                             "Refinement/Cycles in first step=0",
                                             "Linear solver/Method=cg"};
  bool                             ok     = true;
  for (const std::string degree : {"1", "2"})
    {
      auto settings = common;
      settings.push_back("Discretization/Degree=" + degree);
      const bool good = sweep("adaptive_granular", {"1", "2", "3"}, settings);
      output << "plane strain, degree " << degree << ": "
             << (good ? "ok" : "FAILED") << "\n";
      ok &= good;
    }
  return ok ? 0 : 1;
}
