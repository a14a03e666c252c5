#include <signoton/base/quoting.h>
#include <signoton/discretization/curved_geometry.h>
#include <signoton/discretization/geometry.h>
#include <signoton/discretization/gmsh_process.h>
#include <signoton/discretization/mesh_reader.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

// A coarse mesh from a file.

namespace Signoton
{
  namespace
  {
    /** What a mesh file holds as text, or why it has none. */
    struct MeshText
    {
      std::string    text, problem;
      CurvedElements curved = {};
    };

    MeshText
    read_file(const std::string &path)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      const auto      size = fs::file_size(path, error);
      if (!fs::is_regular_file(path, error))
        return {"", fs::exists(path, error) ? "no file" : "no such file"};
      if (size > 2000000000)
        return {"", "more than 2 GB, which is too much for a coarse mesh"};
      std::ostringstream text;
      if (size > 0 && !(text << std::ifstream(path, std::ios::binary).rdbuf()))
        return {"", "it cannot be read"};
      return {text.str(), size == 0 ? "an empty file" : ""};
    }

    /** What the first rank finds, on all of them. */
    MeshText
    on_first_rank(const MPI_Comm                  &communicator,
                  const std::function<MeshText()> &find)
    {
      MeshText result;
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        try
          {
            result = find();
          }
        catch (const std::exception &error) // the other ranks wait
          {
            result = {"", error.what()};
          }
      result.problem = Utilities::MPI::broadcast(communicator, result.problem);
      result.text    = Utilities::MPI::broadcast(communicator, result.text);
      result.curved  = Utilities::MPI::broadcast(communicator, result.curved);
      return result;
    }

    /** Say which named faces are no boundary; refuse it if the scene
     *  prescribes something at a name that has no others. */
    void
    report_inside(const SceneFile          &file,
                  const BoundaryGroups     &groups,
                  const std::string        &kind,
                  std::vector<std::string> &notes)
    {
      const auto used = file.subsections({"Boundaries"});
      for (const auto &[name, counts] : groups.inside)
        {
          const std::string inside =
            "'" + name + "', " + std::to_string(counts.first) + " of whose " +
            std::to_string(counts.second) + " " + kind + " lie inside the body";
          notes.push_back(inside + ", where they are no boundary");
          if (groups.names.count(name) == 0 &&
              std::find(used.begin(), used.end(), name) != used.end())
            throw UserError(file.where({"Boundaries", name}),
                            inside,
                            "a part of the boundary",
                            "prescribe nothing there, or cut the mesh open");
        }
    }
    /** Give the mesh the shape of its elements, and say where facets are all
     *  that is known of what looks like a curve. */
    template <int dim>
    void
    follow_curves(const CurvedElements     &elements,
                  const bool                corners_will_move,
                  const BoundaryGroups     &groups,
                  Triangulation<dim>       &mesh,
                  std::vector<std::string> &notes)
    {
      if (elements.order == 1)
        return;
      if (!corners_will_move)
        {
          const CurvedGeometry<dim> shape(elements, mesh);
          if (const auto folded = shape.attach(mesh); !folded.empty())
            {
              std::ostringstream text;
              text << folded.size() << " cells, the first around ("
                   << folded.front()
                   << "), would fold on curved edges, so that all edges are "
                      "straight, refined or not; mesh the curves finer";
              notes.push_back(text.str());
            }
        }
      const auto facets = find_facets(mesh);
      for (const auto &[name, id] : groups.names)
        if (const auto kinks = facets.find(id); kinks != facets.end())
          {
            std::ostringstream text;
            text << "boundary '" << name << "' has facets that meet at "
                 << std::lround(kinks->second.smallest * 10.) / 10. << " to "
                 << std::lround(kinks->second.largest * 10.) / 10.
                 << " degrees, and refinement keeps them; curves are kept from "
                    "a .geo file";
            notes.push_back(text.str());
          }
    }
  } // namespace

  template <int dim>
  BoundaryNames
  Geometry::read(const SceneFile          &file,
                 const MPI_Comm           &communicator,
                 Triangulation<dim>       &mesh,
                 std::vector<std::string> &notes) const
  {
    namespace fs                  = std::filesystem;
    const std::string mesh_file   = unquoted(this->mesh_file);
    const fs::path    given       = mesh_file;
    const std::string path        = given.is_absolute() ?
                                      mesh_file :
                                      (fs::path(file.directory()) / given).string();
    const bool        is_geometry = given.extension() == ".geo";
    const auto        refuse      = [&](const std::string &found,
                            const std::string &try_this) {
      throw UserError(file.where({"Geometry"}, "Mesh file"),
                      "'" + path + "': " + found,
                      "a gmsh file of " +
                        std::string(dim == 2 ? "quadrilaterals" : "hexahedra"),
                      try_this);
    };

    const MeshText result = on_first_rank(communicator, [&]() -> MeshText {
      const MeshText text = read_file(path);
      if (!is_geometry || !text.problem.empty())
        return text;
      const auto meshed = mesh_geometry(fs::absolute(path).string(),
                                        dim,
                                        trust_geometry,
                                        {meshing_time, 1e9 * meshing_memory});
      return {meshed.text, meshed.problem, meshed.curved};
    });
    if (!result.problem.empty())
      refuse(result.problem,
             is_geometry ?
               "mend the geometry, or raise 'Meshing time limit' and 'Meshing "
               "memory limit'; --trust-geometry lets it execute programs and "
               "write files" :
               "check the name, relative to the scene file");
    try
      {
        const auto groups =
          make_mesh<dim>(MshFile(result.text), !is_geometry, mesh);
        report_inside(file, groups, dim == 2 ? "edges" : "faces", notes);
        follow_curves(result.curved, distortion > 0., groups, mesh, notes);
        return groups.names;
      }
    catch (const MeshError &error)
      {
        refuse(error.what(), error.try_this);
      }
    return {};
  }

  template BoundaryNames
  Geometry::read<2>(const SceneFile &,
                    const MPI_Comm &,
                    Triangulation<2> &,
                    std::vector<std::string> &) const;
  template BoundaryNames
  Geometry::read<3>(const SceneFile &,
                    const MPI_Comm &,
                    Triangulation<3> &,
                    std::vector<std::string> &) const;
} // namespace Signoton
