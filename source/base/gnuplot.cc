#include <signoton/base/gnuplot.h>

#include <sys/wait.h>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>

namespace Signoton
{
  std::string
  gnuplot_string(const std::string &text)
  {
    // what is no letter, digit or part of one beyond ASCII goes as its number
    // in octal: neither quotes nor backquotes, which execute, can end it
    std::string result = "\"";
    for (const char c : text)
      {
        const auto code = static_cast<unsigned char>(c);
        if (std::isalnum(code) != 0 || code >= 0x80 || c == ' ')
          result += c;
        else if (code < 0x20)
          result += ' ';
        else
          result += {'\\',
                     static_cast<char>('0' + code / 64),
                     static_cast<char>('0' + code / 8 % 8),
                     static_cast<char>('0' + code % 8)};
      }
    return result + "\"";
  }

  bool
  run_gnuplot(const std::string &directory, const std::string &script)
  {
    // not the settings of the user, which might ask for a window
    std::string name = "gnuplot", option = "--default-settings", file = script;
    const std::array<char *, 4> arguments{
      {name.data(), option.data(), file.data(), nullptr}};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, directory.c_str());
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    pid_t      child = 0;
    const bool runs =
      posix_spawnp(
        &child, "gnuplot", &actions, nullptr, arguments.data(), environ) == 0;
    posix_spawn_file_actions_destroy(&actions);
    int status = 0;
    if (runs)
      while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
          return false;
    return runs && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
} // namespace Signoton
