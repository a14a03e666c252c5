#include <signoton/base/sandbox.h>
#include <signoton/discretization/gmsh_process.h>

#include <deal.II/base/utilities.h>

#include <boost/serialization/utility.hpp>

#include <gmsh.h>

#include <new>
#include <sstream>
#include <stdexcept>

namespace Signoton
{
  namespace
  {
    /** The elements of a dimension that are part of the mesh, a line each.
     *  @return their number */
    std::size_t
    write_elements(const int           dim,
                   const bool          only_groups,
                   const std::size_t   n_before,
                   std::ostringstream &out)
    {
      // entities by group; group 0 is none
      std::vector<std::pair<int, int>> entities;
      gmsh::vectorpair                 groups, all;
      gmsh::model::getPhysicalGroups(groups, dim);
      for (const auto &[group_dim, group] : groups)
        {
          std::vector<int> members;
          gmsh::model::getEntitiesForPhysicalGroup(group_dim, group, members);
          for (const int entity : members)
            entities.emplace_back(entity, group);
        }
      if (groups.empty() && !only_groups)
        {
          gmsh::model::getEntities(all, dim);
          for (const auto &[entity_dim, entity] : all)
            entities.emplace_back(entity, 0);
        }

      std::size_t n = n_before;
      for (const auto &[entity, group] : entities)
        {
          std::vector<int>                      types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
          for (std::size_t t = 0; t < types.size(); ++t)
            for (std::size_t e = 0; e < tags[t].size(); ++e)
              {
                const std::size_t per_element =
                  nodes[t].size() / tags[t].size();
                out << ++n << ' ' << types[t] << " 2 " << group << ' '
                    << entity;
                for (std::size_t i = 0; i < per_element; ++i)
                  out << ' ' << nodes[t][e * per_element + i];
                out << '\n';
              }
        }
      return n - n_before;
    }

    /** The mesh of the current model as a .msh file. gmsh::write() would need
     *  a file. */
    std::string
    msh_text(const int dim)
    {
      std::ostringstream out, elements;
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

      std::vector<std::string> names;
      gmsh::vectorpair         groups;
      gmsh::model::getPhysicalGroups(groups);
      for (const auto &[group_dim, group] : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(group_dim, group, name);
          if (!name.empty())
            names.push_back(std::to_string(group_dim) + ' ' +
                            std::to_string(group) + " \"" + name + "\"\n");
        }
      out << "$PhysicalNames\n" << names.size() << '\n';
      for (const auto &name : names)
        out << name;
      out << "$EndPhysicalNames\n";

      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      out << "$Nodes\n" << tags.size() << '\n';
      for (std::size_t i = 0; i < tags.size(); ++i)
        out << tags[i] << ' ' << coordinates[3 * i] << ' '
            << coordinates[3 * i + 1] << ' ' << coordinates[3 * i + 2] << '\n';
      out << "$EndNodes\n";

      std::size_t n = 0;
      for (int d = dim - 1; d <= 3; ++d)
        n += write_elements(d, d != dim, n, elements);
      out << "$Elements\n" << n << '\n' << elements.str() << "$EndElements\n";
      return out.str();
    }

    /** What gmsh said that a mesh must not hide. Its own words for a program
     *  that it was to execute are those of its log. */
    std::string
    complaint(const bool trusted)
    {
      std::vector<std::string> log;
      gmsh::logger::get(log);
      const std::string error = "Error: ", call = "Info: Calling '";
      for (const auto &line : log)
        if (line.rfind(error, 0) == 0)
          return "gmsh says: " + line.substr(error.size());
        else if (!trusted && line.rfind(call, 0) == 0)
          return "it would execute a program, '" + line.substr(call.size());
      return "";
    }

    std::string
    run_gmsh(const std::string &file, const int dim, const bool trusted)
    {
      gmsh::initialize(0, nullptr, false);
      gmsh::option::setNumber("General.Terminal", 0);
      gmsh::logger::start();
      if (!trusted)
        if (const std::string why = forbid_side_effects(); !why.empty())
          throw std::runtime_error(
            "it cannot be kept from executing programs here: " + why);
      std::pair<std::string, CurvedElements> mesh;
      std::string                            failure;
      try
        {
          gmsh::open(file);
          gmsh::model::mesh::generate(dim);
          gmsh::model::mesh::setOrder(1);
          mesh.first = msh_text(dim);
        }
      catch (const std::bad_alloc &)
        {
          throw;
        }
      catch (...) // gmsh throws integers or strings, by version
        {
          gmsh::logger::getLastError(failure);
          failure = "gmsh says: " + (failure.empty() ? "error" : failure);
        }
      if (const std::string said = complaint(trusted); !said.empty())
        failure = said;
      if (!failure.empty())
        throw std::runtime_error(failure);
      try
        {
          mesh.second =
            dim == 2 ? sample_gmsh_curves<2>() : sample_gmsh_curves<3>();
        }
      catch (...) // the mesh is as good as before
        {}
      const std::vector<char> packed = dealii::Utilities::pack(mesh, false);
      return std::string(packed.begin(), packed.end());
    }
  } // namespace

  GmshMesh
  mesh_geometry(const std::string &file,
                const int          dim,
                const bool         trusted,
                const ChildLimits &limits)
  {
    const ChildResult result =
      run_in_child([&]() { return run_gmsh(file, dim, trusted); }, limits);
    if (!result.problem.empty())
      return {"", {}, result.problem};
    const auto [text, curved] =
      dealii::Utilities::unpack<std::pair<std::string, CurvedElements>>(
        std::vector<char>(result.answer.begin(), result.answer.end()), false);
    return {text, curved, ""};
  }
} // namespace Signoton
