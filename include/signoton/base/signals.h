#ifndef signoton_base_signals_h
#define signoton_base_signals_h

#include <signoton/base/exceptions.h>

#include <csignal>
#include <string>

namespace Signoton
{
  /** Exit status of a run that a signal has ended, after a checkpoint. */
  constexpr ExitStatus interrupted = static_cast<ExitStatus>(7);

  /**
   * Keeps SIGUSR1, SIGTERM and SIGINT from ending the program while an object
   * of this class lives: they are noted, for the run to end at the next step.
   * A second SIGINT ends it at once. A signal that the caller of the program
   * has chosen to ignore stays ignored.
   */
  class SignalWatch
  {
  public:
    SignalWatch();
    ~SignalWatch();
    SignalWatch(const SignalWatch &) = delete;

    /** The last signal to this process, zero without one. */
    static int
    received();

    /** `SIGUSR1` and so on. */
    static std::string
    name(const int signal);

  private:
    static constexpr int watched[3] = {SIGUSR1, SIGTERM, SIGINT};

    struct sigaction before[3];
  };
} // namespace Signoton

#endif
