#include <signoton/base/signals.h>

namespace Signoton
{
  namespace
  {
    volatile std::sig_atomic_t last_signal = 0;

    void
    note(int signal)
    {
      last_signal = signal;
    }
  } // namespace

  SignalWatch::SignalWatch()
  {
    last_signal = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        struct sigaction action = {};
        action.sa_handler       = &note;
        action.sa_flags =
          SA_RESTART |
          (watched[i] == SIGINT ? static_cast<int>(SA_RESETHAND) : 0);
        sigaction(watched[i], nullptr, &before[i]);
        if (before[i].sa_handler != SIG_IGN)
          sigaction(watched[i], &action, nullptr);
      }
  }

  SignalWatch::~SignalWatch()
  {
    for (unsigned int i = 0; i < 3; ++i)
      sigaction(watched[i], &before[i], nullptr);
  }

  int
  SignalWatch::received()
  {
    return last_signal;
  }

  std::string
  SignalWatch::name(const int signal)
  {
    return signal == SIGUSR1 ? "SIGUSR1" :
           signal == SIGTERM ? "SIGTERM" :
           signal == SIGINT  ? "SIGINT" :
                               "signal " + std::to_string(signal);
  }
} // namespace Signoton
