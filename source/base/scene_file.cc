#include <signoton/base/scene_file.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace Signoton
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** Split `first rest` at the first white space. */
    std::pair<std::string, std::string>
    first_word(const std::string &line)
    {
      const auto end = line.find_first_of(" \t");
      if (end == std::string::npos)
        return {line, ""};
      return {line.substr(0, end), Utilities::trim(line.substr(end))};
    }

    /** ParameterHandler prints names with characters that trees cannot hold
     *  mangled as _xx; this undoes it. */
    std::string
    demangle(const std::string &mangled)
    {
      std::string plain;
      for (std::size_t i = 0; i < mangled.size(); ++i)
        if (mangled[i] == '_' && i + 2 < mangled.size())
          {
            plain += static_cast<char>(
              std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          plain += mangled[i];
      return plain;
    }

    Tree
    declared_tree(const ParameterHandler &handler)
    {
      std::stringstream stream;
      handler.print_parameters(stream, ParameterHandler::JSON);
      Tree tree;
      boost::property_tree::read_json(stream, tree);
      return tree;
    }

    bool
    is_entry(const Tree &node)
    {
      return node.count("value") > 0 && node.count("pattern_description") > 0;
    }

    const Tree *
    child(const Tree &tree, const std::string &name)
    {
      for (const auto &[mangled, node] : tree)
        if (demangle(mangled) == name)
          return &node;
      return nullptr;
    }

    std::vector<std::string>
    names(const Tree &tree, const bool entries)
    {
      std::vector<std::string> result;
      for (const auto &[mangled, node] : tree)
        if (is_entry(node) == entries)
          result.push_back(demangle(mangled));
      return result;
    }

    std::string
    suggestion(const std::string              &word,
               const std::vector<std::string> &candidates,
               const std::string              &otherwise)
    {
      const std::string nearest = nearest_name(word, candidates);
      return nearest.empty() ? otherwise : "did you mean '" + nearest + "'?";
    }
  } // namespace

  std::string
  join(const std::vector<std::string> &items, const std::string &separator)
  {
    std::string text;
    for (const auto &item : items)
      text += (text.empty() ? "" : separator) + item;
    return text;
  }

  std::string
  nearest_name(const std::string              &word,
               const std::vector<std::string> &candidates)
  {
    const auto lower = [](std::string text) {
      std::transform(text.begin(), text.end(), text.begin(), ::tolower);
      return text;
    };
    std::string best;
    std::size_t best_distance =
      std::max<std::size_t>(2, (word.size() + 2) / 3) + 1;
    for (const auto &candidate : candidates)
      {
        const std::string        a = lower(word), b = lower(candidate);
        std::vector<std::size_t> row(b.size() + 1);
        for (std::size_t j = 0; j <= b.size(); ++j)
          row[j] = j;
        for (std::size_t i = 1; i <= a.size(); ++i)
          {
            std::size_t diagonal = row[0];
            row[0]               = i;
            for (std::size_t j = 1; j <= b.size(); ++j)
              {
                const std::size_t above = row[j];
                row[j]                  = std::min({above + 1,
                                                    row[j - 1] + 1,
                                                    diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
                diagonal                = above;
              }
          }
        if (row.back() < best_distance)
          {
            best_distance = row.back();
            best          = candidate;
          }
      }
    return best;
  }

  SceneFile
  SceneFile::read(const std::string &file_name)
  {
    std::ifstream file(file_name);
    if (!file || std::filesystem::is_directory(file_name))
      throw UserError("file '" + file_name + "'",
                      "it cannot be opened",
                      "a readable parameter file (.prm)",
                      "check the name and the directory; 'signoton --template "
                      "statics' prints one to start from");
    std::stringstream text;
    text << file.rdbuf();
    return parse(text.str(), file_name);
  }

  SceneFile
  SceneFile::parse(const std::string &text, const std::string &name)
  {
    SceneFile scene;
    scene.name = name;
    Path               path;
    std::istringstream stream(text);
    std::string        raw, line;
    unsigned int       number = 0, first_of_line = 0;
    const auto         complain = [&](const std::string &expected,
                              const std::string &hint) {
      throw UserError(name + ", line " + std::to_string(first_of_line),
                      "'" + line + "'",
                      expected,
                      hint);
    };
    while (std::getline(stream, raw))
      {
        ++number;
        first_of_line = number;
        line          = Utilities::trim(raw.substr(0, raw.find('#')));
        while (!line.empty() && line.back() == '\\' &&
               std::getline(stream, raw))
          {
            ++number;
            line.pop_back();
            line += Utilities::trim(raw.substr(0, raw.find('#')));
          }
        if (line.empty())
          continue;
        const auto [word, rest] = first_word(line);
        if (word == "subsection" && !rest.empty())
          {
            path.push_back(rest);
            scene.sections.emplace_back(path, first_of_line);
          }
        else if (word == "end" && rest.empty())
          {
            if (path.empty())
              complain("an 'end' for every 'subsection', no more",
                       "remove this line or find the missing 'subsection'");
            path.pop_back();
          }
        else if (word == "set" && rest.find('=') != std::string::npos)
          {
            const auto        equal = rest.find('=');
            const std::string key   = Utilities::trim(rest.substr(0, equal));
            if (const Entry *before = scene.find(path, key))
              complain("one value for each key; '" + key +
                         "' has one in line " + std::to_string(before->line),
                       "remove one of them");
            scene.entries.push_back({path,
                                     key,
                                     Utilities::trim(rest.substr(equal + 1)),
                                     first_of_line});
          }
        else
          complain("'subsection Name', 'set Key = value', 'end' or a '#' "
                   "comment",
                   "compare with a file in prm/");
      }
    if (!path.empty())
      throw UserError(name + ", end of file",
                      "subsection '" + join(path, "/") + "' is still open",
                      "an 'end' for every 'subsection'",
                      "add the missing 'end'");
    return scene;
  }

  void
  SceneFile::override_entry(const std::string &assignment)
  {
    const auto equal = assignment.find('=');
    if (equal == std::string::npos)
      throw UserError("command line, --set",
                      "'" + assignment + "'",
                      "'Section/Key=value'",
                      "quote the whole assignment, for instance --set "
                      "'Discretization/Degree=2'");
    Path path = Utilities::split_string_list(assignment.substr(0, equal), '/');
    const std::string key = path.empty() ? "" : path.back();
    if (!path.empty())
      path.pop_back();
    entries.push_back(
      {path, key, Utilities::trim(assignment.substr(equal + 1)), 0});
    open_sections(path);
  }

  void
  SceneFile::open_sections(const Path &path)
  {
    for (std::size_t depth = 1; depth <= path.size(); ++depth)
      sections.emplace_back(Path(path.begin(), path.begin() + depth), 0);
  }

  void
  SceneFile::set(const Path        &path,
                 const std::string &key,
                 const std::string &value)
  {
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
      if (entry->path == path && entry->key == key)
        {
          entry->value = value;
          return;
        }
    entries.push_back({path, key, value, 0});
    open_sections(path);
  }

  void
  SceneFile::remove(const Path &path, const std::string &key)
  {
    const auto is_below = [&](const Path &other) {
      return other.size() >= path.size() &&
             std::equal(path.begin(), path.end(), other.begin());
    };
    entries.erase(std::remove_if(entries.begin(),
                                 entries.end(),
                                 [&](const Entry &entry) {
                                   return key.empty() ? is_below(entry.path) :
                                                        entry.path == path &&
                                                          entry.key == key;
                                 }),
                  entries.end());
    if (key.empty())
      sections.erase(std::remove_if(sections.begin(),
                                    sections.end(),
                                    [&](const auto &section) {
                                      return is_below(section.first);
                                    }),
                     sections.end());
  }

  std::vector<std::string>
  SceneFile::subsections(const Path &path) const
  {
    std::vector<std::string> result;
    for (const auto &[section, line] : sections)
      if (section.size() == path.size() + 1 &&
          std::equal(path.begin(), path.end(), section.begin()) &&
          std::find(result.begin(), result.end(), section.back()) ==
            result.end())
        result.push_back(section.back());
    return result;
  }

  const SceneFile::Entry *
  SceneFile::find(const Path &path, const std::string &key) const
  {
    for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry)
      if (entry->path == path && entry->key == key)
        return &*entry;
    return nullptr;
  }

  std::string
  SceneFile::value(const Path        &path,
                   const std::string &key,
                   const std::string &fallback) const
  {
    const Entry *entry = find(path, key);
    return entry ? entry->value : fallback;
  }

  bool
  SceneFile::has(const Path &path, const std::string &key) const
  {
    return find(path, key) != nullptr;
  }

  std::vector<std::string>
  SceneFile::keys(const Path &path) const
  {
    std::vector<std::string> result;
    for (const Entry &entry : entries)
      if (entry.path == path &&
          std::find(result.begin(), result.end(), entry.key) == result.end())
        result.push_back(entry.key);
    return result;
  }

  std::string
  SceneFile::place(const Entry &entry) const
  {
    Path full = entry.path;
    full.push_back(entry.key);
    return (entry.line == 0 ? "command line" :
                              name + ", line " + std::to_string(entry.line)) +
           ": " + join(full, " / ");
  }

  std::string
  SceneFile::where(const Path &path, const std::string &key) const
  {
    if (const Entry *entry = find(path, key))
      return place(*entry);
    Path full = path;
    if (!key.empty())
      full.push_back(key);
    for (const auto &[section, line] : sections)
      if (section == path && line > 0)
        return name + ", line " + std::to_string(line) + ": " +
               join(full, " / ");
    return name + ": " + join(full, " / ") + " (not set)";
  }

  std::string
  SceneFile::text() const
  {
    std::ostringstream                      out;
    const std::function<void(const Path &)> print = [&](const Path &path) {
      const std::string indent(2 * path.size(), ' ');
      for (const std::string &key : keys(path))
        out << indent << "set " << key << " = " << value(path, key) << '\n';
      for (const std::string &section : subsections(path))
        {
          out << indent << "subsection " << section << '\n';
          Path below = path;
          below.push_back(section);
          print(below);
          out << indent << "end\n";
        }
    };
    print({});
    return out.str();
  }

  std::string
  SceneFile::directory() const
  {
    return std::filesystem::path(name).parent_path().string();
  }

  void
  SceneFile::apply_to(ParameterHandler &handler) const
  {
    const Tree tree = declared_tree(handler);
    for (const auto &[path, line] : sections)
      {
        const Tree *node = &tree;
        for (std::size_t depth = 0; depth < path.size(); ++depth)
          {
            const Tree *next = child(*node, path[depth]);
            if (next == nullptr || is_entry(*next))
              throw UserError(where(path),
                              "unknown subsection '" + path[depth] + "'",
                              "one of: " + join(names(*node, false), ", "),
                              suggestion(path[depth],
                                         names(*node, false),
                                         "remove it"));
            node = next;
          }
      }

    for (const Entry &entry : entries)
      {
        const Tree *node = &tree;
        for (const auto &section : entry.path)
          node = child(*node, section);
        const Tree *leaf = child(*node, entry.key);
        if (leaf == nullptr || !is_entry(*leaf))
          throw UserError(place(entry),
                          "unknown key '" + entry.key + "'",
                          "one of: " + join(names(*node, true), ", "),
                          suggestion(entry.key,
                                     names(*node, true),
                                     "'signoton --template statics' lists "
                                     "all keys with their meaning"));
        for (const auto &section : entry.path)
          handler.enter_subsection(section);
        bool fits = true;
        try
          {
            handler.set(entry.key, entry.value);
          }
        catch (const ExceptionBase &)
          {
            fits = false;
          }
        for (std::size_t i = 0; i < entry.path.size(); ++i)
          handler.leave_subsection();
        if (!fits)
          throw UserError(place(entry),
                          "'" + entry.value + "'",
                          Patterns::pattern_factory(
                            leaf->get<std::string>("pattern_description"))
                            ->description(Patterns::PatternBase::Text),
                          leaf->get<std::string>("documentation", ""));
      }
  }
} // namespace Signoton
