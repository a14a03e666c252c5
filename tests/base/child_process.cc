// A job in a child process: whatever it does, this process gets its answer or
// a reason in words. Behind the filter it reads files, starts threads, and has
// no other effect.

#include "verdicts.h"

#include <signoton/base/child_process.h>
#include <signoton/base/sandbox.h>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace Signoton;
namespace fs = std::filesystem;

namespace
{
  Verdicts verdict;

  void
  expect_problem(const std::string                  &what,
                 const std::function<std::string()> &job,
                 const std::string                  &words,
                 const ChildLimits                  &limits = {})
  {
    const ChildResult result = run_in_child(job, limits);
    const bool        good =
      result.answer.empty() && result.problem.find(words) != std::string::npos;
    verdict(what + " is a problem '" + words + "'", good);
    if (!good)
      std::cerr << what << ": '" << result.problem << "'\n";
  }

  /** What an action in a child behind the filter comes to. */
  void
  expect_refusal(const std::string &what, const std::function<bool()> &action)
  {
    const ChildResult result = run_in_child(
      [&]() {
        const std::string why = forbid_side_effects();
        return !why.empty() ? why : action() ? "done" : "refused";
      },
      {});
    verdict(what + " is refused", result.answer == "refused");
    if (result.answer != "refused")
      std::cerr << what << ": " << result.answer << result.problem << "\n";
  }

  void
  try_endings()
  {
    const std::string long_answer(3000000, 'x');
    verdict("a long answer arrives",
            run_in_child([&]() { return long_answer; }, {}).answer ==
              long_answer);
    verdict("an empty answer is one",
            run_in_child([]() { return std::string(); }, {}).problem.empty());
    expect_problem(
      "an exception",
      []() -> std::string { throw std::runtime_error("no luck"); },
      "no luck");
    for (const int status : {0, 1})
      expect_problem(
        "exit(" + std::to_string(status) + ")",
        [status]() -> std::string { std::exit(status); },
        "it ended without a result");
    expect_problem(
      "abort()", []() -> std::string { std::abort(); }, "it crashed (Aborted)");
    expect_problem(
      "a crash",
      []() -> std::string {
        raise(SIGSEGV);
        return "";
      },
      "it crashed (Segmentation fault)");
    ChildLimits limits;
    limits.seconds = 0.3;
    expect_problem(
      "an endless loop",
      []() -> std::string {
        for (volatile unsigned int i = 0;; ++i)
          {}
      },
      "it took more than 0.3 s",
      limits);
    expect_problem(
      "endless sleep",
      []() -> std::string {
        while (true)
          pause();
      },
      "it took more than 0.3 s",
      limits);
    limits.bytes = 2e8;
    expect_problem(
      "too much memory",
      []() { return std::string(400000000, 'x'); },
      "it needs more than 0.2 GB",
      limits);
    std::cout << "not to be printed twice";
    expect_problem(
      "words on the screen, then exit()",
      []() -> std::string {
        std::cout << "not to be seen" << std::endl;
        std::exit(0);
      },
      "it ended");
    std::cout << std::endl;
  }

  void
  try_effects()
  {
    std::ofstream("kept") << "as it was";
    expect_refusal("a program", []() { return std::system("true") == 0; });
    expect_refusal("a process", []() { return fork() >= 0; });
    expect_refusal("another program in its place", []() {
      char *const none[] = {nullptr};
      return execve("/bin/true", none, none) == 0;
    });
    expect_refusal("a connection",
                   []() { return socket(AF_INET, SOCK_STREAM, 0) >= 0; });
    expect_refusal("a local connection",
                   []() { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; });
    expect_refusal("a signal", []() { return kill(getppid(), 0) == 0; });
    for (const int flags : {O_WRONLY | O_CREAT,
                            O_RDONLY | O_TRUNC,
                            O_RDONLY | O_CREAT,
                            O_RDWR,
                            O_WRONLY | O_APPEND})
      for (const char *file : {"kept", "new"})
        expect_refusal("opening '" + std::string(file) + "' with flags " +
                         std::to_string(flags),
                       [=]() { return open(file, flags, 0600) >= 0; });
    expect_refusal("a file of C++", []() {
      return static_cast<bool>(std::ofstream("new") << "text" << std::flush);
    });
    std::error_code error;
    expect_refusal("removal", [&]() { return fs::remove("kept", error); });
    expect_refusal("a new name", [&]() {
      fs::rename("kept", "new", error);
      return !error;
    });
    expect_refusal("a directory",
                   [&]() { return fs::create_directory("new", error); });
    expect_refusal("a link", []() { return symlink("kept", "new") == 0; });
    expect_refusal("another mode", []() { return chmod("kept", 0777) == 0; });
    expect_refusal("cutting it", []() { return truncate("kept", 0) == 0; });

    const ChildResult result = run_in_child(
      []() {
        forbid_side_effects();
        std::string text;
        std::thread reader(
          [&]() { std::getline(std::ifstream("kept") >> std::ws, text); });
        reader.join();
        return text;
      },
      {});
    verdict("a thread that reads a file is not", result.answer == "as it was");
    verdict("nothing has changed", !fs::exists("new"));
    verdict("this process can still do it all", std::system("true") == 0);
  }
} // namespace

int
main()
{
  for (const char *old : {"kept", "new"})
    fs::remove(old);
  try_endings();
  try_effects();
  return verdict.status();
}
