// Mesh files that cannot be used: each is refused in a sentence of its own,
// with the line and the place. What can be used is used as it is.

#include <signoton/discretization/mesh_reader.h>

#include <deal.II/grid/grid_tools.h>

#include <fstream>
#include <sstream>

using namespace Signoton;

namespace
{
  std::ofstream output("output");

  const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

  /** A file of version 2.2 from lines of nodes, of elements and of names. */
  std::string
  msh(const std::vector<std::string> &nodes,
      const std::vector<std::string> &elements,
      const std::vector<std::string> &names = {})
  {
    std::ostringstream text;
    text << format;
    const auto section = [&](const std::string              &name,
                             const std::vector<std::string> &lines,
                             const bool                      numbered) {
      text << "$" << name << "\n" << lines.size() << "\n";
      for (std::size_t i = 0; i < lines.size(); ++i)
        text << (numbered ? std::to_string(i + 1) + " " : "") << lines[i]
             << "\n";
      text << "$End" << name << "\n";
    };
    if (!names.empty())
      section("PhysicalNames", names, false);
    section("Nodes", nodes, true);
    section("Elements", elements, true);
    return text.str();
  }

  template <int dim>
  void
  show(const std::string &what, const std::string &text)
  {
    output << what << " (" << dim << "D)\n";
    try
      {
        Triangulation<dim> mesh;
        const auto         groups = make_mesh<dim>(MshFile(text), true, mesh);
        output << "  cells " << mesh.n_active_cells() << ", volume "
               << GridTools::volume(mesh) << ", material ids";
        for (const auto &cell : mesh.active_cell_iterators())
          output << " " << cell->material_id();
        output << ", boundary ids";
        for (const auto id : mesh.get_boundary_ids())
          output << " " << id;
        for (const auto &[name, id] : groups.names)
          output << "; '" << name << "' is " << id;
        for (const auto &[name, counts] : groups.inside)
          output << "; '" << name << "' has " << counts.first << " of "
                 << counts.second << " faces inside";
        output << "\n";
      }
    catch (const MeshError &error)
      {
        output << "  found: " << error.what() << "\n  try:   " << error.try_this
               << "\n";
      }
  }

  /** The points of two squares side by side. */
  const std::vector<std::string> points =
    {"0 0 0", "1 0 0", "2 0 0", "0 1 0", "1 1 0", "2 1 0"};
  const std::string left = "3 2 7 1 1 2 5 4", right = "3 2 7 1 2 3 6 5";

  void
  show_planes()
  {
    show<2>("two squares", msh(points, {left, right}));
    show<2>("one of them counted the other way round",
            msh(points, {left, "3 2 7 1 2 5 6 3"}));
    show<2>(
      "named lines, one of them inside",
      msh(points,
          {left, right, "1 2 3 1 1 2", "1 2 3 1 2 3", "1 2 4 2 2 5"},
          {"1 3 \"bottom_2, \"old\"\"", "1 4 \"interface\"", "2 7 \"body\""}));
    show<2>("a group called 0",
            msh(points, {left, right, "1 2 3 1 1 2"}, {"1 3 \"0\""}));
    show<2>("nodes that nobody uses",
            msh({"9 9 0", "0 0 0", "1 0 0", "1 1 0", "0 1 0"},
                {"3 2 7 1 2 3 4 5"}));
    show<2>("a line in two groups",
            msh(points,
                {left, right, "1 2 3 1 1 2", "1 2 4 1 1 2"},
                {"1 3 \"bottom\"", "1 4 \"fixed\""}));
    show<2>("a cell in two groups",
            msh(points, {left, right, "3 2 8 1 1 2 5 4"}, {"2 8 \"wet\""}));
    show<2>("a line that no cell has",
            msh(points, {left, right, "1 2 3 1 1 6"}, {"1 3 \"bottom\""}));
    show<2>("two groups of one name",
            msh(points, {left}, {"1 3 \"a\"", "1 4 \"a\""}));
    show<2>("a triangle", msh(points, {left, "2 2 7 1 2 3 6"}));
    show<2>("second order",
            msh({"0 0 0",
                 "2 0 0",
                 "2 2 0",
                 "0 2 0",
                 "1 0 0",
                 "2 1 0",
                 "1 2 0",
                 "0 1 0",
                 "1 1 0"},
                {"10 2 7 1 1 2 3 4 5 6 7 8 9"}));
    show<2>("high order", msh(points, {"36 2 7 1 1 2 3 4 5 6"}));
    show<2>("lines alone", msh(points, {"1 2 3 1 1 2"}));
    show<2>("nothing at all", msh({}, {}));
    show<2>("a folded cell", msh(points, {"3 2 7 1 1 2 4 5"}));
    show<2>("a cell with a corner of 180 degrees",
            msh(points, {"3 2 7 1 1 2 3 5"}));
    show<2>("a cell with a node twice", msh(points, {"3 2 7 1 1 2 2 5"}));
    show<2>("a third cell at a line",
            msh({"0 0 0",
                 "1 0 0",
                 "2 0 0",
                 "0 1 0",
                 "1 1 0",
                 "2 1 0",
                 "3 0 0",
                 "3 1 0"},
                {left, right, "3 2 7 1 2 7 8 5"}));
    show<2>("cells that overlap",
            msh({"0 0 0",
                 "1 0 0",
                 "2 0 0",
                 "0 1 0",
                 "1 1 0",
                 "2 1 0",
                 "3 0 0",
                 "3 1 0"},
                {right, "3 2 7 1 2 7 8 5"}));
    show<2>("a surface in another plane",
            msh({"0 0 0", "1 0 0", "1 0 1", "0 0 1"}, {"3 2 7 1 1 2 3 4"}));
    show<2>("a plane at z = 3",
            msh({"0 0 3", "1 0 3", "1 1 3", "0 1 3"}, {"3 2 7 1 1 2 3 4"}));
    show<3>("a surface where a volume is wanted", msh(points, {left, right}));
  }

  void
  show_boxes()
  {
    const std::vector<std::string> corners = {"0 0 0",
                                              "1 0 0",
                                              "1 1 0",
                                              "0 1 0",
                                              "0 0 1",
                                              "1 0 1",
                                              "1 1 1",
                                              "0 1 1",
                                              "0 0 2",
                                              "1 0 2",
                                              "1 1 2",
                                              "0 1 2"};
    const std::string              lower   = "5 2 7 1 1 2 3 4 5 6 7 8",
                      upper                = "5 2 8 1 5 6 7 8 9 10 11 12";
    show<3>("two cubes", msh(corners, {lower, upper}));
    show<3>("one of them counted from the top",
            msh(corners, {lower, "5 2 8 1 9 10 11 12 5 6 7 8"}));
    show<3>(
      "named surfaces, one of them inside",
      msh(corners,
          {lower, upper, "3 2 1 1 1 2 3 4", "3 2 2 2 5 6 7 8", "1 2 9 1 1 2"},
          {"2 1 \"bottom\"", "2 2 \"joint\"", "1 9 \"edge\""}));
    show<3>("a face that belongs to no cell",
            msh(corners, {lower, "3 2 1 1 9 10 11 12"}, {"2 1 \"lid\""}));
    show<3>("a tetrahedron", msh(corners, {lower, "4 2 7 1 5 6 8 9"}));
    show<3>("a twisted cube", msh(corners, {"5 2 7 1 1 2 3 4 7 8 5 6"}));
    show<2>("a volume where a surface is wanted", msh(corners, {lower}));
  }

  void
  show_texts()
  {
    const std::string good = msh(points, {left, right});
    const auto with = [&](const std::string &before, const std::string &after) {
      std::string text = good;
      return text.replace(text.find(before), before.size(), after);
    };
    show<2>("no mesh", "once upon a time\n");
    show<2>("an empty file", "");
    show<2>("the oldest format", "$NOD\n1\n1 0 0 0\n$ENDNOD\n");
    show<2>("version 4.0", with("2.2 0 8", "4 0 8"));
    show<2>("a binary file", with("2.2 0 8", "2.2 1 8"));
    show<2>("no elements", good.substr(0, good.find("$Elements")));
    show<2>("nodes in the end",
            format + good.substr(good.find("$Elements")) +
              good.substr(format.size()));
    show<2>("cut short", good.substr(0, good.find("0 1 0")));
    show<2>("more nodes than there are", with("$Nodes\n6", "$Nodes\n7"));
    show<2>("far more of them", with("$Nodes\n6", "$Nodes\n2000000000"));
    show<2>("fewer", with("$Nodes\n6", "$Nodes\n5"));
    show<2>("a negative number of nodes", with("$Nodes\n6", "$Nodes\n-6"));
    show<2>("a node twice", with("\n2 1 0 0", "\n1 1 0 0"));
    show<2>("a node that is not there", with("1 2 5 4", "1 2 5 44"));
    show<2>("a coordinate that is no number", with("2 0 0", "nan 0 0"));
    show<2>("a comma in a number", with("2 0 0", "2,5 0 0"));
    show<2>("a kind of element that nobody knows", with("3 2 7", "99 2 7"));
    show<2>("a NUL byte", with("2 0 0", std::string("2\0 0 0", 6)));
    show<2>("two sections of nodes", good + good.substr(format.size()));
    show<2>("a name without quotes",
            msh(points, {left, right}, {"1 3 bottom"}));
  }
} // namespace

int
main()
{
  show_planes();
  show_boxes();
  show_texts();
  return 0;
}
