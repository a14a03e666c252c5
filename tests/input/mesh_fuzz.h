#ifndef signoton_tests_mesh_fuzz_h
#define signoton_tests_mesh_fuzz_h

#include "verdicts.h"

#include <signoton/discretization/mesh_reader.h>

#include <unistd.h>

#include <iostream>
#include <random>
#include <sstream>

/** Mesh files that were damaged at random: each is read as a sound mesh, or
 *  refused in words; none crashes, and none takes long. */
namespace MeshFuzz
{
  using namespace Signoton;

  /** Two cells side by side, 2D and of version 2. */
  inline const std::string flat = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 2 "left_side"
1 3 "the rest; of it"
2 1 "body"
$EndPhysicalNames
$Nodes
6
1 0 0 0
2 1 0 0
3 2 0 0
4 0 1 0
5 1 1.5 0
6 2 1 0
$EndNodes
$Elements
8
1 15 2 7 1 1
2 1 2 2 4 1 4
3 1 2 3 5 1 2
4 1 2 3 5 2 3
5 1 2 3 6 3 6
6 3 2 1 9 1 2 5 4
7 3 2 4 9 5 2 3 6
8 1 2 3 7 6 5
$EndElements
)";

  /** Two cells side by side, 3D and of version 4.1. */
  inline const std::string solid = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 2 "bottom_1"
3 1 "body"
$EndPhysicalNames
$Entities
1 0 2 1
5 0 0 0 0
3 0 0 0 2 1 0 1 2 0
4 0 0 1 2 1 1 0 0
1 0 0 0 2 1 1 1 1 2 3 4
$EndEntities
$Nodes
2 12 1 12
2 3 0 6
1
2
3
4
5
6
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
3 1 1 6
7
8
9
10
11
12
0 0 1 0 0 1
1 0 1.5 1 0 1
2 0 1 2 0 1
0 1 1 0 1 1
1 1 1 1 1 1
2 1 1 2 1 1
$EndNodes
$Elements
2 4 1 4
2 3 3 2
1 1 2 5 4
2 2 3 6 5
3 1 5 2
3 1 2 5 4 7 8 11 10
4 2 3 6 5 8 9 12 11
$EndElements
)";

  /** What comes of a text: 'read', 'refused', or what must not be. */
  template <int dim>
  std::string
  outcome(const std::string &text)
  {
    alarm(20); // an endless loop ends the test
    try
      {
        Triangulation<dim> mesh;
        make_mesh<dim>(MshFile(text), true, mesh);
        mesh.refine_global(1);
        return folded_cell(mesh).empty() ? "read" : "a folded mesh";
      }
    catch (const MeshError &error)
      {
        return std::string(error.what()).empty() || error.try_this.empty() ?
                 "no words" :
                 "refused";
      }
    catch (const std::exception &error)
      {
        return std::string("not a message: ") + error.what();
      }
  }

  /** One random change of a text. */
  inline void
  mutate(std::string &text, std::mt19937 &random)
  {
    const auto below = [&](const std::size_t n) { return random() % n; };
    if (text.size() < 2)
      return;
    const auto at = below(text.size());
    // the word around that place
    const std::string blanks = " \n";
    const auto        before = text.find_last_of(blanks, at);
    const auto        begin  = before == std::string::npos ? 0 : before + 1;
    const auto  end     = std::min(text.find_first_of(blanks, at), text.size());
    const auto  size    = end > begin ? end - begin : 0;
    const char *words[] = {"-1",
                           "0",
                           "1",
                           "2000000000",
                           "1e308",
                           "nan",
                           "5",
                           "18446744073709551616",
                           "",
                           "$EndNodes",
                           "3",
                           "\""};
    switch (below(7))
      {
        case 0: // another byte
          text[at] = static_cast<char>(below(256));
          break;
        case 1: // cut short
          text.resize(at);
          break;
        case 2: // a hole
          text.erase(at, 1 + below(20));
          break;
        case 3: // a part twice
          text.insert(at, text.substr(below(text.size()), 1 + below(60)));
          break;
        case 4: // a digit
          for (auto i = at; i < text.size(); ++i)
            if (text[i] >= '0' && text[i] <= '9')
              {
                text[i] = static_cast<char>('0' + below(10));
                break;
              }
          break;
        default: // another word
          text.replace(begin, size, words[below(std::size(words))]);
      }
  }

  /** @param n number of damaged files of each kind */
  inline int
  run(const unsigned int n)
  {
    Verdicts     verdict;
    std::mt19937 random(20240229);
    unsigned int n_read = 0, n_refused = 0;
    const auto count = [&](const std::string &found, const std::string &text) {
      n_read += found == "read";
      n_refused += found == "refused";
      if (found != "read" && found != "refused")
        std::cerr << found << " for\n" << text << "\n";
    };
    verdict("both files are read as they are",
            outcome<2>(flat) == "read" && outcome<3>(solid) == "read");
    for (const auto &text : {flat, solid})
      for (unsigned int i = 0; i < n; ++i)
        {
          std::string damaged = text;
          for (auto changes = 1 + random() % 2; changes > 0; --changes)
            mutate(damaged, random);
          count(outcome<2>(damaged), damaged);
          count(outcome<3>(damaged), damaged);
        }
    verdict("all damaged files are read or refused",
            n_read + n_refused == 4 * n);
    std::cout << n_read << " read, " << n_refused << " refused\n";
    verdict("some are read, most are refused",
            n_read > n / 20 && n_refused > 2 * n);
    bool all_refused = true;
    for (const auto &text : {flat, solid})
      for (std::size_t size = 0; size + 1 < text.size(); ++size)
        all_refused &= outcome<2>(text.substr(0, size)) == "refused" &&
                       outcome<3>(text.substr(0, size)) == "refused";
    verdict("all files that were cut short are refused", all_refused);
    return verdict.status();
  }
} // namespace MeshFuzz

#endif
