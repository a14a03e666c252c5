#include <signoton/base/child_process.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <vector>

namespace Signoton
{
  namespace
  {
    /** How a child ended: the last byte that it sends. */
    enum class Ending : char
    {
      done          = 'd',
      left_early    = 'l', ///< somebody called exit()
      out_of_memory = 'm',
      failed        = 'f' ///< an exception; the answer is its text
    };

    int pipe_to_parent = -1;

    void
    send(const std::string &text)
    {
      for (std::size_t sent = 0; sent < text.size();)
        {
          const auto n =
            write(pipe_to_parent, text.data() + sent, text.size() - sent);
          if (n < 0 && errno != EINTR)
            _exit(1);
          sent += std::max<ssize_t>(n, 0);
        }
    }

    [[noreturn]] void
    end(const std::string &text, const Ending ending)
    {
      send(text);
      send(std::string(1, static_cast<char>(ending)));
      _exit(0);
    }

    void
    leave_early()
    {
      end("", Ending::left_early);
    }

    /** Nothing of the parent is left open but the pipe; input and output lead
     *  nowhere. */
    void
    close_files()
    {
      std::vector<int> open_files;
      std::error_code  error;
      for (const auto &entry :
           std::filesystem::directory_iterator("/proc/self/fd", error))
        open_files.push_back(std::atoi(entry.path().filename().c_str()));
      for (const int file : open_files)
        if (file > 2 && file != pipe_to_parent)
          close(file);
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int file : {0, 1, 2})
        dup2(nowhere, file);
      if (nowhere > 2)
        close(nowhere);
    }

    void
    limit(const int resource, const double value)
    {
      rlimit now;
      getrlimit(static_cast<__rlimit_resource_t>(resource), &now);
      const auto wanted = static_cast<rlim_t>(std::min(value, 1e18));
      now.rlim_max      = std::min(now.rlim_max, wanted);
      now.rlim_cur      = now.rlim_max;
      setrlimit(static_cast<__rlimit_resource_t>(resource), &now);
    }

    /** Bytes of address space in use. */
    double
    address_space()
    {
      double pages = 0.;
      std::ifstream("/proc/self/statm") >> pages;
      return pages * sysconf(_SC_PAGESIZE);
    }

    [[noreturn]] void
    be_child(const std::function<std::string()> &job,
             const ChildLimits                  &limits,
             const pid_t                         parent)
    {
      setpgid(0, 0);
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent)
        _exit(1);
      for (int number = 1; number < NSIG; ++number)
        std::signal(number, SIG_DFL);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      close_files();
      // before all handlers that the parent has registered
      std::atexit(leave_early);
      limit(RLIMIT_CPU, std::ceil(limits.seconds) + 1.);
      limit(RLIMIT_AS, address_space() + limits.bytes);
      limit(RLIMIT_CORE, 0.);
      // libraries may catch std::bad_alloc and throw what says less
      std::set_new_handler([] { end("", Ending::out_of_memory); });
      try
        {
          end(job(), Ending::done);
        }
      catch (const std::bad_alloc &)
        {
          end("", Ending::out_of_memory);
        }
      catch (const std::exception &error)
        {
          end(error.what(), Ending::failed);
        }
      catch (...)
        {
          end("an unknown exception", Ending::failed);
        }
    }

    /** All that the child sends before its time is over. */
    bool
    receive(const int file, const double seconds, std::string &text)
    {
      using Clock      = std::chrono::steady_clock;
      const auto start = Clock::now();
      const auto left  = [&]() {
        return seconds -
               std::chrono::duration<double>(Clock::now() - start).count();
      };
      std::array<char, 65536> buffer;
      while (left() > 0.)
        {
          pollfd    wait{file, POLLIN, 0};
          const int ready = poll(&wait, 1, std::min(left() * 1e3 + 1., 1e6));
          if (ready <= 0)
            continue;
          const auto n = read(file, buffer.data(), buffer.size());
          if (n == 0)
            return true;
          if (n > 0)
            text.append(buffer.data(), n);
        }
      return false;
    }

    std::string
    in_units(const double value, const std::string &unit)
    {
      std::ostringstream text;
      text << value << ' ' << unit;
      return text.str();
    }

    /** The answer or the problem, from what was sent and how the child died. */
    ChildResult
    interpret(std::string sent, const int status, const ChildLimits &limits)
    {
      const std::string memory = in_units(limits.bytes / 1e9, "GB");
      if (sent.empty())
        {
          const int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
          if (number == SIGXCPU)
            return {"",
                    "it took more than " + in_units(limits.seconds, "s") +
                      " of time"};
          return {"",
                  "it crashed" +
                    (number > 0 ? std::string(" (") + strsignal(number) + ")" :
                                  "") +
                    ", or needs more than " + memory + " of memory"};
        }
      const auto ending = static_cast<Ending>(sent.back());
      sent.pop_back();
      switch (ending)
        {
          case Ending::done:
            return {sent, ""};
          case Ending::left_early:
            return {"", "it ended without a result"};
          case Ending::out_of_memory:
            return {"", "it needs more than " + memory + " of memory"};
          case Ending::failed:
            return {"", sent};
        }
      return {"", "it crashed while it sent its result"};
    }
  } // namespace

  ChildResult
  run_in_child(const std::function<std::string()> &job,
               const ChildLimits                  &limits)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      return {"", std::string("no pipe to a process: ") + std::strerror(errno)};
    const pid_t parent = getpid();
    const pid_t child  = fork();
    if (child == 0)
      {
        pipe_to_parent = ends[1];
        be_child(job, limits, parent);
      }
    close(ends[1]);
    if (child < 0)
      {
        close(ends[0]);
        return {"", std::string("no new process: ") + std::strerror(errno)};
      }
    setpgid(child, child); // whoever is first
    std::string sent;
    const bool  in_time = receive(ends[0], limits.seconds, sent);
    close(ends[0]);
    kill(-child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      {}
    if (!in_time)
      return {"",
              "it took more than " + in_units(limits.seconds, "s") +
                " of time"};
    return interpret(std::move(sent), status, limits);
  }
} // namespace Signoton
