#include <signoton/discretization/curved_geometry.h>
#include <signoton/discretization/polynomial_manifold.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>

namespace Signoton
{
  namespace
  {
    /** Faces of a curve meet at angles between these, in degrees. */
    constexpr double smallest_kink = .1, largest_kink = 50.;

    /** A lattice of (order + 1)^dim points over the unit cell. */
    template <int dim>
    struct Lattice
    {
      explicit Lattice(const unsigned int order)
        : order(order)
        , size(Utilities::pow(order + 1, dim))
      {}

      std::array<int, dim>
      coordinates(std::size_t index) const
      {
        std::array<int, dim> result;
        for (unsigned int d = 0; d < dim; ++d, index /= order + 1)
          result[d] = index % (order + 1);
        return result;
      }

      std::size_t
      index(const std::array<int, dim> &coordinates) const
      {
        std::size_t result = 0;
        for (unsigned int d = dim; d-- > 0;)
          result = result * (order + 1) + coordinates[d];
        return result;
      }

      std::size_t
      corner(const unsigned int vertex) const
      {
        std::array<int, dim> at;
        for (unsigned int d = 0; d < dim; ++d)
          at[d] = (vertex >> d & 1U) * order;
        return index(at);
      }

      /** The points of a cell with straight edges. */
      template <class Cell>
      std::vector<Point<dim>>
      straight(const Cell &cell) const
      {
        std::vector<Point<dim>> points(size);
        for (std::size_t i = 0; i < size; ++i)
          {
            const auto at = coordinates(i);
            Point<dim> unit;
            for (unsigned int d = 0; d < dim; ++d)
              unit[d] = double(at[d]) / order;
            for (const auto v : GeometryInfo<dim>::vertex_indices())
              points[i] += GeometryInfo<dim>::d_linear_shape_function(unit, v) *
                           cell->vertex(v);
          }
        return points;
      }

      /** How far points are from a cell with straight edges; empty if that is
       *  round-off. What is read from a text differs in the last digit, which
       *  the corners must not. */
      template <class Cell>
      std::vector<Tensor<1, dim>>
      deviation(const std::vector<Point<dim>> &points, const Cell &cell) const
      {
        const auto                  flat = straight(cell);
        std::vector<Tensor<1, dim>> result(size);
        double                      largest = 0.;
        for (std::size_t i = 0; i < size; ++i)
          {
            result[i] = points[i] - flat[i];
            largest   = std::max(largest, result[i].norm());
          }
        if (!(largest > 1e-10 * cell->diameter()))
          return {};
        for (const auto v : GeometryInfo<dim>::vertex_indices())
          result[corner(v)] = Tensor<1, dim>();
        return result;
      }

      unsigned int order;
      std::size_t  size;
    };

    template <int dim>
    using CellIterator = typename Triangulation<dim>::active_cell_iterator;

    /** The cell whose center is nearest to that of an element. */
    template <int dim, class Tree>
    CellIterator<dim>
    find_cell(const std::vector<Point<dim>> &element,
              const Lattice<dim>            &lattice,
              const Tree                    &tree,
              const Triangulation<dim>      &mesh)
    {
      Point<dim> center;
      for (const auto v : GeometryInfo<dim>::vertex_indices())
        center +=
          element[lattice.corner(v)] / GeometryInfo<dim>::vertices_per_cell;
      std::vector<std::pair<Point<dim>, unsigned int>> nearest;
      tree.query(boost::geometry::index::nearest(center, 1),
                 std::back_inserter(nearest));
      return {&mesh, 0, int(nearest.at(0).second)};
    }

    /** The points of an element in the order of a cell, or none if corners
     *  differ. */
    template <int dim, class Cell>
    std::vector<Point<dim>>
    turn(const std::vector<Point<dim>> &element,
         const Lattice<dim>            &lattice,
         const Cell                    &cell)
    {
      constexpr unsigned int           n_vertices = 1U << dim;
      const double                     tolerance  = 1e-6 * cell->diameter();
      std::array<unsigned, n_vertices> corner;
      for (unsigned int v = 0; v < n_vertices; ++v)
        {
          corner[v] = 0;
          while (corner[v] < n_vertices &&
                 element[lattice.corner(corner[v])].distance(cell->vertex(v)) >
                   tolerance)
            ++corner[v];
          if (corner[v] == n_vertices)
            return {};
        }
      std::vector<Point<dim>> points(lattice.size);
      for (std::size_t i = 0; i < lattice.size; ++i)
        {
          const auto           here = lattice.coordinates(i);
          std::array<int, dim> there;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const int origin = corner[0] >> d & 1U;
              there[d]         = origin * lattice.order;
              for (unsigned int e = 0; e < dim; ++e)
                there[d] += (int(corner[1U << e] >> d & 1U) - origin) * here[e];
            }
          points[i] = element[lattice.index(there)];
        }
      return points;
    }

    template <int dim, class Face>
    Tensor<1, dim>
    unit_normal(const Face &face)
    {
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(face->vertex(1) - face->vertex(0));
      else
        normal = cross_product_3d(face->vertex(3) - face->vertex(0),
                                  face->vertex(2) - face->vertex(1));
      return normal / normal.norm();
    }
  } // namespace

  template <int dim>
  CurvedGeometry<dim>::CurvedGeometry(const CurvedElements     &elements,
                                      const Triangulation<dim> &coarse_mesh)
    : order(elements.order)
  {
    if (elements.coordinates.empty())
      return;
    const Lattice<dim>                               lattice(order);
    std::vector<std::pair<Point<dim>, unsigned int>> centers;
    for (const auto &cell : coarse_mesh.active_cell_iterators())
      centers.emplace_back(cell->center(), cell->index());
    const auto tree = pack_rtree(centers);

    std::vector<Point<dim>> element(lattice.size);
    for (auto next = elements.coordinates.begin();
         next != elements.coordinates.end();)
      {
        for (auto &point : element)
          {
            std::copy_n(next, dim, point.begin_raw());
            next += dim;
          }
        const auto cell = find_cell(element, lattice, tree, coarse_mesh);
        if (const auto points = turn(element, lattice, cell); !points.empty())
          if (auto deviation = lattice.deviation(points, cell);
              !deviation.empty())
            deviations.emplace(cell->index(), std::move(deviation));
      }
  }

  template <int dim>
  std::vector<Point<dim>>
  CurvedGeometry<dim>::attach(Triangulation<dim> &coarse_mesh) const
  {
    std::vector<PolynomialChart<dim>> charts;
    std::vector<Point<dim>>           folded;
    for (const auto &[index, deviation] : deviations)
      {
        const CellIterator<dim> cell(&coarse_mesh, 0, index);
        auto                    points = Lattice<dim>(order).straight(cell);
        for (std::size_t i = 0; i < points.size(); ++i)
          points[i] += deviation[i];
        charts.emplace_back(order, points);
        if (!charts.back().is_regular())
          folded.push_back(cell->center());
      }
    if (charts.empty() || !folded.empty())
      return folded;

    types::manifold_id id = 0;
    for (const auto used : coarse_mesh.get_manifold_ids())
      if (used != numbers::flat_manifold_id)
        id = std::max(id, used + 1);
    for (const auto &[index, deviation] : deviations)
      CellIterator<dim>(&coarse_mesh, 0, index)->set_all_manifold_ids(id);
    coarse_mesh.set_manifold(id, PolynomialManifold<dim>(std::move(charts)));
    return {};
  }

  template <int dim>
  std::map<types::boundary_id, Kinks>
  find_facets(const Triangulation<dim> &coarse_mesh)
  {
    // faces meet in vertices or, in space, in lines
    std::map<unsigned int, std::pair<types::boundary_id, Tensor<1, dim>>> first;
    std::map<types::boundary_id, Kinks>                                   kinks;
    const auto meet = [&](const unsigned int       where,
                          const types::boundary_id id,
                          const Tensor<1, dim>    &normal) {
      const auto [other, is_new] = first.try_emplace(where, id, normal);
      if (is_new || other->second.first != id)
        return;
      const double angle =
        180. / numbers::PI *
        std::acos(std::clamp(std::abs(normal * other->second.second), 0., 1.));
      if (angle < smallest_kink || angle > largest_kink)
        return;
      auto &found = kinks[id];
      ++found.number;
      found.smallest = std::min(found.smallest, angle);
      found.largest  = std::max(found.largest, angle);
    };
    for (const auto &cell : coarse_mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() &&
            face->manifold_id() == numbers::flat_manifold_id)
          for (unsigned int i = 0; i < (dim == 2 ? 2U : 4U); ++i)
            meet(dim == 2 ? face->vertex_index(i) : face->line_index(i),
                 face->boundary_id(),
                 unit_normal<dim>(face));
    for (auto entry = kinks.begin(); entry != kinks.end();)
      entry = entry->second.number < 2 ? kinks.erase(entry) : std::next(entry);
    return kinks;
  }

  template class CurvedGeometry<2>;
  template class CurvedGeometry<3>;
  template std::map<types::boundary_id, Kinks>
  find_facets(const Triangulation<2> &);
  template std::map<types::boundary_id, Kinks>
  find_facets(const Triangulation<3> &);
} // namespace Signoton
