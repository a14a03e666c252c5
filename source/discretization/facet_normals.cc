#include <signoton/discretization/facet_normals.h>

#include <deal.II/grid/manifold.h>

#include <algorithm>
#include <numeric>

namespace Signoton
{
  namespace
  {
    /** The part of a facet in the normal at one of its vertices. */
    template <int dim>
    Tensor<1, dim>
    weighted_normal(const typename Triangulation<dim>::cell_iterator &cell,
                    const unsigned int                                face,
                    const unsigned int                                vertex)
    {
      const auto edge = [&](const unsigned int direction) {
        const Tensor<1, dim> e =
          cell->vertex(vertex ^ (1u << direction)) - cell->vertex(vertex);
        return e / e.norm_square();
      };
      const unsigned int across = face / 2;
      Tensor<1, dim>     normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(edge(1 - across));
      else
        normal =
          cross_product_3d(edge((across + 1) % 3), edge((across + 2) % 3));
      return normal * edge(across) < 0. ? normal : -normal;
    }

    /** A facet at one of its vertices. */
    template <int dim>
    struct Corner
    {
      Tensor<1, dim>  part;   ///< in the normal at the vertex
      Tensor<1, dim> *result; ///< this normal
    };

    template <int dim>
    void
    enter_angles(const std::vector<Tensor<1, dim>> &normals,
                 const std::vector<unsigned int>   &surface,
                 FacetAngles                       &angles)
    {
      for (unsigned int i = 0; i < normals.size(); ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const double cosine = std::clamp(normals[i] * normals[j], -1., 1.);
            const double angle  = std::acos(cosine) * 180. / numbers::PI;
            if (surface[i] == surface[j])
              angles.largest_smooth = std::max(angles.largest_smooth, angle);
            else
              angles.smallest_kink = std::min(angles.smallest_kink, angle);
          }
    }

    /** Give all corners at a vertex, of one section, their normals. */
    template <int dim>
    void
    join(const std::vector<Corner<dim>> &corners,
         const double                    kink_angle,
         FacetAngles                    &angles)
    {
      std::vector<Tensor<1, dim>> normals;
      for (const auto &corner : corners)
        normals.push_back(corner.part / corner.part.norm());
      const auto surface = smooth_surfaces(normals, kink_angle);
      enter_angles(normals, surface, angles);
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          Tensor<1, dim> sum;
          for (unsigned int j = 0; j < corners.size(); ++j)
            if (surface[i] == surface[j])
              sum += corners[j].part;
          *corners[i].result = sum / sum.norm();
        }
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int>
  smooth_surfaces(const std::vector<Tensor<1, dim>> &normals,
                  const double                       kink_angle)
  {
    const double cos_kink = std::cos(kink_angle * numbers::PI / 180.) + 1e-12;
    std::vector<unsigned int> surface(normals.size());
    std::iota(surface.begin(), surface.end(), 0);
    for (unsigned int i = 0; i < normals.size(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        if (normals[i] * normals[j] > std::min(cos_kink, 1. - 1e-12))
          {
            const auto [first, second] = std::minmax(surface[i], surface[j]);
            std::replace(surface.begin(),
                         surface.end(),
                         static_cast<unsigned int>(second),
                         static_cast<unsigned int>(first));
          }
    return surface;
  }

  template <int dim>
  bool
  is_curved(const typename Triangulation<dim>::face_iterator &face)
  {
    if (dynamic_cast<const FlatManifold<dim> *>(&face->get_manifold()))
      return false;
    std::vector<Point<dim>> points = {face->center(true)};
    for (const auto v : face->vertex_indices())
      points.push_back(face->vertex(v));
    Tensor<1, dim> normal;
    if constexpr (dim == 2)
      normal = cross_product_2d(face->vertex(1) - face->vertex(0));
    else
      {
        for (unsigned int l = 0; l < face->n_lines(); ++l)
          points.push_back(face->line(l)->center(true));
        normal = cross_product_3d(face->vertex(3) - face->vertex(0),
                                  face->vertex(2) - face->vertex(1));
      }
    normal /= normal.norm();
    for (const auto &p : points)
      if (std::abs((p - face->vertex(0)) * normal) > 1e-8 * face->diameter())
        return true;
    return false;
  }

  template <int dim>
  FacetNormals<dim>::FacetNormals(const Triangulation<dim>      &mesh,
                                  const BoundaryConditions<dim> &conditions)
    : angles_of_sections(conditions.size())
  {
    // by section and vertex
    std::map<std::pair<unsigned int, unsigned int>, std::vector<Corner<dim>>>
      corners;
    for (const auto &cell : mesh.cell_iterators_on_level(0))
      for (const auto f : cell->face_indices())
        for (unsigned int s = 0; s < conditions.size(); ++s)
          if (conditions[s].symmetry && cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == conditions[s].id &&
              !is_curved<dim>(cell->face(f)))
            {
              auto &normals = facets[{cell->index(), f}];
              for (const auto i : cell->face(f)->vertex_indices())
                {
                  const unsigned int v =
                    GeometryInfo<dim>::face_to_cell_vertices(f, i);
                  corners[{s, cell->vertex_index(v)}].push_back(
                    {weighted_normal<dim>(cell, f, v), &normals[i]});
                }
            }
    for (const auto &[key, list] : corners)
      join(list,
           conditions[key.first].kink_angle,
           angles_of_sections[key.first]);
  }

  template <int dim>
  std::optional<Tensor<1, dim>>
  FacetNormals<dim>::normal(typename Triangulation<dim>::cell_iterator cell,
                            const unsigned int                         face,
                            Point<dim> unit) const
  {
    while (cell->level() > 0)
      {
        const auto   parent = cell->parent();
        unsigned int child  = 0;
        while (parent->child(child) != cell)
          ++child;
        unit = GeometryInfo<dim>::child_to_cell_coordinates(unit, child);
        cell = parent;
      }
    const auto facet = facets.find({cell->index(), face});
    if (facet == facets.end())
      return {};
    Tensor<1, dim> normal;
    for (unsigned int i = 0; i < facet->second.size(); ++i)
      normal += GeometryInfo<dim>::d_linear_shape_function(
                  unit, GeometryInfo<dim>::face_to_cell_vertices(face, i)) *
                facet->second[i];
    return normal / normal.norm();
  }

#define INSTANTIATE(dim)                                   \
  template class FacetNormals<dim>;                        \
  template std::vector<unsigned int> smooth_surfaces<dim>( \
    const std::vector<Tensor<1, dim>> &, const double);    \
  template bool is_curved<dim>(const Triangulation<dim>::face_iterator &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace Signoton
