// Numbers that no run could use: each is answered with the key, the number and
// what is expected, before anything is computed; in time if it can be.

#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <filesystem>
#include <iostream>

using namespace Signoton;

namespace
{
  Verdicts verdict;

  /** Whether a scene, or a point, is answered with a status and with words. */
  void
  expect(const std::string              &scene,
         const std::vector<std::string> &overrides,
         const int                       status,
         const std::vector<std::string> &words,
         const bool                      runs = false)
  {
    Options options;
    options.point            = scene.find("point") != std::string::npos;
    options.scene_file       = SIGNOTON_SOURCE_DIR "/" + scene;
    options.overrides        = overrides;
    options.output_directory = "results";
    options.action    = runs ? Options::Action::run : Options::Action::validate;
    int         found = 0;
    std::string text  = "no complaint";
    try
      {
        found =
          static_cast<int>(options.point ? run_point(MPI_COMM_WORLD, options) :
                                           run_scene(MPI_COMM_WORLD, options));
      }
    catch (const UserError &error)
      {
        text  = error.what();
        found = static_cast<int>(error.status);
      }
    bool good = found == status;
    for (const auto &word : words)
      good = good && text.find(word) != std::string::npos;
    if (!good)
      std::cout << "status " << found << "\n" << text << std::endl;
    verdict(join(overrides, "; "), good);
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  std::filesystem::remove_all("results");

  const std::string statics = "tests/scenes/adaptive_plastic.prm",
                    waves   = "tests/scenes/loosened_pulse.prm",
                    slow    = "tests/scenes/implicit_dynamics.prm",
                    point   = "prm/point/triaxial.prm";

  const auto at = [](const std::string &section) {
    return [section](const std::string &key, const std::string &value) {
      return section + "/" + key + "=" + value;
    };
  };
  const auto load = at("Load steps"), time = at("Time integration"),
             output = at("Output"), program = at("Program");

  // as many steps as nobody waits for
  expect(waves,
         {time("Time step", "1e-300")},
         2,
         {"Time step", "steps of 1e-300 s"});
  expect(waves, {time("Time step", "1e-20")}, 2, {"Time step", "1e9 steps"});
  expect(waves, {time("End time", "1e12")}, 2, {"End time", "1e9 steps"});
  expect(waves, {time("End time", "1e300")}, 2, {"'1e300'"});
  expect(waves, {time("End time", "inf")}, 2, {"'inf'"});
  expect(waves, {time("End time", "nan")}, 2, {"'nan'"});
  expect(waves,
         {time("Start time", "1e20"), time("End time", "2e20")},
         2,
         {"End time", "1e9 steps"});
  expect(waves,
         {time("Start time", "1e15"), time("End time", "1000000000000001")},
         2,
         {"a clock"});
  expect(waves, {time("Snapshots", "-1")}, 2, {"'-1'", "0 <= n"});
  expect(waves, {time("Snapshots", "5000000")}, 2, {"'5000000'"});
  expect(waves, {time("Statistics every", "0")}, 2, {"'0'"});
  expect(waves, {time("Scheme", "Implicit")}, 2, {"did you mean 'implicit'?"});
  expect(waves, {"Analysis=Dynamics"}, 2, {"did you mean 'dynamics'?"});
  expect(slow, {time("Time step", "1e-300")}, 2, {"Time step", "1e9 steps"});
  expect(slow,
         {time("Maximum time step", "1e-300")},
         2,
         {"Maximum time step", "1e9 steps"});
  expect(slow, {time("Time step", "1e-8")}, 2, {"lines of statistics"});
  expect(statics, {load("Step size", "1e-300")}, 2, {"'1e-300'"});
  expect(statics, {load("Step size", "1e-25")}, 2, {"Step size", "1e9 steps"});
  expect(statics, {load("Step size", "1e-8")}, 2, {"lines of statistics"});
  expect(statics, {load("Step size", "-1")}, 2, {"'-1'"});
  expect(statics, {load("Easy iterations", "-1")}, 2, {"'-1'"});
  expect(statics,
         {load("Start time", "1e20"), load("End time", "1.1e20")},
         2,
         {"Step size", "1e9 steps"});
  expect(statics, {output("Fields every", "-5")}, 2, {"'-5'"});
  expect(statics, {output("Checkpoint every", "-1")}, 2, {"'-1'"});
  expect(statics,
         {output("Checkpoint every", "4294967296")},
         2,
         {"'4294967296'"});
  expect(statics, {"Linear solver/Direct below in 2D=-1"}, 2, {"'-1'"});
  expect(statics, {"Refinement/Cycles per step=-1"}, 2, {"'-1'"});

  // points by the thousand million, meshes beyond all memory
  expect(waves,
         {output("Probe lines", "0, 0.1 : 1, 0.1 : 2000000000")},
         2,
         {"Probe lines", "2e+09 points"});
  expect(waves,
         {output("Probe lines", "0, 0.1 : 1, 0.1 : 2e9")},
         2,
         {"Probe lines"});
  expect(waves,
         {output("Probe lines", "0, 0.1 : 1, 0.1 : 100000"),
          output("Probe line samples", "100000")},
         2,
         {"Probe line samples", "1e8 rows"});
  expect(statics, {output("Probe points", "inf, 0, 0")}, 2, {"'inf, 0, 0'"});
  expect(statics, {output("Probe points", "1e400, 0, 0")}, 2, {"Probe points"});
  expect(statics,
         {"Geometry/Initial refinement=12"},
         1,
         {"Initial refinement", "are free by"});

  // constants of materials
  for (const char *value : {"1e52", "1e-52", "1e300", "1e-300"})
    {
      expect(point,
             {"Materials/sand/Bulk modulus=" + std::string(value)},
             2,
             {"Bulk modulus", std::string("'") + value + "'", "1e30"});
      expect(point,
             {"Schemes/mine=spring(bulk = " + std::string(value) +
              ", shear = 1)"},
             2,
             {value, "1e40"});
    }
  expect(point,
         {"Time steps/Largest step=1e-300"},
         2,
         {"Largest step", "1e7 steps"});
  expect(point, {program("End time", "1e300")}, 2, {"'1e300'"});
  expect(point, {program("End time", "-1")}, 2, {"End time", "-1"});
  expect(point, {program("Confining pressure", "1e300")}, 2, {"'1e300'"});

  // loads without a value at some time, in the course of a run
  for (const std::string &scene : {waves, slow})
    {
      expect(scene,
             {"Boundaries/plate/Pressure=sqrt(1e-5 - t)"},
             2,
             {"Boundaries / plate / Pressure", "nan at t = "},
             true);
      expect(scene,
             {"Loads/Gravity=1/(t-t); 0"},
             2,
             {"Loads / Gravity", " at t = "},
             true);
      expect(scene,
             {"Initial state/Strain=sqrt(0.5 - x); 0; 0; 0"},
             2,
             {"Initial state / Strain", "nan at t = "});
      expect(scene,
             {"Initial state/Velocity=1/(x - x); 0"},
             2,
             {"Initial state / Velocity", "not finite"},
             true);
    }
  return verdict.status();
}
