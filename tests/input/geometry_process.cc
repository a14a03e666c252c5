// Geometries of gmsh that exit, never end, crash, take all memory, execute
// programs and write files: each comes back with words, and nothing in the
// world has changed.

#include "verdicts.h"

#include <signoton/base/mpi_session.h>
#include <signoton/discretization/gmsh_process.h>
#include <signoton/discretization/mesh_reader.h>


#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>

using namespace Signoton;
namespace fs = std::filesystem;

namespace
{
  Verdicts verdict;

  const std::string square = R"(
n = 2;
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = n + 1; Transfinite Surface {1};
Recombine Surface {1};
Physical Curve("0") = {1}; Physical Surface("body", 7) = {1};
)";

  std::string
  contents(const fs::path &file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  /** The files below a directory with what is in them. */
  std::map<std::string, std::string>
  listing(const fs::path &directory)
  {
    std::map<std::string, std::string> files;
    for (const auto &entry : fs::recursive_directory_iterator(directory))
      files[entry.path().string()] =
        entry.is_regular_file() ? contents(entry.path()) : "";
    return files;
  }

  GmshMesh
  mesh(const std::string &geometry,
       const bool         trusted = false,
       const ChildLimits &limits  = {})
  {
    std::ofstream("work/try.geo") << geometry << "\n";
    return mesh_geometry(fs::absolute("work/try.geo").string(),
                         2,
                         trusted,
                         limits);
  }

  void
  expect(const std::string &what,
         const std::string &geometry,
         const std::string &words,
         const ChildLimits &limits = {})
  {
    const auto result = mesh(geometry, false, limits);
    const bool good =
      result.text.empty() && result.problem.find(words) != std::string::npos;
    verdict(what + ": '" + words + "'", good);
    if (!good)
      std::cerr << what << ": '" << result.problem << "'\n";
  }

  void
  try_good_ones()
  {
    const auto plain = mesh(square);
    verdict("a square is meshed", plain.problem.empty());
    Triangulation<2> triangulation;
    const auto groups = make_mesh<2>(MshFile(plain.text), false, triangulation);
    verdict("with 4 cells of group 7",
            triangulation.n_active_cells() == 4 &&
              triangulation.begin_active()->material_id() == 7);
    verdict("and a part of the boundary called 0",
            groups.names.size() == 1 && groups.names.count("0") == 1);
    verdict("which is not that of faces without a group",
            groups.names.begin()->second != 0 &&
              triangulation.get_boundary_ids().size() == 2);
    verdict("a geometry of second order gives corners alone",
            mesh("Mesh.ElementOrder = 2;" + square).text == plain.text);
    verdict("the text is the same when it prints",
            mesh("General.Terminal = 1; Printf(\"noise\");" + square).text ==
              plain.text);
    std::ofstream("work/part.geo") << square;
    verdict("a file that it includes is read",
            mesh("Include \"part.geo\";").text == plain.text);
  }

  void
  try_curves()
  {
    verdict("straight edges need no points but corners",
            mesh(square).curved.order == 1);
    // a cell between a quarter of a circle and one of an ellipse
    const auto ring =
      mesh("Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {3, 0, 0};"
           "Point(4) = {0, 2, 0}; Point(5) = {0, 1, 0}; Line(1) = {2, 3};"
           "Ellipse(2) = {3, 1, 3, 4}; Line(3) = {4, 5}; Circle(4) = {5, 1, 2};"
           "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};"
           "Transfinite Curve {1:4} = 2; Transfinite Surface {1};"
           "Recombine Surface {1};");
    const auto  &points    = ring.curved.coordinates;
    unsigned int on_circle = 0, on_ellipse = 0;
    for (std::size_t i = 0; i + 1 < points.size(); i += 2)
      {
        const double x = points[i], y = points[i + 1];
        on_circle += std::abs(std::hypot(x, y) - 1.) < 1e-8;
        on_ellipse += std::abs(std::hypot(x / 3., y / 2.) - 1.) < 1e-8;
      }
    verdict("curves are given by points on them",
            ring.curved.order == 6 && points.size() == 2 * 49 &&
              on_circle == 7 && on_ellipse == 7);
    Triangulation<2> triangulation;
    make_mesh<2>(MshFile(ring.text), false, triangulation);
    verdict("and the mesh by its corners",
            triangulation.n_active_cells() == 1 &&
              triangulation.n_vertices() == 4);
  }

  void
  try_bad_ones()
  {
    expect("Exit", "Exit;" + square, "it ended without a result");
    expect("Error",
           "Error(\"no such stone\");" + square,
           "gmsh says: no such stone");
    expect("a mistake", "Pint(1) = {0};" + square, "line 1: syntax error");
    expect("a mistake further down",
           square + "\nPint(1) = {0};",
           "syntax error");
    expect("a file that is not there",
           "Include \"nowhere.geo\";",
           "Unable to open file");
    expect("a CAD file that is not there",
           "Merge \"nowhere.step\";",
           "Unable to open file");
    ChildLimits limits;
    limits.seconds = 0.5;
    expect("an endless loop",
           "For i In {0:1e15}\n x = i;\nEndFor\n" + square,
           "it took more than 0.5 s",
           limits);
    limits.seconds = 30.;
    limits.bytes   = 2e8;
    expect("a huge mesh",
           "n = 30000;" + square.substr(square.find("Point(1)")),
           "more than 0.2 GB",
           limits);
    expect("a macro that calls itself",
           "Macro again\nCall again;\nReturn\nCall again;" + square,
           "it ",
           limits);
  }

  void
  try_hostile_ones()
  {
    const std::string here = fs::absolute("work").string();
    std::ofstream("work/kept") << "as it was\n";
    std::ofstream("work/system.geo")
      << "SystemCall \"touch " << here << "/new1\";" << square;
    fs::remove("work/try.geo");
    const auto before = listing("work");
    expect("SystemCall", contents("work/system.geo"), "");
    expect("NonBlockingSystemCall",
           "NonBlockingSystemCall \"touch " + here + "/new2\";" + square,
           "");
    expect("OnelabRun",
           "OnelabRun(\"it\", \"touch " + here + "/new3\");" + square,
           "");
    expect("SystemCall in a file that is included",
           "Include \"system.geo\";",
           "");
    expect("Printf to a file",
           "Printf(\"x\") > \"" + here + "/new4\";" + square,
           "line 1: Unable to open file");
    expect("Printf over a file",
           "Printf(\"x\") > \"kept\";" + square,
           "Unable to open file");
    expect("Printf behind a file",
           "Printf(\"x\") >> \"kept\";" + square,
           "Unable to open file");
    expect("Save", square + "Save \"new5.msh\";", "Unable to open file");
    expect("Save over a file", square + "Mesh 2; Save \"kept\";", "gmsh says");
    fs::remove("work/try.geo");
    auto now = listing("work");
    verdict("nothing has changed in the directory", now == before);

    const auto trusted =
      mesh("SystemCall \"touch " + here + "/new6\";" + square, true);
    verdict("a trusted geometry executes what it likes",
            trusted.problem.empty() && fs::exists("work/new6"));
  }
} // namespace

int
main(int argc, char **argv)
{
  MPISession mpi(argc, argv);
  fs::remove_all("work");
  fs::create_directory("work");
  try_good_ones();
  try_curves();
  try_bad_ones();
  try_hostile_ones();
  return verdict.status();
}
