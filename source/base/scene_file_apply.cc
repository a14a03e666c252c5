#include <signoton/base/scene_file.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <sstream>

// What a scene file gives, compared with what is declared.

namespace Signoton
{
  namespace
  {
    using Tree = boost::property_tree::ptree;

    /** A name as it was, before ParameterHandler put an underscore and two
     *  hexadecimal digits for each character that is no letter and no digit. */
    std::string
    demangle(const std::string &mangled)
    {
      std::string plain;
      for (std::size_t i = 0; i < mangled.size(); ++i)
        if (mangled[i] == '_')
          {
            plain += static_cast<char>(
              std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          plain += mangled[i];
      return plain;
    }

    /** All that is declared, with mangled names; of the formats of
     *  ParameterHandler this one always has them. */
    Tree
    declared_tree(const ParameterHandler &handler)
    {
      std::stringstream stream;
      handler.print_parameters(stream, ParameterHandler::XML);
      Tree tree;
      boost::property_tree::read_xml(stream, tree);
      return tree.get_child("ParameterHandler");
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

    /** What the pattern of an entry lets pass, and its meaning. */
    [[noreturn]] void
    refuse_value(const std::string &where,
                 const std::string &value,
                 const Tree        &leaf)
    {
      const auto pattern =
        Patterns::pattern_factory(leaf.get<std::string>("pattern_description"));
      std::vector<std::string> choices;
      if (dynamic_cast<const Patterns::Bool *>(pattern.get()) != nullptr)
        choices = {"true", "false"};
      else if (dynamic_cast<const Patterns::Selection *>(pattern.get()) !=
               nullptr)
        {
          const std::string list = leaf.get<std::string>("pattern_description");
          const auto        begin = list.find(' '), end = list.rfind(']');
          choices =
            Utilities::split_string_list(list.substr(begin, end - begin), '|');
        }
      std::string expected = pattern->description(Patterns::PatternBase::Text);
      const std::string meaning = leaf.get<std::string>("documentation", "");
      throw UserError(where,
                      "'" + value + "'",
                      expected,
                      suggestion(value, choices, meaning));
    }
  } // namespace

  std::vector<std::string>
  SceneFile::drop(const ParameterHandler &others, const ParameterHandler &own)
  {
    const Tree theirs = declared_tree(others), ours = declared_tree(own);
    std::vector<std::string> places;
    for (const std::string &section : subsections({}))
      {
        const Tree *their = child(theirs, section), *our = child(ours, section);
        if (their == nullptr)
          continue;
        const auto given = keys({section});
        if (our == nullptr)
          {
            places.push_back(where({section}, given.empty() ? "" : given[0]) +
                             " and the rest of '" + section + "'");
            remove({section});
            continue;
          }
        for (const std::string &key : given)
          if (child(*our, key) == nullptr && child(*their, key) != nullptr)
            {
              places.push_back(where({section}, key));
              remove({section}, key);
            }
      }
    return places;
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
          refuse_value(place(entry), entry.value, *leaf);
      }
  }
} // namespace Signoton
