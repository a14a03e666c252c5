#ifndef signoton_discretization_facet_normals_h
#define signoton_discretization_facet_normals_h

#include <signoton/discretization/held_nodes.h>

#include <deal.II/grid/tria.h>

#include <map>
#include <optional>

namespace Signoton
{
  /** Numbers of the surfaces that some unit normals belong to: two that meet
   *  at less than an angle in degrees are of the same, and so are those that
   *  others connect. The number is that of the first of its normals. */
  template <int dim>
  std::vector<unsigned int>
  smooth_surfaces(const std::vector<Tensor<1, dim>> &normals,
                  const double                       kink_angle);

  /** Whether the mesh knows of a curved surface behind a face: points that
   *  refinement would make are not in the plane of its vertices. */
  template <int dim>
  bool
  is_curved(const typename Triangulation<dim>::face_iterator &face);

  /**
   * Normals of the smooth surfaces that facets of the coarse mesh stand for,
   * where it knows of nothing curved behind them. At a vertex of the coarse
   * mesh the facets of a section that meet without a kink have one normal, with
   * the weights of N. Max (Journal of Graphics Tools 4, 1999),
   * @f[ n \sim \sum a\times b/(|a|^2|b|^2), @f]
   * a and b being the edges of a facet that leave the vertex; in 2D, the normals
   * of the edges over their lengths. Between the vertices, normals are
   * interpolated as the points are. If vertices are on a circle, a cylinder or a
   * sphere, the normal at each point of a facet, however it is refined, has the
   * direction of this point from the center: such bodies turn freely.
   */
  template <int dim>
  class FacetNormals
  {
  public:
    /** The same on all ranks: each of them has the whole coarse mesh. */
    FacetNormals(const Triangulation<dim>      &mesh,
                 const BoundaryConditions<dim> &conditions);

    /** The unit normal at a point of a face with symmetry; nothing where the
     *  surface is curved.
     *  @param unit the point in the cell */
    std::optional<Tensor<1, dim>>
    normal(typename Triangulation<dim>::cell_iterator cell,
           const unsigned int                         face,
           Point<dim>                                 unit) const;

    /** How facets meet, for each condition. */
    const std::vector<FacetAngles> &
    angles() const
    {
      return angles_of_sections;
    }

  private:
    /** A face of a coarse cell, by their numbers. */
    using Facet = std::pair<unsigned int, unsigned int>;

    /** Normals at the vertices of a facet, in the order of the cell. */
    std::map<Facet,
             std::array<Tensor<1, dim>, GeometryInfo<dim>::vertices_per_face>>
                             facets;
    std::vector<FacetAngles> angles_of_sections;
  };
} // namespace Signoton

#endif
