#include <signoton/discretization/point_locator.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/numerics/rtree.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <iostream>
#include <sstream>

namespace Signoton
{
  namespace
  {
    /** In unit coordinates of a cell: round-off, and what is on a face. */
    constexpr double tolerance = 1e-6;

    /** Points outside by less than this part of a cell are typed with a digit
     *  less than the boundary has. */
    constexpr double typed = 1e-3;

    /** By more than this part of the coarse cell that a point was in, no
     *  boundary moves as it is refined. */
    constexpr double reach = 0.25;

    /** What the vertices of a cell enclose, and some distance more. */
    template <int dim>
    BoundingBox<dim>
    box_around(const typename Triangulation<dim>::cell_iterator &cell,
               const double                                      more)
    {
      BoundingBox<dim> box = cell->bounding_box();
      box.extend(more);
      return box;
    }

    template <int dim>
    double
    distance_to(const BoundingBox<dim> &box, const Point<dim> &p)
    {
      Tensor<1, dim> way;
      for (unsigned int d = 0; d < dim; ++d)
        way[d] =
          std::max({box.lower_bound(d) - p[d], 0., p[d] - box.upper_bound(d)});
      return way.norm();
    }

    template <int dim>
    bool
    takes(const typename Triangulation<dim>::cell_iterator &cell,
          const types::material_id                          material)
    {
      return material == numbers::invalid_material_id ||
             material == cell->material_id();
    }

    /** The closest point of a face, in unit coordinates of the cell:
     *  Gauss-Newton on the coordinates of the face, which stay within it. */
    template <int dim>
    Point<dim>
    project_to_face(const Mapping<dim>                               &mapping,
                    const typename Triangulation<dim>::cell_iterator &cell,
                    const unsigned int                                f,
                    const Point<dim>                                 &p)
    {
      const unsigned int normal = GeometryInfo<dim>::unit_normal_direction[f];
      Point<dim>         unit;
      for (unsigned int d = 0; d < dim; ++d)
        unit[d] = d == normal ? f % 2 : 0.5;
      constexpr unsigned int n_steps = 20;
      constexpr double       small   = 1e-5;
      for (unsigned int step = 0; step < n_steps; ++step)
        {
          const Tensor<1, dim> miss =
            p - mapping.transform_unit_to_real_cell(cell, unit);
          Tensor<2, dim> metric;
          Tensor<1, dim> slope, tangents[dim];
          for (unsigned int d = 0; d < dim; ++d)
            if (d != normal)
              {
                Point<dim> before(unit), after(unit);
                before[d] -= small;
                after[d] += small;
                tangents[d] =
                  (mapping.transform_unit_to_real_cell(cell, after) -
                   mapping.transform_unit_to_real_cell(cell, before)) /
                  (2. * small);
              }
          for (unsigned int d = 0; d < dim; ++d)
            {
              slope[d] = tangents[d] * miss;
              for (unsigned int e = 0; e < dim; ++e)
                metric[d][e] = tangents[d] * tangents[e];
            }
          metric[normal][normal]     = 1.;
          const Tensor<1, dim> along = invert(metric) * slope;
          const Point<dim>     last  = unit;
          unit = GeometryInfo<dim>::project_to_unit_cell(unit + along);
          if (unit.distance(last) < 1e-12)
            break;
        }
      return unit;
    }

    /** Of two that are as close by symmetry, the same on any number of ranks. */
    template <typename Nearest>
    bool
    is_better(const Nearest &a, const Nearest &b)
    {
      const double difference = b.distance - a.distance;
      const double equal      = 1e-9 * a.cell_size;
      return difference > equal ||
             (difference >= -equal &&
              std::lexicographical_compare(a.point.begin_raw(),
                                           a.point.end_raw(),
                                           b.point.begin_raw(),
                                           b.point.end_raw()));
    }
  } // namespace

  template <int dim>
  PointLocator<dim>::PointLocator(const Space<dim>               &space,
                                  const std::vector<Point<dim>>  &points,
                                  const std::vector<std::string> &where,
                                  const Materials                 separation,
                                  const bool                      takes_nearest)
    : space(space)
    , points(points)
    , where(where)
    , takes_nearest(takes_nearest)
    , mesh_changes(
        space.mesh.signals.any_change.connect([this] { is_current = false; }))
  {
    for (unsigned int i = 0; i < points.size(); ++i)
      targets.push_back({i});
    announced.resize(points.size());
    first_size.resize(points.size());
    places();
    is_first = false;
    for (const auto &place : found)
      first_size[place.target] =
        std::max(first_size[place.target], place.cell->diameter());
    Utilities::MPI::max(first_size, space.communicator, first_size);
    find_materials(separation);
  }

  template <int dim>
  const std::vector<typename PointLocator<dim>::Place> &
  PointLocator<dim>::places()
  {
    if (is_current)
      return found;
    position.clear();
    for (const auto &target : targets)
      position.push_back(points[target.point]);
    const auto missing = locate();
    if (!missing.empty())
      {
        take_nearest(missing);
        for (const unsigned int t : locate())
          {
            std::ostringstream point;
            point << points[targets[t].point];
            throw UserError(where_is(targets[t].point),
                            "point " + point.str() +
                              ", which is on the edge of the body",
                            "points of the body",
                            "move it a little to the inside");
          }
      }
    is_current = true;
    return found;
  }

  template <int dim>
  std::vector<unsigned int>
  PointLocator<dim>::locate()
  {
    namespace bgi = boost::geometry::index;
    found.clear();
    std::vector<unsigned int> n_cells(targets.size());
    const auto                tree = pack_rtree_of_indices(position);
    std::vector<unsigned int> inside;
    if (!targets.empty())
      for (const auto &cell : space.mesh.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            inside.clear();
            // quadratic cells bulge
            const double more =
              (space.degree > 1 ? 0.5 : tolerance) * cell->diameter();
            tree.query(bgi::intersects(box_around<dim>(cell, more)),
                       std::back_inserter(inside));
            for (const unsigned int t : inside)
              if (takes<dim>(cell, targets[t].material))
                {
                  Point<dim> unit;
                  try
                    {
                      unit =
                        space.mapping.transform_real_to_unit_cell(cell,
                                                                  position[t]);
                    }
                  catch (const typename Mapping<dim>::ExcTransformationFailed &)
                    {
                      continue; // far outside
                    }
                  if (!GeometryInfo<dim>::is_inside_unit_cell(unit, tolerance))
                    continue;
                  found.push_back(
                    {t,
                     cell,
                     GeometryInfo<dim>::project_to_unit_cell(unit),
                     0.});
                  ++n_cells[t];
                }
          }
    Utilities::MPI::sum(n_cells, space.communicator, n_cells);
    for (auto &place : found)
      place.share = 1. / n_cells[place.target];
    std::vector<unsigned int> missing;
    for (unsigned int t = 0; t < targets.size(); ++t)
      if (n_cells[t] == 0)
        missing.push_back(t);
    return missing;
  }

  template <int dim>
  void
  PointLocator<dim>::find_materials(const Materials separation)
  {
    using Pairs     = std::vector<std::pair<unsigned int, types::material_id>>;
    const auto sort = [](Pairs &pairs) {
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    };
    Pairs own, all;
    for (const auto &place : found)
      own.emplace_back(place.target, place.cell->material_id());
    sort(own);
    for (const Pairs &pairs :
         Utilities::MPI::all_gather(space.communicator, own))
      all.insert(all.end(), pairs.begin(), pairs.end());
    sort(all);

    std::vector<unsigned int> n_materials(points.size());
    for (const auto &pair : all)
      ++n_materials[pair.first];
    targets.clear();
    for (const auto &[point, material] : all)
      {
        const bool shares =
          separation == Materials::apart && n_materials[point] > 1;
        if (!shares && !targets.empty() && targets.back().point == point)
          continue;
        targets.push_back(
          {point, shares ? material : numbers::invalid_material_id});
        materials.push_back(material);
      }
    is_current &= targets.size() == points.size();
  }

  template <int dim>
  void
  PointLocator<dim>::take_nearest(const std::vector<unsigned int> &missing)
  {
    const std::vector<Nearest> there = nearest(missing);
    for (unsigned int i = 0; i < missing.size(); ++i)
      {
        const unsigned int point = targets[missing[i]].point;
        // at the start, what is on the curve that the coarse face cuts short
        const bool is_close =
          there[i].distance <
          (is_first ? 1.1 * there[i].bulge : reach * first_size[point]);
        if (there[i].distance < typed * there[i].cell_size)
          {}
        else if (is_close && takes_nearest)
          announce(point, there[i]);
        else
          {
            std::ostringstream what, closest;
            what << points[point];
            closest << there[i].point;
            throw UserError(
              where_is(point),
              "point " + what.str() +
                (is_first ? ", which is not in the body" :
                            ", which is not in the body any more: the mesh "
                            "has changed"),
              "points of the body",
              is_close || there[i].distance < reach * there[i].cell_size ?
                "the nearest one is " + closest.str() :
                "on curved boundaries of the mesh, stay a little inside");
          }
        position[missing[i]] = there[i].point;
      }
  }

  template <int dim>
  void
  PointLocator<dim>::look_at_faces(
    const typename Triangulation<dim>::active_cell_iterator &cell,
    const types::material_id                                 material,
    const Point<dim>                                        &lost,
    Nearest                                                 &best) const
  {
    for (const auto f : cell->face_indices())
      // those inside are the end of a material at most
      if (cell->at_boundary(f) || material != numbers::invalid_material_id)
        {
          const Point<dim> p = space.mapping.transform_unit_to_real_cell(
            cell, project_to_face<dim>(space.mapping, cell, f, lost));
          const Nearest there = {p.distance(lost),
                                 cell->diameter(),
                                 p,
                                 cell->face(f)->center(true).distance(
                                   cell->face(f)->center())};
          if (is_better(there, best))
            best = there;
        }
  }

  template <int dim>
  std::vector<typename PointLocator<dim>::Nearest>
  PointLocator<dim>::nearest(const std::vector<unsigned int> &missing) const
  {
    namespace bgi = boost::geometry::index;
    std::vector<Point<dim>> lost;
    double                  far = 0.;
    for (const unsigned int t : missing)
      {
        lost.push_back(position[t]);
        far = std::max(far, reach * first_size[targets[t].point]);
      }
    const auto                tree = pack_rtree_of_indices(lost);
    std::vector<Nearest>      best(lost.size());
    std::vector<unsigned int> around;
    for (const auto &cell : space.mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          around.clear();
          const double more = 0.5 * cell->diameter();
          tree.query(bgi::intersects(
                       box_around<dim>(cell, std::max(more, far))),
                     std::back_inserter(around));
          for (const unsigned int i : around)
            if (takes<dim>(cell, targets[missing[i]].material) &&
                distance_to(box_around<dim>(cell, more), lost[i]) <
                  best[i].distance)
              look_at_faces(cell,
                            targets[missing[i]].material,
                            lost[i],
                            best[i]);
        }
    for (const auto &others :
         Utilities::MPI::all_gather(space.communicator, best))
      for (unsigned int i = 0; i < best.size(); ++i)
        if (is_better(others[i], best[i]))
          best[i] = others[i];
    return best;
  }

  template <int dim>
  void
  PointLocator<dim>::announce(const unsigned int point, const Nearest &there)
  {
    if (announced[point])
      return;
    announced[point] = true;
    ConditionalOStream screen(
      std::cout, Utilities::MPI::this_mpi_process(space.communicator) == 0);
    screen << "Note: " << where_is(point) << ": the mesh leaves the point "
           << points[point] << " outside by " << there.distance
           << " m; its nearest one, " << there.point << ", takes its place.\n";
  }

  template class PointLocator<2>;
  template class PointLocator<3>;
} // namespace Signoton
