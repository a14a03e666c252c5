#include <signoton/discretization/mesh_identity.h>

#include <deal.II/base/bounding_box.h>

#include <boost/crc.hpp>

#include <cmath>
#include <cstdint>
#include <sstream>

namespace Signoton
{
  namespace
  {
    const std::string prefix = "coarse mesh: ";

    class Checksum
    {
    public:
      void
      add(const std::int64_t value)
      {
        crc.process_bytes(&value, sizeof(value));
      }

      /** Points that differ by round-off count as one; the offset keeps round
       *  numbers away from where the count changes. */
      template <int dim>
      void
      add(const Point<dim> &point, const double grain)
      {
        for (unsigned int d = 0; d < dim; ++d)
          add(static_cast<std::int64_t>(
            std::floor(point[d] / grain + 0.31830989)));
      }

      double
      value() const
      {
        return crc.checksum();
      }

    private:
      boost::crc_32_type crc;
    };

    /** The point in the middle of a cell, face or line that is not straight. */
    template <typename Object>
    void
    add_middle(const Object &object, const double grain, Checksum &checksum)
    {
      if (object->manifold_id() == numbers::flat_manifold_id)
        return;
      checksum.add(object->manifold_id());
      checksum.add(object->center(true), grain);
    }
  } // namespace

  template <int dim>
  std::map<std::string, double>
  mesh_identity(const Space<dim> &space)
  {
    const auto             &mesh = space.mesh;
    std::vector<Point<dim>> corners;
    std::vector<bool>       seen(mesh.n_vertices(), false);
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const auto v : cell->vertex_indices())
        if (!seen[cell->vertex_index(v)])
          {
            seen[cell->vertex_index(v)] = true;
            corners.push_back(cell->vertex(v));
          }
    const BoundingBox<dim> box(corners);
    const auto             ends  = box.get_boundary_points();
    const double           grain = 1e-8 * ends.first.distance(ends.second);

    Checksum places, materials, boundaries, curved, periodic;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      {
        for (const auto v : cell->vertex_indices())
          {
            places.add(cell->vertex_index(v));
            places.add(cell->vertex(v), grain);
          }
        materials.add(cell->material_id());
        add_middle(cell, grain, curved);
        for (const auto &face : cell->face_iterators())
          {
            boundaries.add(face->at_boundary() ? face->boundary_id() : -1);
            add_middle(face, grain, curved);
          }
        if (dim == 3)
          for (const auto l : cell->line_indices())
            add_middle(cell->line(l), grain, curved);
      }
    for (const auto &pair : space.boundary.periodic)
      {
        periodic.add(pair.first);
        periodic.add(pair.second);
        periodic.add(pair.direction);
      }
    std::map<std::string, double> identity = {
      {prefix + "cells", mesh.n_cells(0)},
      {prefix + "vertices", corners.size()},
      {prefix + "coordinates of vertices", places.value()},
      {prefix + "material ids", materials.value()},
      {prefix + "boundary ids", boundaries.value()},
      {prefix + "curved geometry", curved.value()},
      {prefix + "periodic boundaries", periodic.value()}};
    const std::array<std::string, 3> axes = {{"x", "y", "z"}};
    for (unsigned int d = 0; d < dim; ++d)
      {
        identity[prefix + "least " + axes[d]]   = ends.first[d];
        identity[prefix + "largest " + axes[d]] = ends.second[d];
      }
    return identity;
  }

  std::string
  difference_of_meshes(const std::map<std::string, double> &before,
                       const std::map<std::string, double> &now)
  {
    const auto old_value = [&](const std::string &name) {
      const auto found = before.find(name);
      return found == before.end() ? std::nan("") : found->second;
    };
    // of other cells, all checksums are others
    const bool as_many =
      old_value(prefix + "cells") == now.at(prefix + "cells") &&
      old_value(prefix + "vertices") == now.at(prefix + "vertices");
    std::ostringstream text;
    for (const auto &[name, value] : now)
      {
        const double      old  = old_value(name);
        const std::string what = name.substr(prefix.size());
        const bool        is_extent =
          what.rfind("least ", 0) == 0 || what.rfind("largest ", 0) == 0;
        const bool is_count = what == "cells" || what == "vertices";
        if (is_extent ? !(std::abs(old - value) >
                          1e-6 * (std::abs(old) + std::abs(value))) :
                        old == value || !(is_count || as_many))
          continue;
        text << (text.str().empty() ? "" : ", ") << what;
        if (is_extent || is_count)
          text << " (" << old << ", now " << value << ")";
      }
    return text.str();
  }

  template std::map<std::string, double>
  mesh_identity(const Space<2> &);
  template std::map<std::string, double>
  mesh_identity(const Space<3> &);
} // namespace Signoton
