#include <signoton/base/quoting.h>
#include <signoton/base/scene_file.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <sstream>

namespace Signoton
{
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
      for (char &c : text)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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
    if (const std::string found = control_character_in(value); !found.empty())
      throw UserError("command line: " + join(path, " / ") + " / " + key,
                      found + " in '" + value + "'",
                      "a name of a directory or file without it",
                      "rename it");
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
        {
          const std::string text = value(path, key);
          const bool as_it_is = find_unquoted(text, '#') == std::string::npos &&
                                (text.empty() || text.back() != '\\');
          out << indent << "set " << quoted(key, "=#") << " = "
              << (as_it_is ? text : quoted(text, "#")) << '\n';
        }
      for (const std::string &section : subsections(path))
        {
          out << indent << "subsection " << quoted(section, "#") << '\n';
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
    // what comes from a pipe is written where it is run
    if (name.rfind("/dev/", 0) == 0 || name.rfind("/proc/", 0) == 0)
      return "";
    return std::filesystem::path(name).parent_path().string();
  }
} // namespace Signoton
