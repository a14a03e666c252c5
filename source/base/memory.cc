#include <signoton/base/exceptions.h>
#include <signoton/base/memory.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Signoton
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** The number in a file, infinite if it has none. */
    double
    number_in(const fs::path &file)
    {
      double value = infinity;
      return std::ifstream(file) >> value ? value : infinity;
    }

    /** The number behind a word at the begin of a line, or zero. */
    double
    number_behind(const std::string &word, const fs::path &file)
    {
      std::ifstream stream(file);
      for (std::string line; std::getline(stream, line);)
        {
          std::istringstream parts(line);
          std::string        first;
          double             value = 0.;
          if (parts >> first >> value && first == word)
            return value;
        }
      return 0.;
    }

    /** How the two versions of control groups name things. */
    struct Version
    {
      std::string root, limit, usage, reclaimable;
    };

    /** Free in a group and in those around it. */
    double
    free_in_groups(const Version &version, const std::string &group)
    {
      double   least = infinity;
      fs::path path  = fs::path(version.root + group).lexically_normal();
      while (path.string().size() >= version.root.size())
        {
          // pages of files count as used, and are given back when needed
          const double free =
            number_in(path / version.limit) - number_in(path / version.usage) +
            number_behind(version.reclaimable, path / "memory.stat");
          if (free < least) // false for what is not a number
            least = std::max(free, 0.);
          if (path == path.parent_path())
            break;
          path = path.parent_path();
        }
      return least;
    }

    std::string
    gigabytes(const double bytes)
    {
      std::ostringstream text;
      text << std::setprecision(3) << bytes / 1e9 << " GB";
      return text.str();
    }
  } // namespace

  FreeMemory
  memory_of_process()
  {
    // in pages: all of the address space, and what is data in it
    std::array<double, 7> pages{};
    std::ifstream         stream("/proc/self/statm");
    for (double &value : pages)
      stream >> value;
    const double page = sysconf(_SC_PAGESIZE);
    FreeMemory   least{infinity, ""};
    const auto   look = [&](const auto limit, const double used) {
      rlimit found{};
      if (getrlimit(limit, &found) == 0 && found.rlim_cur != RLIM_INFINITY &&
          static_cast<double>(found.rlim_cur) - used < least.bytes)
        least = {std::max(static_cast<double>(found.rlim_cur) - used, 0.),
                 "the limit of the process (ulimit)"};
    };
    look(RLIMIT_AS, page * pages[0]);
    look(RLIMIT_DATA, page * pages[5]);
    return least;
  }

  FreeMemory
  memory_of_machine()
  {
    const double kilobytes = number_behind("MemAvailable:", "/proc/meminfo") +
                             number_behind("SwapFree:", "/proc/meminfo");
    FreeMemory least{kilobytes > 0. ? 1024. * kilobytes : infinity,
                     "the memory of the machine"};
    const Version first{"/sys/fs/cgroup/memory",
                        "memory.limit_in_bytes",
                        "memory.usage_in_bytes",
                        "total_inactive_file"},
      second{"/sys/fs/cgroup", "memory.max", "memory.current", "inactive_file"};
    std::ifstream stream("/proc/self/cgroup"); // number:controllers:group
    for (std::string line; std::getline(stream, line);)
      {
        const auto colon = line.find(':'), next = line.find(':', colon + 1);
        if (next == std::string::npos)
          continue;
        const std::string controllers =
          line.substr(colon + 1, next - colon - 1);
        if (!controllers.empty() && controllers != "memory")
          continue;
        const double free = free_in_groups(controllers.empty() ? second : first,
                                           line.substr(next + 1));
        if (free < least.bytes)
          least = {free, "the limit of the control group"};
      }
    return least;
  }

  void
  require_memory(const MPI_Comm    &communicator,
                 const double       bytes,
                 const std::string &where,
                 const std::string &what,
                 const std::string &try_this)
  {
    MPI_Comm machine;
    MPI_Comm_split_type(
      communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    const double on_machine = Utilities::MPI::sum(bytes, machine);
    MPI_Comm_free(&machine);
    std::string complaint;
    const auto  look = [&](const double needed, const FreeMemory &free) {
      if (complaint.empty() && needed > free.bytes)
        complaint = what + " takes about " + gigabytes(needed) + ", and " +
                    gigabytes(free.bytes) + " are free by " + free.limit;
    };
    look(bytes, memory_of_process());
    look(on_machine, memory_of_machine());
    for (const auto &found :
         Utilities::MPI::all_gather(communicator, complaint))
      if (!found.empty())
        throw UserError(
          where, found, "a scene that fits", try_this, ExitStatus::failure);
  }
} // namespace Signoton
