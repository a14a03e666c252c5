#ifndef signoton_base_child_process_h
#define signoton_base_child_process_h

#include <functional>
#include <string>

namespace Signoton
{
  /** What a child process may use. */
  struct ChildLimits
  {
    double seconds = 60.; ///< of the clock on the wall
    double bytes   = 4e9; ///< of memory, beside what this process has
  };

  /** What a child process leaves. */
  struct ChildResult
  {
    std::string answer;  ///< what its job returned
    std::string problem; ///< why there is no answer, in words, or empty
  };

  /**
   * Do a job in a process of its own, so that a library which exits, crashes,
   * never ends or takes all memory ends nothing but that process.
   *
   * The process is a copy of this one (fork) and executes no program: the job is
   * then any function of whatever program the library is linked to, and nothing
   * must be found, installed or told. It never touches MPI, which does not
   * survive a fork: it closes all files and connections of its parent, takes
   * back its handlers of signals, has no input and output, and ends without the
   * exit handlers of libraries. Its answer comes through a pipe. It dies with
   * its parent; what it may have started dies with it.
   */
  ChildResult
  run_in_child(const std::function<std::string()> &job,
               const ChildLimits                  &limits);
} // namespace Signoton

#endif
