// Output that cannot be written and checkpoints that do not fit: each has its
// own message and status, and what was written before stays.

#include <signoton/base/mpi_session.h>
#include <signoton/scene/scene.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

using namespace Signoton;
namespace fs = std::filesystem;

namespace
{
  std::ofstream output;

  void
  run(const std::string &what, const Options &options)
  {
    output << what << "\n";
    try
      {
        const ExitStatus status = run_scene(MPI_COMM_WORLD, options);
        output << "status " << static_cast<int>(status) << "\n";
      }
    catch (const UserError &error)
      {
        output << error.what() << "status " << static_cast<int>(error.status)
               << "\n";
      }
  }

  std::string
  contents(const std::string &file_name)
  {
    std::ostringstream text;
    text << std::ifstream(file_name).rdbuf();
    return text.str();
  }

  void
  count_lines(const std::string &file_name)
  {
    std::ifstream statistics(file_name);
    unsigned int  n_lines = 0;
    for (std::string line; std::getline(statistics, line);)
      ++n_lines;
    output << "lines of statistics that stay: " << n_lines << "\n";
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  output.open("output");
  for (const char *old :
       {"results", "good", "no_room", "file", "damaged", "full"})
    fs::remove_all(old);

  Options options;
  options.scene_file = SIGNOTON_SOURCE_DIR "/tests/scenes/adaptive_plastic.prm";
  options.overrides  = {"Load steps/End time=0.5",
                        "Linear solver/Method=direct"};

  std::ofstream("file") << "not a directory\n";
  options.output_directory = "file/results";
  run("the output directory cannot be made", options);

  // no file may become larger than it takes for all but fields
  rlimit unlimited;
  getrlimit(RLIMIT_FSIZE, &unlimited);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{9000, unlimited.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  options.output_directory = "results";
  options.overrides.emplace_back("Output/Fields every=1");
  run("the disk is full when fields are written", options);
  setrlimit(RLIMIT_FSIZE, &unlimited);
  count_lines("results/statistics.csv");

  options.output_directory = "good";
  options.overrides = {"Load steps/End time=0.5", "Output/Checkpoint every=1"};
  run("a run with a checkpoint", options);

  // no file may become larger than it takes for all but the checkpoint
  const rlimit limited{100000, unlimited.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limited);
  options.overrides        = {"Load steps/Step size=0.5",
                              "Output/Checkpoint every=2",
                              "Output/Fields every=0"};
  options.output_directory = "no_room";
  run("the disk is full when a checkpoint is written", options);
  setrlimit(RLIMIT_FSIZE, &unlimited);
  count_lines("no_room/statistics.csv");

  options.output_directory = "good";
  options.scene_file       = "good/resolved.prm";
  options.resume_directory = "good/checkpoint";
  options.overrides        = {"Discretization/Degree=2"};
  run("a checkpoint of another degree", options);

  options.overrides        = {};
  options.resume_directory = "nowhere/checkpoint";
  run("a checkpoint that is not there", options);

  // another body, in each of the ways that a checkpoint knows
  options.resume_directory = "good/checkpoint";
  for (const char *override :
       {"Geometry/Arguments=2, 2, 3 : 0, 0, 0 : 1, 1, 1 : true",
        "Geometry/Arguments=2, 2, 2 : 0, 0, 0 : 1, 1, 1.5 : true",
        "Geometry/Distortion=1e-4",
        "Geometry/Boundary names=plate: z > 0.999 && x < 0.5",
        "Geometry/Material ids=7: x < 0.5",
        "Geometry/Periodic boundaries=left: right"})
    {
      options.overrides = {override,
                           "Load steps/End time=2",
                           "Boundaries/left/Symmetry=false"};
      if (std::string(override).find("ids") != std::string::npos)
        for (const char *entry : {"Material id=7",
                                  "Rheology=elastic",
                                  "Bulk modulus=1",
                                  "Shear modulus=0.6"})
          options.overrides.push_back(std::string("Materials/other/") + entry);
      run(std::string("a checkpoint of another body: ") + override, options);
    }

  // every file in turn, cut short and gone
  options.resume_directory = "damaged";
  for (const char *name : {"numbers", "mesh", "mesh.info", "mesh_fixed.data"})
    for (const bool gone : {false, true})
      {
        fs::remove_all("damaged");
        fs::copy("good/checkpoint", "damaged");
        const std::string file = std::string("damaged/") + name;
        if (gone)
          fs::remove(file);
        else
          fs::resize_file(file, fs::file_size(file) / 2);
        run(std::string("a checkpoint with file ") + name +
              (gone ? " gone" : " cut short"),
            options);
      }

  // what is there must not be cut before there is room for the new
  fs::copy("good", "full", fs::copy_options::recursive);
  options.scene_file        = "full/resolved.prm";
  options.output_directory  = "full";
  options.resume_directory  = "full/checkpoint";
  options.overrides         = {"Load steps/End time=2"};
  const std::string files[] = {"statistics.csv", "resolved.prm"};
  for (const rlim_t bytes : {150, 1000})
    {
      const rlimit none{bytes, unlimited.rlim_max};
      setrlimit(RLIMIT_FSIZE, &none);
      run("a run that goes on where nothing can be written", options);
      setrlimit(RLIMIT_FSIZE, &unlimited);
      for (const std::string &file : files)
        output << file << " is "
               << (contents("full/" + file) == contents("good/" + file) ?
                     "as it was" :
                     "LOST")
               << "\n";
    }

  // a new run leaves nothing of the old one that could be resumed
  options                  = Options();
  options.scene_file       = "good/resolved.prm";
  options.output_directory = "good";
  options.overrides        = {"Output/Checkpoint every=0"};
  run("a new run into the same directory", options);
  options.resume_directory = "good/checkpoint";
  run("resuming it without a checkpoint", options);
  return 0;
}
