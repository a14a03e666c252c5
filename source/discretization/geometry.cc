#include <signoton/base/function.h>
#include <signoton/base/memory.h>
#include <signoton/base/number.h>
#include <signoton/base/quoting.h>
#include <signoton/discretization/geometry.h>
#include <signoton/discretization/mesh_reader.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold_lib.h>

#include <new>
#include <set>
#include <sstream>

namespace Signoton
{
  namespace
  {
    const SceneFile::Path section = {"Geometry"};

    /** What the mesh and the numbers of its unknowns take (peak of --explain, by
     *  cells). */
    template <int dim>
    constexpr double bytes_per_cell = dim == 2 ? 700. : 1600.;

    /** Names of the boundary ids that deal.II gives to colorized boxes and
     *  shells, so that common scenes need not list them. */
    BoundaryNames
    default_names(const std::string &generator, const int dim)
    {
      if (generator == "hyper_cube" || generator == "hyper_rectangle" ||
          generator == "subdivided_hyper_rectangle")
        return dim == 2 ? BoundaryNames{{"left", 0},
                                        {"right", 1},
                                        {"bottom", 2},
                                        {"top", 3}} :
                          BoundaryNames{{"left", 0},
                                        {"right", 1},
                                        {"front", 2},
                                        {"back", 3},
                                        {"bottom", 4},
                                        {"top", 5}};
      if (generator == "quarter_hyper_shell")
        return dim == 2 ? BoundaryNames{{"inner", 0},
                                        {"outer", 1},
                                        {"plane x", 2},
                                        {"plane y", 3}} :
                          BoundaryNames{{"inner", 0},
                                        {"outer", 1},
                                        {"plane x", 2},
                                        {"plane y", 3},
                                        {"plane z", 4}};
      return {};
    }

    /** `name: rest; name: rest` */
    std::vector<std::pair<std::string, std::string>>
    parse_list(const std::string &text,
               const std::string &where,
               const std::string &expected)
    {
      std::vector<std::pair<std::string, std::string>> result;
      for (const auto &item : split_unquoted(text, ';'))
        {
          const auto colon = find_unquoted(item, ':');
          if (colon == std::string::npos)
            throw UserError(where,
                            "'" + item + "'",
                            expected,
                            "put a colon after the name and ';' between "
                            "items");
          result.emplace_back(unquoted(Utilities::trim(item.substr(0, colon))),
                              unquoted(
                                Utilities::trim(item.substr(colon + 1))));
        }
      return result;
    }

    std::string
    cells_of(const int dim)
    {
      return dim == 2 ? "quadrilaterals" : "hexahedra";
    }

    bool
    is_number(const std::string &text)
    {
      return !text.empty() &&
             text.find_first_not_of("0123456789") == std::string::npos;
    }

    /** An id written as a number; ids have up to nine digits here. */
    unsigned int
    parse_id(const std::string &text, const std::string &where)
    {
      if (text.size() > 9)
        throw UserError(where,
                        "'" + text + "'",
                        "an id with at most nine digits",
                        "see the ids in the mesh");
      return std::stoul(text);
    }

    /** A name that no part of the boundary has yet. */
    std::string
    free_name(const BoundaryNames &names, const std::string &wanted)
    {
      std::string name = wanted;
      for (unsigned int n = 2; names.count(name) > 0; ++n)
        name = wanted + " " + std::to_string(n);
      return name;
    }

    template <int dim>
    unsigned int
    count_faces(const Triangulation<dim> &mesh, const types::boundary_id id)
    {
      unsigned int n = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          n += face->at_boundary() && face->boundary_id() == id;
      return n;
    }

    /** Give names to the parts of the boundary that have none. A condition may
     *  have taken all faces of another part. */
    template <int dim>
    void
    name_the_rest(const Triangulation<dim> &mesh,
                  const bool                from_file,
                  BoundaryNames            &names,
                  std::vector<std::string> &notes)
    {
      const auto left = mesh.get_boundary_ids();
      for (auto entry = names.begin(); entry != names.end();)
        entry =
          std::find(left.begin(), left.end(), entry->second) == left.end() ?
            names.erase(entry) :
            std::next(entry);
      for (const auto id : left)
        if (std::none_of(names.begin(), names.end(), [id](const auto &entry) {
              return entry.second == id;
            }))
          {
            const bool        no_group = id == 0 && from_file;
            const std::string name =
              free_name(names, no_group ? "unnamed" : std::to_string(id));
            names[name] = id;
            if (no_group)
              notes.push_back(std::to_string(count_faces(mesh, id)) +
                              " faces of the boundary belong to no group, "
                              "they are called '" +
                              name + "'");
          }
    }

    /** Let transfinite interpolations refer to a coarse mesh that was copied:
     *  they look their cells up, and know those they were made for. */
    template <int dim>
    void
    renew_interpolations(const Triangulation<dim> &original,
                         Triangulation<dim>       &mesh)
    {
      using Interpolation = TransfiniteInterpolationManifold<dim>;
      std::vector<types::manifold_id> ids;
      for (const auto id : original.get_manifold_ids())
        if (id != numbers::flat_manifold_id &&
            dynamic_cast<const Interpolation *>(&original.get_manifold(id)))
          ids.push_back(id);
      // a new one looks at the cells as they are without it
      for (const auto id : ids)
        mesh.set_manifold(id, FlatManifold<dim>());
      for (const auto id : ids)
        {
          Interpolation inside;
          inside.initialize(mesh);
          mesh.set_manifold(id, inside);
        }
    }
  } // namespace

  void
  Geometry::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Geometry");
    handler.add_parameter("Generator",
                          generator,
                          "Name of a function of deal.II's GridGenerator.");
    handler.add_parameter("Arguments",
                          arguments,
                          "Its arguments in order, separated by ':'; the "
                          "coordinates of a point by ','.");
    handler.add_parameter("Mesh file",
                          mesh_file,
                          "A gmsh file, .msh or .geo, of quadrilaterals or "
                          "hexahedra, instead of a generator; relative to "
                          "the scene file. Physical groups name the "
                          "boundaries; faces without a group are 'unnamed'. "
                          "Curves and surfaces of a .geo file are kept when "
                          "the mesh is refined, as polynomials of degree 6 "
                          "in each coarse cell (4 and 2 if there are more "
                          "than 2000 and 20000 cells); edges of a .msh file "
                          "are straight.");
    handler.add_parameter("Meshing time limit",
                          meshing_time,
                          "Seconds that gmsh may take for a .geo file.",
                          Patterns::Double(1e-3));
    handler.add_parameter("Meshing memory limit",
                          meshing_memory,
                          "Gigabytes that gmsh may take for a .geo file.",
                          Patterns::Double(1e-3));
    handler.add_parameter(
      "Boundary names",
      boundary_names,
      "Names for parts of the boundary, 'name: id; name: condition'; a name "
      "with ':' or ';' in double quotes. A "
      "condition in x, y, z selects the faces of the coarse mesh whose center "
      "fulfills it, for instance 'plate: y > 0.99 && x < 0.5'. Boxes and "
      "quarter shells have names already: left, right, (front, back,) bottom, "
      "top; inner, outer, plane x (where x = 0), plane y(, plane z).");
    handler.add_parameter("Material ids",
                          material_ids,
                          "Material ids by position, 'id: condition; ...' "
                          "for the centers of the coarse cells.");
    handler.add_parameter("Periodic boundaries",
                          periodic,
                          "Pairs of opposite boundaries, 'left: right; "
                          "front: back', that move alike.");
    handler.add_parameter("Initial refinement",
                          initial_refinement,
                          "Number of uniform refinements of the coarse mesh.",
                          Patterns::Integer(0, 12));
    handler.add_parameter("Distortion",
                          distortion,
                          "Random shift of inner vertices of the coarse mesh "
                          "as a part of the edge length, to test a "
                          "discretization.",
                          Patterns::Double(0., 0.4));
    handler.leave_subsection();
  }

  template <int dim>
  void
  Geometry::generate(const SceneFile &file, Triangulation<dim> &mesh) const
  {
    // the default arguments are those of the default generator
    const std::string arguments =
      file.has(section, "Generator") && !file.has(section, "Arguments") ?
        "" :
        this->arguments;
    const auto refuse = [&](const std::string &found) {
      throw UserError(
        file.where(section, "Generator"),
        "'" + generator + "' with arguments '" + arguments + "', " + found,
        "a function of deal.II's GridGenerator for " + std::to_string(dim) +
          "D and all its arguments without default",
        "compare the manual of GridGenerator: ':' separates arguments, ',' "
        "coordinates, and booleans are 'true' or 'false'");
    };
    try
      {
        GridGenerator::generate_from_name_and_arguments(mesh,
                                                        generator,
                                                        arguments);
      }
    catch (const ExceptionBase &error)
      {
        std::ostringstream details;
        error.print_info(details);
        refuse(
          "refused by deal.II" +
          (details.str().empty() ? "" : ": " + Utilities::trim(details.str())));
      }
    catch (const std::bad_alloc &)
      {
        refuse("for which there is not enough memory");
      }
    catch (const std::exception &)
      {
        refuse("refused by deal.II");
      }
    if (mesh.n_levels() != 1 || !mesh.all_reference_cells_are_hyper_cube())
      refuse("which is no coarse mesh of " + cells_of(dim));
    if (const std::string folded = folded_cell(mesh); !folded.empty())
      refuse("with a folded or inverted cell around " + folded);
  }

  template <int dim>
  void
  Geometry::apply_names(const SceneFile          &file,
                        const Constants          &constants,
                        Triangulation<dim>       &mesh,
                        BoundaryNames            &names,
                        std::vector<std::string> &notes) const
  {
    const std::string            where = file.where(section, "Boundary names");
    std::set<types::boundary_id> used;
    for (const auto id : mesh.get_boundary_ids())
      used.insert(id);
    for (const auto &[name, what] :
         parse_list(boundary_names, where, "'name: id' or 'name: condition'"))
      {
        if (is_number(what))
          {
            names[name] = parse_id(what, where);
            if (used.count(names[name]) == 0)
              throw UserError(where,
                              "'" + name + ": " + what +
                                "', an id that the boundary does not have",
                              "one of the ids of the mesh",
                              "leave it out, or select faces by a condition");
            continue;
          }
        types::boundary_id id = 100;
        while (used.count(id) > 0)
          ++id;
        used.insert(id);
        const auto   condition = make_function<dim>({what}, constants, where);
        unsigned int n_faces   = 0;
        for (const auto &cell : mesh.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && condition->value(face->center()) != 0.)
              {
                face->set_boundary_id(id);
                ++n_faces;
              }
        if (n_faces == 0)
          throw UserError(where,
                          "'" + name + ": " + what +
                            "', which no face of the coarse mesh fulfills",
                          "a condition that holds at the centers of some "
                          "boundary faces",
                          "make the coarse mesh fine enough to resolve it");
        names[name] = id;
      }
    name_the_rest(mesh, !mesh_file.empty(), names, notes);
  }

  template <int dim>
  void
  Geometry::apply_material_ids(const SceneFile    &file,
                               const Constants    &constants,
                               Triangulation<dim> &mesh) const
  {
    const std::string where = file.where(section, "Material ids");
    for (const auto &[id, condition_text] :
         parse_list(material_ids, where, "'id: condition'"))
      {
        if (!is_number(id))
          throw UserError(where,
                          "'" + id + "'",
                          "a material id, a number from 0",
                          "'1: y > 0.5; 2: x > 0.5'");
        const auto material = parse_id(id, where);
        const auto condition =
          make_function<dim>({condition_text}, constants, where);
        for (const auto &cell : mesh.active_cell_iterators())
          if (condition->value(cell->center()) != 0.)
            cell->set_material_id(material);
      }
  }

  template <int dim>
  std::vector<PeriodicPair>
  Geometry::find_periodic_pairs(const SceneFile          &file,
                                const Triangulation<dim> &mesh,
                                const BoundaryNames      &names) const
  {
    const std::string where  = file.where(section, "Periodic boundaries");
    const auto        center = [&](const types::boundary_id id) {
      Point<dim>   sum;
      unsigned int n = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == id)
            {
              sum += face->center();
              ++n;
            }
      return sum / std::max(n, 1U);
    };
    std::vector<PeriodicPair> pairs;
    for (const auto &[first, second] :
         parse_list(periodic, where, "'left: right'"))
      {
        for (const std::string &name : {first, second})
          if (names.count(name) == 0)
            throw UserError(where,
                            "unknown boundary '" + name + "'",
                            "names of boundaries",
                            "see 'Geometry / Boundary names'");
        const Tensor<1, dim> shift =
          center(names.at(second)) - center(names.at(first));
        unsigned int direction = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(shift[d]) > std::abs(shift[direction]))
            direction = d;
        if (!(std::abs(shift[direction]) > 0.999 * shift.norm()) ||
            first == second)
          throw UserError(where,
                          "'" + first + ": " + second +
                            "', which do not face each other along an axis",
                          "two boundaries that a shift in x, y or z maps onto "
                          "each other",
                          "'left: right'");
        pairs.push_back({names.at(first), names.at(second), direction});
      }
    return pairs;
  }

  template <int dim>
  BoundaryParts
  Geometry::create(const SceneFile                           &file,
                   const Constants                           &constants,
                   parallel::distributed::Triangulation<dim> &mesh,
                   std::vector<std::string>                  &notes) const
  {
    if (!mesh_file.empty() && file.has(section, "Generator"))
      throw UserError(file.where(section, "Mesh file"),
                      "both a mesh file and a generator",
                      "one of them",
                      "remove the other");
    // The coarse mesh is finished on a serial mesh: a distributed one must
    // not change between creation and refinement.
    Triangulation<dim> coarse;
    BoundaryParts      parts;
    if (mesh_file.empty())
      {
        generate(file, coarse);
        // colorized boxes come with a material id for each octant
        for (const auto &cell : coarse.active_cell_iterators())
          cell->set_material_id(0);
        const auto ids = coarse.get_boundary_ids();
        for (const auto &[name, id] : default_names(generator, dim))
          if (std::find(ids.begin(), ids.end(), id) != ids.end())
            parts.names[name] = id;
      }
    else
      parts.names = read(file, mesh.get_communicator(), coarse, notes);
    apply_material_ids(file, constants, coarse);
    apply_names(file, constants, coarse, parts.names, notes);
    parts.periodic = find_periodic_pairs(file, coarse, parts.names);
    if (distortion > 0.)
      GridTools::distort_random(distortion, coarse, true);
    mesh.copy_triangulation(coarse);
    renew_interpolations(coarse, mesh);

    std::vector<GridTools::PeriodicFacePair<
      typename parallel::distributed::Triangulation<dim>::cell_iterator>>
      faces;
    try
      {
        for (const auto &pair : parts.periodic)
          GridTools::collect_periodic_faces(
            mesh, pair.first, pair.second, pair.direction, faces);
      }
    catch (const ExceptionBase &)
      {
        throw UserError(file.where(section, "Periodic boundaries"),
                        "'" + periodic + "', whose faces do not match",
                        "boundaries with the same faces, shifted",
                        "compare the meshes of both boundaries");
      }
    if (!faces.empty())
      mesh.add_periodicity(faces);
    const double n_cells = std::ldexp(double(mesh.n_global_active_cells()),
                                      dim * initial_refinement);
    require_memory(mesh.get_communicator(),
                   bytes_per_cell<dim> * n_cells /
                     Utilities::MPI::n_mpi_processes(mesh.get_communicator()),
                   file.where(section, "Initial refinement"),
                   "a mesh of " + number_text(n_cells) + " cells",
                   "fewer refinements, or more machines");
    mesh.refine_global(initial_refinement);
    return parts;
  }

  template BoundaryParts
  Geometry::create<2>(const SceneFile &,
                      const Constants &,
                      parallel::distributed::Triangulation<2> &,
                      std::vector<std::string> &) const;
  template BoundaryParts
  Geometry::create<3>(const SceneFile &,
                      const Constants &,
                      parallel::distributed::Triangulation<3> &,
                      std::vector<std::string> &) const;
} // namespace Signoton
