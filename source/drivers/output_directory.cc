#include <signoton/base/exceptions.h>
#include <signoton/drivers/output_directory.h>

#include <boost/serialization/string.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <regex>
#include <thread>

namespace Signoton
{
  namespace
  {
    namespace fs = std::filesystem;

    const char *const list_name = "signoton.files";

    /** Lists are edited, copied and sent: nothing is removed that no run
     *  writes, and nothing outside of the directory. */
    bool
    may_be_ours(const std::string &name)
    {
      static const std::regex names(
        "(resolved\\.prm|statistics\\.csv|ledger\\.json|fields\\.pvd|"
        "fields-[0-9]+(\\.[0-9]+)?\\.p?vtu|line-[0-9]+\\.(csv|gp|png)|"
        "point\\.(csv|gp|svg)|checkpoint(\\.(old|unfinished))?"
        "(/(numbers|room|mesh(\\.info|_[a-z]+\\.data)?))?)(\\.part)?");
      return std::regex_match(name, names);
    }

    std::vector<std::string>
    read_list(const std::string &directory)
    {
      std::vector<std::string> names;
      std::ifstream            file(directory + "/" + list_name);
      for (std::string line; std::getline(file, line);)
        if (may_be_ours(line))
          names.push_back(line);
      return names;
    }

    /** The last line of the list about a run. */
    std::string
    holder(const std::string &directory)
    {
      std::string   found = "another process";
      std::ifstream file(directory + "/" + list_name);
      for (std::string line; std::getline(file, line);)
        if (line.rfind("# ", 0) == 0)
          found = line.substr(2);
      return found;
    }

    std::string
    this_run()
    {
      char host[256] = "";
      gethostname(host, sizeof(host) - 1);
      const std::time_t now      = std::time(nullptr);
      char              date[64] = "";
      std::strftime(date,
                    sizeof(date),
                    "%Y-%m-%d %H:%M:%S UTC",
                    std::gmtime(&now));
      return "process " + std::to_string(getpid()) + " on " + host + " since " +
             date;
    }
  } // namespace

  OutputDirectory::OutputDirectory(const MPI_Comm    &communicator,
                                   const std::string &path)
    : path(path)
    , communicator(communicator)
  {}

  OutputDirectory::~OutputDirectory()
  {
    if (list >= 0)
      close(list);
  }

  template <typename Action>
  void
  OutputDirectory::decide(const Action      &action,
                          const std::string &expected,
                          const std::string &try_this) const
  {
    std::string problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      problem = action();
    problem = Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw UserError("output directory '" + path + "'",
                      problem,
                      expected,
                      try_this,
                      ExitStatus::output_failed);
  }

  std::string
  OutputDirectory::note(const std::string &text)
  {
    const off_t before = lseek(list, 0, SEEK_END);
    if (write(list, text.data(), text.size()) ==
        static_cast<ssize_t>(text.size()))
      return "";
    // half a name would spoil the next one
    const bool cut = ftruncate(list, before) == 0;
    return std::string("its list of files cannot be written") +
           (cut ? ", the disk is full or protected" : "");
  }

  std::string
  OutputDirectory::acquire()
  {
    const std::string unwritable = "it cannot be created or written to";
    std::error_code   error;
    fs::create_directories(path, error);
    list = open((path + "/" + list_name).c_str(),
                O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC,
                0666);
    if (list < 0)
      return unwritable;
    if (std::ifstream old(path + "/" + list_name);
        old.peek() != '#' && old.peek() != EOF)
      return std::string("a file '") + list_name + "' that no run has written";
    // a run that has just been killed may take a moment to be gone
    bool locked = false;
    for (unsigned int i = 0; i < 40; ++i)
      {
        // some file systems have no locks: then there is none
        locked = flock(list, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        if (locked)
          break;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    if (!locked)
      {
        close(list);
        list = -1;
        return "another run is writing there: " + holder(path);
      }
    return note("# " + this_run() + "\n").empty() ? "" : unwritable;
  }

  void
  OutputDirectory::lock()
  {
    const bool is_locked =
      Utilities::MPI::max(list >= 0 ? 1U : 0U, communicator) > 0;
    if (!is_locked)
      decide([&] { return acquire(); },
             "a directory with permission to write, for one run at a time",
             "set 'Output / Directory', or --output DIRECTORY");
  }

  std::string
  OutputDirectory::foreign_file(const std::string &names) const
  {
    std::set<std::string> ours;
    for (const std::string &name : read_list(path))
      ours.insert(name);
    const std::regex pattern("(" + names + ")(\\.part)?");
    const auto       is_ours = [&](const std::string &name) {
      return ours.count(name) > 0 || // or what was to become one of them
             (fs::path(name).extension() == ".part" &&
              ours.count(fs::path(name).stem().string()) > 0);
    };
    std::error_code error;
    std::string     first;
    for (const auto &entry : fs::directory_iterator(path, error))
      {
        const std::string name = entry.path().filename().string();
        if (std::regex_match(name, pattern) && !is_ours(name) &&
            (first.empty() || name < first))
          first = name;
      }
    return first;
  }

  std::string
  OutputDirectory::remove_earlier()
  {
    std::error_code error;
    const auto      names = read_list(path);
    // directories come before what is in them; one with more is kept
    for (auto name = names.rbegin(); name != names.rend(); ++name)
      for (const char *ending : {"", ".part"})
        fs::remove(path + "/" + *name + ending, error);
    if (ftruncate(list, 0) != 0)
      return "its list of files cannot be written";
    return note("# Files that runs wrote here; the next run removes them.\n# " +
                this_run() + "\n");
  }

  void
  OutputDirectory::begin(const std::string &names)
  {
    lock();
    decide(
      [&] {
        const std::string foreign = foreign_file(names);
        return foreign.empty() ? "" :
                                 "'" + foreign +
                                   "', which is not in its list of files "
                                   "(signoton.files)";
      },
      "a directory without files of others that results would overwrite",
      "move the file (if it is a result of a version without the list, remove "
      "it), or choose another directory by --output");
    decide([&] { return remove_earlier(); },
           "space and permission to write",
           "free space, or choose another directory by --output");
  }

  std::string
  OutputDirectory::path_of(const std::string &name)
  {
    enter({name});
    return path + "/" + name;
  }

  void
  OutputDirectory::enter(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      if (entered.insert(name).second)
        text += name + "\n";
    if (!text.empty())
      decide([&] { return note(text); },
             "space and permission to write",
             "free space or choose another directory; what was written before "
             "is complete");
  }
} // namespace Signoton
