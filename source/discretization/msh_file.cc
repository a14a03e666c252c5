#include <signoton/discretization/msh_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>
#include <unordered_map>

namespace Signoton
{
  namespace
  {
    constexpr ElementType element_types[] = {
      {1, "lines", 1, 2, 1},
      {2, "triangles", 2, 3, 1},
      {3, "quadrilaterals", 2, 4, 1},
      {4, "tetrahedra", 3, 4, 1},
      {5, "hexahedra", 3, 8, 1},
      {6, "prisms", 3, 6, 1},
      {7, "pyramids", 3, 5, 1},
      {8, "lines of 3 nodes", 1, 3, 2},
      {9, "triangles of 6 nodes", 2, 6, 2},
      {10, "quadrilaterals of 9 nodes", 2, 9, 2},
      {11, "tetrahedra of 10 nodes", 3, 10, 2},
      {12, "hexahedra of 27 nodes", 3, 27, 2},
      {13, "prisms of 18 nodes", 3, 18, 2},
      {14, "pyramids of 14 nodes", 3, 14, 2},
      {15, "points", 0, 1, 1},
      {16, "quadrilaterals of 8 nodes", 2, 8, 2},
      {17, "hexahedra of 20 nodes", 3, 20, 2},
      {18, "prisms of 15 nodes", 3, 15, 2},
      {19, "pyramids of 13 nodes", 3, 13, 2}};

    const std::string damaged =
      "write it anew: it is cut short or damaged, or no mesh of gmsh";
    const std::string how_to_convert =
      "let gmsh write it as it is read here: 'gmsh OLD.msh -save -format msh22 "
      "-bin 0 -o NEW.msh'";

    /** The words of a text, with the lines they stand in. */
    class Words
    {
    public:
      explicit Words(const std::string &text)
        : text(text)
      {}

      bool
      at_end()
      {
        while (position < text.size() && is_space(text[position]))
          line_of_position += text[position++] == '\n';
        return position == text.size();
      }

      /** The next word; @p what says what is due. */
      std::string_view
      word(const std::string &what)
      {
        if (at_end())
          throw MeshError("line " + std::to_string(line_of_position) +
                            ", where it ends instead of " + what,
                          damaged);
        line             = line_of_position;
        const auto begin = position;
        while (position < text.size() && !is_space(text[position]))
          ++position;
        return last = std::string_view(text).substr(begin, position - begin);
      }

      /** An integer from @p low to @p high. */
      long long
      integer(const std::string &what,
              const long long    low,
              const long long    high)
      {
        const auto number = word(what);
        long long  value  = 0;
        const auto end    = number.data() + number.size();
        const auto parsed = std::from_chars(number.data(), end, value);
        if (parsed.ec != std::errc() || parsed.ptr != end || value < low ||
            value > high)
          complain(what);
        return value;
      }

      /** How many things follow, each of which takes two bytes or more. */
      std::size_t
      count(const std::string &what)
      {
        const auto n = integer("the number of " + what, 0, largest_count);
        if (2 * static_cast<std::size_t>(n) > text.size() - position)
          fail(std::to_string(n) + " " + what +
                 ", for which the file is too short",
               damaged);
        return n;
      }

      double
      real(const std::string &what)
      {
        const std::string number(word(what));
        char             *end   = nullptr;
        const double      value = std::strtod(number.c_str(), &end);
        if (end != number.c_str() + number.size() || !std::isfinite(value))
          complain(what + ", a number");
        return value;
      }

      /** What is left of the line, without the end of it. */
      std::string
      rest_of_line()
      {
        const auto begin = position;
        position         = std::min(text.find('\n', begin), text.size());
        return text.substr(begin, position - begin);
      }

      /** Go behind the end of a section that nobody reads. */
      void
      skip_section(const std::string &name)
      {
        const std::string end = "$End" + name;
        while (word(end) != end)
          {}
      }

      void
      expect(const std::string &due)
      {
        if (word(due) != due)
          complain(due);
      }

      [[noreturn]] void
      complain(const std::string &due) const
      {
        fail("'" + printable() + "' instead of " + due, damaged);
      }

      [[noreturn]] void
      fail(const std::string &found, const std::string &try_this) const
      {
        throw MeshError("line " + std::to_string(line) + ": " + found,
                        try_this);
      }

      /** The last word, as a terminal can show it. */
      std::string
      printable() const
      {
        std::string shown(last.substr(0, 40));
        std::replace_if(
          shown.begin(),
          shown.end(),
          [](const char c) { return c < ' ' || c > '~'; },
          '?');
        return shown + (last.size() > 40 ? "..." : "");
      }

      /** The line of the last word. */
      std::size_t line = 1;

      static constexpr long long largest_count = 2000000000;

    private:
      static bool
      is_space(const char c)
      {
        return c == ' ' || c == '\n' || c == '\t' || c == '\r';
      }

      const std::string &text;
      std::size_t        position = 0, line_of_position = 1;
      std::string_view   last;
    };

    /** Reads the sections into an MshFile. */
    class Reader
    {
    public:
      Reader(const std::string &text, MshFile &file)
        : words(text)
        , file(file)
      {}

      void
      read()
      {
        std::set<std::string> sections;
        while (!words.at_end())
          {
            const std::string name = section_name();
            if (name != "MeshFormat" && version == 0. && name != "Comments")
              words.fail("'" + words.printable() + "' before $MeshFormat",
                         name == "NOD" ? how_to_convert : damaged);
            if (name == "Elements" && sections.count("Nodes") == 0)
              words.fail("elements before nodes", damaged);
            if (!read_section(name))
              {
                words.skip_section(name);
                continue;
              }
            words.expect("$End" + name);
            if (!sections.insert(name).second)
              words.fail("a second section $" + name, damaged);
          }
        for (const char *needed : {"MeshFormat", "Nodes", "Elements"})
          if (sections.count(needed) == 0)
            throw MeshError(std::string("no section $") + needed, damaged);
      }

    private:
      std::string
      section_name()
      {
        const auto name = words.word("a section");
        if (name.size() < 2 || name[0] != '$')
          words.complain("a section, as '$Nodes'");
        return std::string(name.substr(1));
      }

      bool
      read_section(const std::string &name)
      {
        if (name == "MeshFormat")
          format();
        else if (name == "PhysicalNames")
          physical_names();
        else if (name == "Entities" && version > 4.)
          entities();
        else if (name == "Nodes")
          version > 4. ? nodes_by_blocks() : nodes_by_lines();
        else if (name == "Elements")
          version > 4. ? elements_by_blocks() : elements_by_lines();
        else
          return false;
        return true;
      }

      void
      format()
      {
        version = words.real("the version of the format");
        const bool known =
          (version >= 2. && version < 3.) || std::abs(version - 4.1) < 1e-6;
        if (!known)
          words.fail("version " + words.printable() +
                       " of the format; read are 2.2 and 4.1",
                     how_to_convert);
        if (words.integer("the type of the file, 0 for ASCII", 0, 1) == 1)
          words.fail("a binary file; read are those in ASCII", how_to_convert);
        words.integer("the size of a number in bytes", 1, 64);
      }

      void
      physical_names()
      {
        for (auto n = words.count("names"); n > 0; --n)
          {
            const int dim   = words.integer("the dimension of a group", 0, 3);
            const int group = words.integer("the number of a group", 1, most);
            const std::string rest  = words.rest_of_line();
            const auto        first = rest.find('"'), last = rest.rfind('"');
            if (first == last)
              words.fail("a name that is not in quotes", damaged);
            const std::string name = rest.substr(first + 1, last - first - 1);
            for (const auto &[other, other_name] : file.names)
              if (other.first == dim && other_name == name)
                words.fail("a second group of dimension " +
                             std::to_string(dim) + " called '" + name + "'",
                           "one name for each physical group, and the other "
                           "way round");
            if (!file.names.emplace(std::make_pair(dim, group), name).second)
              words.fail("a second name for group " + std::to_string(group) +
                           " of dimension " + std::to_string(dim),
                         damaged);
          }
      }

      void
      entities()
      {
        std::size_t n[4];
        for (int dim = 0; dim <= 3; ++dim)
          n[dim] = words.count("entities");
        for (int dim = 0; dim <= 3; ++dim)
          for (; n[dim] > 0; --n[dim])
            {
              const int tag = words.integer("an entity", -most, most);
              for (int d = 0; d < (dim == 0 ? 3 : 6); ++d)
                words.real("a bound of an entity");
              std::vector<int> groups(words.count("its groups"));
              for (auto &group : groups)
                group = std::abs(words.integer("a group", -most, most));
              if (dim > 0)
                for (auto bounds = words.count("its bounds"); bounds > 0;
                     --bounds)
                  words.integer("a bound", -most, most);
              if (!groups_of.emplace(std::make_pair(dim, tag), groups).second)
                words.fail("entity " + std::to_string(tag) +
                             " for the second time",
                           damaged);
            }
      }

      void
      add_node(const long long number, const std::size_t index)
      {
        if (!index_of.emplace(number, index).second)
          words.fail("node " + std::to_string(number) + " for the second time",
                     damaged);
      }

      Point<3>
      coordinates()
      {
        Point<3> point;
        for (unsigned int d = 0; d < 3; ++d)
          point[d] = words.real("a coordinate");
        return point;
      }

      void
      nodes_by_lines()
      {
        for (auto n = words.count("nodes"); n > 0; --n)
          {
            add_node(words.integer("a node", 0, most), file.nodes.size());
            file.nodes.push_back(coordinates());
          }
      }

      void
      nodes_by_blocks()
      {
        auto              n_blocks = words.count("blocks");
        const std::size_t n_nodes  = words.count("nodes");
        words.integer("the first node", 0, most);
        words.integer("the last node", 0, most);
        for (; n_blocks > 0; --n_blocks)
          {
            const int dim = words.integer("a dimension", 0, 3);
            words.integer("an entity", -most, most);
            const bool parametric = words.integer("0 or 1", 0, 1) == 1;
            const auto n          = words.count("nodes of a block");
            for (std::size_t i = 0; i < n; ++i)
              add_node(words.integer("a node", 0, most), file.nodes.size() + i);
            for (std::size_t i = 0; i < n; ++i)
              {
                file.nodes.push_back(coordinates());
                for (int d = 0; parametric && d < dim; ++d)
                  words.real("a parameter");
              }
          }
        if (file.nodes.size() != n_nodes)
          words.fail(std::to_string(file.nodes.size()) + " nodes instead of " +
                       std::to_string(n_nodes),
                     damaged);
      }

      const ElementType &
      element_type()
      {
        const int  number = words.integer("a type of elements", 1, most);
        const auto type =
          std::find_if(std::begin(element_types),
                       std::end(element_types),
                       [number](const auto &t) { return t.number == number; });
        if (type == std::end(element_types))
          words.fail("elements of type " + std::to_string(number) +
                       ", of high order or unknown",
                     "elements of first order: 'Mesh.ElementOrder = 1'");
        return *type;
      }

      /** The nodes that follow, for an element in each of the groups. */
      void
      add_elements(const ElementType &type, const std::vector<int> &groups)
      {
        const std::size_t first = file.element_nodes.size();
        for (unsigned int i = 0; i < type.n_nodes; ++i)
          {
            const auto node  = words.integer("a node", 0, most);
            const auto found = index_of.find(node);
            if (found == index_of.end())
              words.fail("node " + std::to_string(node) +
                           ", which the file has not",
                         damaged);
            file.element_nodes.push_back(found->second);
          }
        for (const int group : groups)
          file.elements.push_back({&type, group, first, words.line});
      }

      void
      elements_by_lines()
      {
        for (auto n = words.count("elements"); n > 0; --n)
          {
            words.integer("an element", 0, most);
            const ElementType &type  = element_type();
            int                group = 0;
            const auto         tags  = words.count("tags");
            for (std::size_t i = 0; i < tags; ++i)
              {
                const int tag = words.integer("a tag", -most, most);
                if (i == 0)
                  group = std::abs(tag);
              }
            add_elements(type, {group});
          }
      }

      void
      elements_by_blocks()
      {
        auto              n_blocks   = words.count("blocks");
        const std::size_t n_elements = words.count("elements");
        words.integer("the first element", 0, most);
        words.integer("the last element", 0, most);
        std::size_t n_read = 0;
        for (; n_blocks > 0; --n_blocks)
          {
            const int  dim    = words.integer("a dimension", 0, 3);
            const int  entity = words.integer("an entity", -most, most);
            const auto groups = groups_of.find({dim, entity});
            if (groups == groups_of.end())
              words.fail("entity " + std::to_string(entity) + " of dimension " +
                           std::to_string(dim) + ", which is not in $Entities",
                         "a file that is not divided for many processors, "
                         "whole: " +
                           damaged);
            const ElementType &type = element_type();
            const auto         n    = words.count("elements of a block");
            for (std::size_t i = 0; i < n; ++i, ++n_read)
              {
                words.integer("an element", 0, most);
                add_elements(type,
                             groups->second.empty() ? std::vector<int>{0} :
                                                      groups->second);
              }
          }
        if (n_read != n_elements)
          words.fail(std::to_string(n_read) + " elements instead of " +
                       std::to_string(n_elements),
                     damaged);
      }

      static constexpr long long most = Words::largest_count;

      Words    words;
      MshFile &file;
      double   version = 0.;

      std::map<std::pair<int, int>, std::vector<int>> groups_of; // entities
      std::unordered_map<long long, unsigned int>     index_of;  // nodes
    };
  } // namespace

  MshFile::MshFile(const std::string &text)
  {
    Reader(text, *this).read();
  }
} // namespace Signoton
