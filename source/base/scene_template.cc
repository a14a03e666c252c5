#include <signoton/base/scene_template.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace Signoton
{
  void
  print_template(std::ostream          &out,
                 ParameterHandler      &handler,
                 const SceneFile       &file,
                 const SceneFile::Path &section)
  {
    std::stringstream text;
    handler.print_parameters(text, ParameterHandler::PRM);
    SceneFile::Path path;
    for (std::string line; std::getline(text, line);)
      {
        const std::string content = Utilities::trim(line);
        if (content.rfind("subsection ", 0) == 0)
          path.push_back(content.substr(11));
        else if (content == "end")
          path.pop_back();
        const bool is_within =
          path.size() >= section.size() &&
          std::equal(section.begin(), section.end(), path.begin());
        if (content.rfind("set ", 0) == 0 && is_within &&
            !file.has(
              path, Utilities::trim(content.substr(4, content.find('=') - 4))))
          line.insert(line.find_first_not_of(' '), "# ");
        out << line << "\n";
      }
  }
} // namespace Signoton
