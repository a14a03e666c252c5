// Traps of floating-point exceptions end the program inside their scope, in an
// inner scope and after it as well, and nowhere else.

#include "verdicts.h"

#include <signoton/base/floating_point_traps.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

namespace
{
  volatile double zero = 0., huge = 1e200, sink;

  bool
  is_trapped(const std::function<void()> &action)
  {
    const pid_t child = fork();
    if (child == 0)
      {
        action();
        _exit(0);
      }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) && WTERMSIG(status) == SIGFPE;
  }
} // namespace

int
main()
{
  using Signoton::FloatingPointTraps;
  Verdicts verdict;
  verdict("no trap outside", !is_trapped([] { sink = 1. / zero; }));
  verdict("a division by zero", is_trapped([] {
            const FloatingPointTraps traps;
            sink = 1. / zero;
          }));
  verdict("an invalid operation", is_trapped([] {
            const FloatingPointTraps traps;
            sink = zero / zero;
          }));
  verdict("an overflow", is_trapped([] {
            const FloatingPointTraps traps;
            sink = huge * huge;
          }));
  verdict("after an inner scope", is_trapped([] {
            const FloatingPointTraps traps;
            {
              const FloatingPointTraps inner;
            }
            sink = 1. / zero;
          }));
  verdict("no trap behind the scope", !is_trapped([] {
            {
              const FloatingPointTraps traps;
            }
            sink = 1. / zero;
          }));
  verdict("no trap for what happened before", !is_trapped([] {
            sink = 1. / zero;
            const FloatingPointTraps traps;
            sink = 1. + huge;
          }));
  return verdict.status();
}
