#ifndef signoton_tests_scene_fuzz_h
#define signoton_tests_scene_fuzz_h

#include "verdicts.h"

#include <signoton/scene/scene.h>

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <sstream>

/** Scenes of the repository, mutated at random but always alike: each is refused
 * by a message with its four parts, or valid. Nothing else comes through, be it
 * a signal, an exception, a trace or an endless loop. */
namespace SceneFuzz
{
  using namespace Signoton;
  namespace fs = std::filesystem;

  std::mt19937 engine(20260);

  /** Below @p n; the same on all machines, unlike the distributions. */
  std::size_t
  below(const std::size_t n)
  {
    return n > 0 ? engine() % n : 0;
  }

  template <std::size_t n>
  std::string
  any(const std::array<const char *, n> &list)
  {
    return list[below(n)];
  }

  std::string
  contents(const fs::path &path)
  {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  /** The begin and the length of a random piece of some characters. */
  std::pair<std::size_t, std::size_t>
  piece(const std::string &text, const std::string &of)
  {
    std::size_t begin = text.find_first_of(of, below(text.size()));
    if (begin == std::string::npos)
      begin = text.find_first_of(of);
    if (begin == std::string::npos)
      return {0, 0};
    const std::size_t end = text.find_first_not_of(of, begin);
    return {begin, std::min(end, text.size()) - begin};
  }

  std::vector<std::string>
  lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       stream(text);
    for (std::string line; std::getline(stream, line);)
      lines.push_back(line);
    return lines;
  }

  void
  mutate_lines(std::string &text)
  {
    auto lines = lines_of(text);
    if (lines.empty())
      return;
    const std::size_t i = below(lines.size()), j = below(lines.size());
    switch (below(4))
      {
        case 0:
          lines.erase(lines.begin() + i);
          break;
        case 1:
          lines.insert(lines.begin() + i, lines[j]);
          break;
        case 2:
          std::swap(lines[i], lines[j]);
          break;
        default: // the value of another line
          if (const auto a = lines[i].find('='), b = lines[j].find('=');
              a != std::string::npos && b != std::string::npos)
            lines[i] = lines[i].substr(0, a) + lines[j].substr(b);
      }
    text = join(lines, "\n") + "\n";
  }

  void
  mutate(std::string &text)
  {
    constexpr std::array<const char *, 18> numbers{{"-1",
                                                    "0",
                                                    "1e300",
                                                    "1e-300",
                                                    "inf",
                                                    "nan",
                                                    "1e12",
                                                    "-5.5",
                                                    "4294967296",
                                                    "2147483648",
                                                    "",
                                                    "1,5",
                                                    "0x10",
                                                    "1e",
                                                    "1e52",
                                                    "12",
                                                    ".5",
                                                    "1/0"}};
    constexpr std::array<const char *, 20> marks{
      {"\"", "#", ":",  ";",          ",",        "\\",   "=",
       "{",  "(", ")",  "_",          "\xc3\xa9", "\xe9", "\t",
       "/",  "'", "%s", "$(touch x)", "\x1b",     "\n"}};
    const std::string digits  = "0123456789.e-",
                      letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQR"
                                "STUVWXYZ";
    switch (below(8))
      {
        case 0:
        case 1:
          if (const auto [at, n] = piece(text, digits); n > 0)
            text.replace(at, n, any(numbers));
          break;
        case 2:
          {
            const std::size_t at = below(text.size() + 1);
            text.insert(at, any(marks));
          }
          break;
        case 3: // a word in another case, or another word
          if (const auto [at, n] = piece(text, letters); n > 0)
            text[at] = static_cast<char>(text[at] ^ 0x20);
          break;
        case 4:
          {
            const auto [at, n]     = piece(text, letters);
            const auto [from, n_2] = piece(text, letters);
            const std::string word = text.substr(from, n_2);
            text.replace(at, n, word);
          }
          break;
        case 5:
          if (!text.empty())
            text[below(text.size())] = static_cast<char>(below(256));
          break;
        case 6:
          if (below(4) == 0)
            text.resize(below(text.size() + 1));
          break;
        default:
          mutate_lines(text);
      }
  }

  /** What is wrong with a complaint; empty if nothing is. */
  std::string
  fault_in(const std::string &message)
  {
    for (const char *part : {"where:    ", "found:    ", "expected: ", "try: "})
      if (message.find(part) == std::string::npos)
        return std::string("no ") + part;
    for (const char *word : {"dealii", "Exc", "0.000000", "std::"})
      if (message.find(word) != std::string::npos)
        return std::string("says ") + word;
    return "";
  }

  std::string current;

  void
  late(int)
  {
    std::cerr << "endless: " << current << std::endl;
    _exit(1);
  }

  /** What goes wrong with a scene; empty if it is valid or refused. */
  std::string
  fault_of(const Options &options)
  {
    std::string fault;
    alarm(60);
    try
      {
        if (options.point)
          run_point(MPI_COMM_WORLD, options);
        else
          run_scene(MPI_COMM_WORLD, options);
      }
    catch (const UserError &error)
      {
        fault = fault_in(error.what());
        if (!fault.empty())
          fault += std::string("\n") + error.what();
      }
    catch (const std::exception &error)
      {
        fault = error.what();
      }
    alarm(0);
    return fault;
  }

  /** Scenes that are read and built in a moment. */
  std::vector<fs::path>
  seeds()
  {
    const fs::path        root = SIGNOTON_SOURCE_DIR;
    std::vector<fs::path> all;
    for (const char *folder :
         {"prm", "prm/point", "tests/scenes", "tests/input"})
      for (const auto &entry : fs::directory_iterator(root / folder))
        if (entry.path().extension() == ".prm" &&
            entry.path().stem() != "pulse_octant_3d" &&
            contents(entry.path()).find("Mesh file") == std::string::npos)
          all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
  }

  /** What main() returns. */
  int
  run(const unsigned int n_mutations)
  {
    Verdicts verdict;

    // a mesh that is refined without end has to be refused soon
    const rlimit limit{4UL << 30, 4UL << 30};
    setrlimit(RLIMIT_AS, &limit);
    std::signal(SIGALRM, late);
    std::ostringstream screen;
    auto *const        terminal = std::cout.rdbuf(screen.rdbuf());

    const auto   scenes   = seeds();
    unsigned int n_faults = 0;
    for (unsigned int i = 0; i < n_mutations; ++i)
      {
        const fs::path seed = scenes[below(scenes.size())];
        std::string    text = contents(seed);
        for (std::size_t n = 1 + below(3); n > 0; --n)
          mutate(text);
        Options options;
        options.point      = seed.parent_path().filename() == "point";
        options.action     = Options::Action::validate;
        options.scene_file = "mutated.prm";
        std::ofstream(options.scene_file, std::ios::binary) << text;
        current = "mutation " + std::to_string(i) + " of " + seed.string();
        screen.str("");
        if (const std::string fault = fault_of(options); !fault.empty())
          {
            ++n_faults;
            fs::rename("mutated.prm", "fault_" + std::to_string(i) + ".prm");
            std::cerr << current << ": " << fault << std::endl;
          }
      }
    std::cout.rdbuf(terminal);
    verdict("every mutation is valid or refused in words", n_faults == 0);
    verdict("no command was run", !fs::exists("x"));
    return verdict.status();
  }
} // namespace SceneFuzz

#endif
