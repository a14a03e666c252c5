#include <signoton/base/first_rank.h>
#include <signoton/base/quoting.h>
#include <signoton/base/scene_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>
#include <vector>

// From text, of a file or of the command line, to entries.

namespace Signoton
{
  namespace
  {
    /** A line without its comment and its continuations, trimmed, and the
     *  number of its first part. */
    struct Line
    {
      std::string  text;
      unsigned int number;
    };

    std::string
    without_comment(const std::string &line)
    {
      return Utilities::trim(line.substr(0, find_unquoted(line, '#')));
    }

    /** The text with the line ends of Unix and without the byte order mark that
     *  some editors put in front. */
    std::string
    plain_text(const std::string &text)
    {
      const std::string mark = "\xef\xbb\xbf";
      std::string       plain;
      for (std::size_t i = text.rfind(mark, 0) == 0 ? mark.size() : 0;
           i < text.size();
           ++i)
        if (text[i] != '\r')
          plain += text[i];
        else if (i + 1 >= text.size() || text[i + 1] != '\n')
          plain += '\n';
      return plain;
    }

    std::vector<Line>
    logical_lines(const std::string &text, const std::string &name)
    {
      std::vector<Line>  lines;
      std::istringstream stream(text);
      unsigned int       number = 0;
      std::string        raw;
      const auto         next = [&]() {
        if (!std::getline(stream, raw))
          return false;
        ++number;
        if (const std::string found = control_character_in(raw); !found.empty())
          throw UserError(name + ", line " + std::to_string(number),
                          found,
                          "text: ASCII, UTF-8 or Latin-1",
                          "save the file as plain text in UTF-8");
        return true;
      };
      while (next())
        {
          Line line{without_comment(raw), number};
          while (!line.text.empty() && line.text.back() == '\\' && next())
            {
              line.text.pop_back();
              line.text += without_comment(raw);
            }
          if (!line.text.empty())
            lines.push_back(line);
        }
      return lines;
    }

    /** Split `first rest` at the first white space. */
    std::pair<std::string, std::string>
    first_word(const std::string &line)
    {
      const auto end = line.find_first_of(" \t");
      if (end == std::string::npos)
        return {line, ""};
      return {line.substr(0, end), Utilities::trim(line.substr(end))};
    }

    /** A list of constants, those of a second one put in or added. */
    std::string
    merge_constants(const std::string &list, const std::string &changes)
    {
      const auto name_of = [](const std::string &item) {
        return Utilities::trim(item.substr(0, item.find('=')));
      };
      auto items = Utilities::split_string_list(list, ',');
      for (const auto &change : Utilities::split_string_list(changes, ','))
        {
          const auto old =
            std::find_if(items.begin(), items.end(), [&](const auto &item) {
              return name_of(item) == name_of(change);
            });
          if (old == items.end())
            items.push_back(change);
          else
            *old = change;
        }
      return join(items, ", ");
    }

    /** Sections nest no deeper. */
    constexpr std::size_t deepest_section = 20;
  } // namespace

  SceneFile
  SceneFile::read(const std::string &file_name)
  {
    return read_scene(MPI_COMM_SELF, file_name);
  }

  SceneFile
  SceneFile::parse(const std::string &text, const std::string &name)
  {
    SceneFile scene;
    scene.name = name;
    Path path;
    for (const Line &line : logical_lines(plain_text(text), name))
      {
        const auto complain = [&](const std::string &expected,
                                  const std::string &hint) {
          throw UserError(name + ", line " + std::to_string(line.number),
                          "'" + line.text + "'",
                          expected,
                          hint);
        };
        const auto [word, rest] = first_word(line.text);
        const auto equal        = find_unquoted(rest, '=');
        if (word == "subsection" && !unquoted(rest).empty())
          {
            path.push_back(unquoted(rest));
            if (path.size() > deepest_section)
              complain("at most " + std::to_string(deepest_section) +
                         " subsections within each other",
                       "find the missing 'end'");
            scene.sections.emplace_back(path, line.number);
          }
        else if (word == "end" && rest.empty())
          {
            if (path.empty())
              complain("an 'end' for every 'subsection', no more",
                       "remove this line or find the missing 'subsection'");
            path.pop_back();
          }
        else if (word == "set" && equal != std::string::npos)
          {
            const std::string key =
              unquoted(Utilities::trim(rest.substr(0, equal)));
            if (const Entry *before = scene.find(path, key))
              complain("one value for each key; '" + key +
                         "' has one in line " + std::to_string(before->line),
                       "remove one of them");
            scene.entries.push_back({path,
                                     key,
                                     Utilities::trim(rest.substr(equal + 1)),
                                     line.number});
          }
        else
          complain("'subsection Name', 'set Key = value', 'end' or a '#' "
                   "comment",
                   "compare with a file in prm/");
      }
    if (!path.empty())
      throw UserError(name + ", end of file",
                      "subsection '" + path.back() + "' is still open",
                      "an 'end' for every 'subsection'",
                      "add the missing 'end'");
    return scene;
  }

  void
  SceneFile::override_entry(const std::string &assignment)
  {
    const auto refuse = [&](const std::string &found,
                            const std::string &expected,
                            const std::string &hint) {
      throw UserError("command line, --set", found, expected, hint);
    };
    // a value may go over several lines, as in a file
    std::string line = assignment;
    std::replace(line.begin(), line.end(), '\n', ' ');
    if (const std::string found = control_character_in(line); !found.empty())
      refuse(found, "text", "remove it");
    const auto equal = find_unquoted(line, '=');
    if (equal == std::string::npos)
      refuse("'" + line + "'",
             "'Section/Key=value'",
             "quote the whole assignment, for instance --set "
             "'Discretization/Degree=2'");
    std::string value = Utilities::trim(line.substr(equal + 1));
    if (find_unquoted(value, '#') != std::string::npos)
      refuse("'" + line + "'",
             "a '#' in double quotes, without which it begins a comment",
             "--set 'Title=\"sand # 1\"', for instance");
    Path path;
    for (const auto &name : split_unquoted(line.substr(0, equal), '/'))
      path.push_back(unquoted(name));
    std::string key = path.empty() ? "" : path.back();
    if (!path.empty())
      path.pop_back();
    const bool is_section =
      std::any_of(sections.begin(), sections.end(), [&](const auto &section) {
        return section.first == path;
      });
    if (!is_section && !path.empty() && path.back() == "Constants")
      {
        value = key + " = " + value;
        key   = path.back();
        path.pop_back();
      }
    if (key == "Constants")
      value = merge_constants(this->value(path, key), value);
    entries.push_back({path, key, value, 0});
    open_sections(path);
  }
} // namespace Signoton
