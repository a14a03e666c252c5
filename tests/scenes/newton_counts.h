#ifndef signoton_tests_newton_counts_h
#define signoton_tests_newton_counts_h

#include "physical_numbers.h"
#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <deal.II/base/table_handler.h>

#include <filesystem>
#include <iostream>

/**
 * Counting iterations: a scene is run for binders from strong to nearly none,
 * the counts go to a table on the screen, and the verdict is whether each
 * solve, on each mesh of each step, took at most 15 Newton iterations with at
 * most 80 linear ones in each, and each step ended superlinearly.
 */
namespace NewtonCounts
{
  using namespace Signoton;

  inline const std::vector<std::string> binder_ratios =
    {"1e-1", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"};

  /** @param variants overrides of the scene that are run one after the other
   *  @param always   overrides of all of them */
  inline bool
  sweep(const std::string                           &scene,
        const std::string                           &binder_key,
        const std::vector<std::vector<std::string>> &variants,
        const std::vector<std::string>              &always = {})
  {
    TableHandler table;
    bool         ok = true;
    for (const auto &variant : variants)
      for (const std::string &ratio : binder_ratios)
        {
          Options options;
          options.scene_file       = SIGNOTON_SOURCE_DIR "/" + scene;
          options.output_directory = "counts";
          std::filesystem::remove_all("counts");
          options.overrides = always;
          options.overrides.insert(options.overrides.end(),
                                   variant.begin(),
                                   variant.end());
          options.overrides.push_back("Output/Fields every=0");
          options.overrides.push_back("Materials/" + binder_key +
                                      "/Binder ratio=" + ratio);
          const bool completed =
            run_scene(MPI_COMM_WORLD, options) == ExitStatus::completed;
          double newton = 0., linear = 0., inside = 1., unknowns = 0.;
          for (const auto &line :
               PhysicalNumbers::read("counts/statistics.csv"))
            {
              const auto value = [&](const std::string &name) {
                return PhysicalNumbers::value(line, name);
              };
              newton =
                std::max(newton, value("most newton iterations of a solve"));
              linear   = std::max(linear, value("most linear iterations"));
              inside   = std::min(inside, value("share of interior"));
              unknowns = value("unknowns");
              // ends faster than linearly: order 1.5 and more, down to the
              // tenth of the tolerance that the linear solver is asked for
              ok &=
                value("residual") <=
                std::max(std::pow(value("residual one iteration before"), 1.5),
                         1e-11);
            }
          table.add_value("unknowns", static_cast<unsigned int>(unknowns));
          table.add_value("lambda", ratio);
          table.add_value("Newton", static_cast<unsigned int>(newton));
          table.add_value("linear", static_cast<unsigned int>(linear));
          table.add_value("off the interior", 1. - inside);
          table.set_precision("off the interior", 3);
          ok &= completed && newton <= 15. && linear <= 80.;
        }
    std::cout << "\n" << scene << ": most iterations of a solve\n";
    table.write_text(std::cout, TableHandler::org_mode_table);
    return ok;
  }
} // namespace NewtonCounts

#endif
