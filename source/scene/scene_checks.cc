#include <signoton/base/number.h>
#include <signoton/base/quoting.h>
#include <signoton/discretization/rigid_motions.h>
#include <signoton/scene/scene.h>

#include <deal.II/base/patterns.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <set>

// What a scene checks once it has its mesh, and its probes.

namespace Signoton
{
  template <int dim>
  void
  Scene<dim>::check_boundaries() const
  {
    if (model.analysis->has_inertia)
      return;
    for (const auto &condition : model.conditions)
      if (const std::string key = condition.dynamic_key(); !key.empty())
        throw UserError(model.file.where({"Boundaries", condition.name}, key),
                        "'" + key + "' with Analysis = statics",
                        "Analysis = dynamics",
                        "remove it, or 'set Analysis = dynamics'");
  }

  template <int dim>
  void
  Scene<dim>::check_materials() const
  {
    std::set<types::material_id> known;
    for (const auto &material : model.materials)
      if (!known.insert(material.id).second)
        throw UserError(model.file.where({"Materials", material.name},
                                         "Material id"),
                        "material id " + std::to_string(material.id) +
                          " for a second time",
                        "one material for each id",
                        "give the materials different ids");
    std::set<types::material_id> missing;
    for (const auto &cell : model.space->mesh.active_cell_iterators())
      if (cell->is_locally_owned() && known.count(cell->material_id()) == 0)
        missing.insert(cell->material_id());
    missing = Utilities::MPI::compute_set_union(missing, model.communicator);
    if (missing.empty())
      return;
    const auto in_words = [](const std::set<types::material_id> &ids) {
      std::vector<std::string> words;
      for (const auto id : ids)
        words.push_back(std::to_string(id));
      return join(words, ", ");
    };
    throw UserError(
      model.file.where({"Materials"}),
      "cells of the mesh with material id" +
        std::string(missing.size() > 1 ? "s " : " ") + in_words(missing) +
        ", which no material has",
      "a material for every id of the mesh; known are " + in_words(known),
      "add a material with 'set Material id = " + in_words({*missing.begin()}) +
        "'" + (missing.size() > 1 ? ", and the others" : ""));
  }

  template <int dim>
  void
  Scene<dim>::check_supports() const
  {
    const auto &space = *model.space;
    const auto  free  = free_rigid_motions(space.mapping,
                                         space.dof_handler,
                                         space.constraints,
                                         space.axisymmetric);
    if (!free.empty())
      throw UserError(model.file.where({"Boundaries"}),
                      "the body can move freely: " + join(free, "; "),
                      "supports that prevent every rigid motion",
                      "add 'Symmetry' or 'Displacement' at some boundary");
  }

  namespace
  {
    /** The center of a cell of this rank whose map is not one to one at its
     *  points, or nothing. On straight boundaries refinement folds no cell. */
    template <int dim>
    std::string
    folded_by_refinement(const Space<dim> &space)
    {
      if (space.mesh.get_manifold_ids() ==
          std::vector<types::manifold_id>{numbers::flat_manifold_id})
        return "";
      const FE_Nothing<dim> fe;
      FEValues<dim>         values(space.mapping,
                           fe,
                           QGauss<dim>(space.degree + 1),
                           update_jacobians);
      for (const auto &cell : space.mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            values.reinit(cell);
            for (const auto q : values.quadrature_point_indices())
              if (!(values.jacobian(q).determinant() > 0.))
                return "(" + Patterns::Tools::to_string(cell->center()) + ")";
          }
      return "";
    }
  } // namespace

  template <int dim>
  void
  Scene<dim>::check_mesh() const
  {
    const auto &space = *model.space;
    for (const auto &place :
         Utilities::MPI::all_gather(model.communicator,
                                    folded_by_refinement(space)))
      if (!place.empty())
        throw UserError(model.file.where({"Geometry"}),
                        "a mesh that folds along its curved boundary when it "
                        "is refined, around " +
                          place,
                        "cells that are convex at the boundary",
                        "another generator, more or finer coarse cells, or "
                        "less 'Initial refinement'");
    if (space.axisymmetric)
      {
        double lowest = 0., size = 0.;
        for (const auto &vertex : space.mesh.get_vertices())
          {
            lowest = std::min(lowest, vertex[0]);
            size   = std::max(size, vertex.norm());
          }
        if (Utilities::MPI::min(lowest, model.communicator) < -1e-10 * size)
          throw UserError(model.file.where({}, "Embedding"),
                          "a mesh that reaches to x = " + number_text(lowest),
                          "x >= 0: x is the distance from the axis",
                          "shift the mesh, or model one half of it");
      }
    std::map<types::boundary_id, std::string> first;
    for (const auto &condition : model.conditions)
      if (const auto [other, is_first] =
            first.emplace(condition.id, condition.name);
          !is_first)
        throw UserError(model.file.where({"Boundaries", condition.name}),
                        "a second name for the boundary '" + other->second +
                          "'",
                        "the conditions of a boundary in one subsection",
                        "see 'Geometry / Boundary names'");
  }

  template <int dim>
  void
  Scene<dim>::interpret_probes()
  {
    const std::string points_at = model.file.where({"Output"}, "Probe points");
    for (const auto &text :
         Utilities::split_string_list(model.output.probe_text, ';'))
      model.probes.push_back(parse_point<dim>(text, points_at));
    const std::string lines_at = model.file.where({"Output"}, "Probe lines");
    double            n_points = 0.;
    for (const auto &text :
         Utilities::split_string_list(model.output.transect_text, ';'))
      {
        const auto parts = Utilities::split_string_list(text, ':');
        int        n     = 0;
        try
          {
            n = parts.size() == 3 ? Utilities::string_to_int(parts[2]) : 0;
          }
        catch (const ExceptionBase &)
          {}
        if (n < 2)
          throw UserError(lines_at,
                          "'" + text + "'",
                          "'from : to : number of points', at least 2",
                          dim == 2 ? "for instance '0, 0 : 1, 0 : 200'" :
                                     "for instance '0, 0, 0 : 1, 0, 0 : 200'");
        n_points += n;
        if (n_points > 1e6)
          throw UserError(lines_at,
                          number_text(n_points) + " points up to '" + text +
                            "'",
                          "at most a million points on all lines",
                          "a line needs no more points than it meets cells");
        model.transects.push_back({parse_point<dim>(parts[0], lines_at),
                                   parse_point<dim>(parts[1], lines_at),
                                   static_cast<unsigned int>(n),
                                   nullptr});
      }
  }

  template <int dim>
  void
  Scene<dim>::check_probes()
  {
    const auto &space  = *model.space;
    const auto  locate = [&](const std::vector<Point<dim>> &points,
                            const std::string             &key) {
      return std::make_unique<PointLocator<dim>>(
        space,
        points,
        std::vector<std::string>{model.file.where({"Output"}, key)},
        PointLocator<dim>::Materials::apart,
        points_outside == "nearest");
    };
    if (!model.probes.empty())
      model.probe_points = locate(model.probes, "Probe points");
    for (auto &line : model.transects)
      line.places = locate(line.points(), "Probe lines");
    std::vector<Point<dim>>  force_points;
    std::vector<std::string> force_keys;
    for (const auto &force : model.point_forces)
      {
        force_points.push_back(force.place);
        force_keys.push_back(
          model.file.where({"Point forces", force.name}, "Point"));
      }
    if (!force_points.empty())
      model.force_points = std::make_unique<PointLocator<dim>>(
        space,
        force_points,
        force_keys,
        PointLocator<dim>::Materials::together,
        points_outside == "nearest");
    for (const auto &item : split_unquoted(model.output.surface_text, ','))
      model.probe_surfaces.emplace_back(
        unquoted(item),
        boundary_id_of(unquoted(item),
                       space.boundary.names,
                       model.file.where({"Output"}, "Probe surfaces")));
  }

#define INSTANTIATE(dim)                              \
  template void Scene<dim>::check_boundaries() const; \
  template void Scene<dim>::check_materials() const;  \
  template void Scene<dim>::check_supports() const;   \
  template void Scene<dim>::check_mesh() const;       \
  template void Scene<dim>::check_probes();           \
  template void Scene<dim>::interpret_probes();

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
