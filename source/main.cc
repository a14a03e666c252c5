#include <signoton/base/blas.h>
#include <signoton/base/first_rank.h>
#include <signoton/base/mpi_session.h>
#include <signoton/base/quoting.h>
#include <signoton/scene/scene.h>

#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>

namespace
{
  using namespace Signoton;

  const char *const help =
    R"(Signoton: statics and waves of materials that resist tension and
compression differently

  signoton SCENE.prm                 run a scene
  signoton point POINT.prm           drive one material point by strain or
                                     stress: table and diagram
  signoton --explain SCENE.prm       equations, effects on and off with their
                                     bytes, memory forecast; no run
  signoton --validate SCENE.prm      build everything, run nothing; the exit
                                     status says whether it would start
  signoton --template NAME           print a commented parameter file (statics,
                                     dynamics, point)
  signoton --resume DIRECTORY        go on from the checkpoint in an output
                                     directory, on any number of ranks; with
                                     --set, to a later end, for instance
  signoton --set 'Section/Key=value' override one entry; may be repeated.
                                     'Loads/Constants=a = 3' changes the
                                     constant a, and keeps the others
  signoton --output DIRECTORY        write results there
  signoton --trust-geometry          let .geo files execute programs and write
                                     files, which they cannot otherwise
  signoton --help, --version
  mpirun -np N signoton SCENE.prm    the same on N ranks

Names with a '#', '/', ':', ';', ',' or '=' in them are put in double quotes,
in files and here: --set 'Boundaries/"top / left"/Pressure=1'.

Exit status: 0 completed, 1 error of the program or too little memory, 2 bad
input, 3 no equilibrium found, 4 results could not be written, 7 ended by a
signal (SIGUSR1, SIGTERM, SIGINT) after a checkpoint, from which --resume goes
on.
)";

  /** What main() does for arguments that need no scene; false for others. */
  bool
  handle_information(const std::vector<std::string> &arguments,
                     const bool                      print)
  {
    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        std::string text;
        if (arguments[i] == "--help" || arguments[i] == "-h")
          text = help;
        else if (arguments[i] == "--version")
          text = "Signoton " SIGNOTON_VERSION
                 ", deal.II " DEAL_II_PACKAGE_VERSION ", " +
                 BLAS::name() + "\n";
        else if (arguments[i] == "--template")
          text =
            scene_template(i + 1 < arguments.size() ? arguments[i + 1] : "");
        else
          continue;
        if (print)
          std::cout << text << std::flush;
        return true;
      }
    return false;
  }

  Options
  parse(const std::vector<std::string> &arguments)
  {
    Options     options;
    std::string action, resume;
    const auto  refuse = [](const std::string &found,
                           const std::string &expected) {
      throw UserError("command line", found, expected, "'signoton --help'");
    };
    for (std::size_t i = 0; i < arguments.size(); ++i)
      {
        const std::string &word = arguments[i];
        const auto         next = [&]() -> std::string {
          if (i + 1 >= arguments.size())
            refuse("'" + word + "' at the end", "a value after it");
          return arguments[++i];
        };
        const auto once = [&](const std::string &before,
                              const std::string &value) {
          if (!before.empty())
            refuse("'" + word + "' besides '" + before + "'", "one of them");
          // it would break lists of files, and lines on the screen
          if (const auto found = control_character_in(value); !found.empty())
            refuse(found + " behind '" + word + "'", "text without");
          return value;
        };
        if (word == "point" && !options.point)
          options.point = true;
        else if (word == "--explain" || word == "--validate")
          action = once(action, word);
        else if (word == "--set")
          options.overrides.push_back(next());
        else if (word == "--trust-geometry")
          options.trust_geometry = true;
        else if (word == "--output")
          options.output_directory = once(options.output_directory, next());
        else if (word == "--resume")
          resume = once(resume, next());
        else if (word.rfind("-", 0) == 0)
          refuse("unknown option '" + word + "'",
                 "one of --explain, --validate, --template, --resume, --set, "
                 "--output, --trust-geometry, --help, --version");
        else
          options.scene_file = once(options.scene_file, word);
      }
    if (!resume.empty())
      {
        for (const std::string &other :
             {options.scene_file, options.output_directory, action})
          if (!other.empty())
            refuse("'" + other + "' besides '--resume " + resume + "'",
                   "the directory alone: the run goes on there, with the "
                   "scene that it has kept");
        options.scene_file       = resume + "/resolved.prm";
        options.output_directory = resume;
        options.resume_directory = resume + "/checkpoint";
      }
    if (options.scene_file.empty())
      refuse("no scene file", "signoton SCENE.prm");
    if (action == "--explain")
      options.action = Options::Action::explain;
    else if (action == "--validate")
      options.action = Options::Action::validate;
    return options;
  }

  /** What to tell of an error that is none of the user's. */
  std::string
  failure_text(const std::exception &error)
  {
    if (dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
        dynamic_cast<const std::length_error *>(&error) != nullptr ||
        dynamic_cast<const StandardExceptions::ExcOutOfMemory *>(&error) !=
          nullptr)
      return "Signoton is out of memory. '--explain' forecasts what a scene "
             "takes; a coarser mesh, 'Refinement / Maximum unknowns' or more "
             "machines help.\n";
    const auto *inner = dynamic_cast<const ExceptionBase *>(&error);
    if (inner == nullptr)
      return std::string("Signoton failed:\n  ") + error.what() + "\n";
    std::ostringstream text;
    text << "Signoton failed, by an error inside the program ("
         << inner->get_exc_name() << "):\n";
    inner->print_info(text);
    text << "Please report it with the scene.\n";
    return text.str();
  }

  /** Say what has gone wrong, once, and end all ranks; the status for the
   *  program. */
  int
  end_with(const MPI_Comm    &communicator,
           const std::string &message,
           const ExitStatus   status)
  {
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const bool         is_lone = !all_arrive(communicator);
    if (is_lone)
      std::cerr << "\nOn rank " << rank << " alone:" << std::flush;
    if (is_lone || rank == 0)
      std::cerr << '\n' << message << std::flush;
    if (is_lone)
      MPI_Abort(MPI_COMM_WORLD, static_cast<int>(status));
    return static_cast<int>(status);
  }

  ExitStatus
  run(const std::vector<std::string> &arguments)
  {
    if (handle_information(arguments,
                           Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) ==
                             0))
      return ExitStatus::completed;
    const Options options = parse(arguments);
    return options.point ? run_point(MPI_COMM_WORLD, options) :
                           run_scene(MPI_COMM_WORLD, options);
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  // the ranks meet here at the end, whatever they were about to say elsewhere
  MPI_Comm last_words;
  MPI_Comm_dup(MPI_COMM_WORLD, &last_words);
  try
    {
      return static_cast<int>(
        run(std::vector<std::string>(argv + 1, argv + argc)));
    }
  catch (const UserError &error)
    {
      return end_with(last_words,
                      std::string("Signoton cannot go on.\n") + error.what(),
                      error.status);
    }
  catch (const std::exception &error)
    {
      return end_with(last_words, failure_text(error), ExitStatus::failure);
    }
  catch (...)
    {
      return end_with(last_words,
                      "Signoton failed, it does not know why.\n",
                      ExitStatus::failure);
    }
}
