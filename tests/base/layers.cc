// A layer may include itself and the layers below it, nothing above.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <string>
#include <vector>

int
main()
{
  const std::vector<std::string> layers = {"base",
                                           "tensors",
                                           "rheology",
                                           "state",
                                           "discretization",
                                           "operators",
                                           "solvers",
                                           "drivers",
                                           "scene"};
  const auto                     rank   = [&](const std::string &layer) {
    return std::find(layers.begin(), layers.end(), layer) - layers.begin();
  };
  const std::regex include_line(R"(#include <signoton/([a-z]+)/.*)");
  unsigned int     n_files = 0, n_violations = 0;
  for (const std::string &layer : layers)
    for (const std::string top : {"/include/signoton/", "/source/"})
      {
        const std::filesystem::path folder(SIGNOTON_SOURCE_DIR + top + layer);
        if (!std::filesystem::exists(folder))
          continue;
        for (const auto &entry : std::filesystem::directory_iterator(folder))
          {
            ++n_files;
            std::ifstream file(entry.path());
            std::smatch   match;
            for (std::string line; std::getline(file, line);)
              if (std::regex_match(line, match, include_line) &&
                  rank(match[1]) > rank(layer))
                {
                  std::cout << layer << "/" << entry.path().filename().string()
                            << " includes " << match[1] << "\n";
                  ++n_violations;
                }
          }
      }
  std::cout << (n_files > 20 ? "files read" : "no files found") << ", "
            << n_violations << " violations\n";
  return n_violations > 0 || n_files <= 20;
}
