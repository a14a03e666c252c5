#ifndef signoton_discretization_curved_geometry_h
#define signoton_discretization_curved_geometry_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <string>
#include <vector>

namespace Signoton
{
  using namespace dealii;

  /**
   * Elements of a mesh that know more of a curve than their corners: for each
   * of them (order + 1)^dim points on a regular lattice, the first coordinate
   * fastest. Corners are among them, so that the cells they belong to are
   * found by place.
   */
  struct CurvedElements
  {
    /** 1: all edges are known to be straight; 0: nothing is known. */
    unsigned int        order = 0;
    std::vector<double> coordinates; ///< of the points, one after another

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &order &coordinates;
    }
  };

  /**
   * The elements of the mesh of the current gmsh model, with points on its
   * curves and surfaces, if it has any. The mesh is of high order afterwards,
   * with the same corners.
   */
  template <int dim>
  CurvedElements
  sample_gmsh_curves();

  /**
   * The shape of coarse cells with curved edges: how far they deviate from
   * straight ones with the same corners. Kept apart from the corners, which may
   * still be moved before the shape is given to a mesh.
   */
  template <int dim>
  class CurvedGeometry
  {
  public:
    /** Find the cells of a coarse mesh that elements belong to. Elements
     *  without a cell, and those with straight edges, leave nothing. */
    CurvedGeometry(const CurvedElements     &elements,
                   const Triangulation<dim> &coarse_mesh);

    /** Let all refinements of the coarse mesh follow the shape. If a cell
     *  folds, being thinner than the curve is high, all cells keep straight
     *  edges, and its center is returned. */
    std::vector<Point<dim>>
    attach(Triangulation<dim> &coarse_mesh) const;

  private:
    unsigned int order;
    /** by the index of the coarse cell, for each point of the lattice */
    std::map<unsigned int, std::vector<Tensor<1, dim>>> deviations;
  };

  /** Kinks between straight faces of one boundary. */
  struct Kinks
  {
    unsigned int number   = 0;
    double       smallest = 180., largest = 0.; ///< angles in degrees
  };

  /** The boundaries that look like curves made of facets: with two kinks or
   *  more that are neither smooth nor corners. */
  template <int dim>
  std::map<types::boundary_id, Kinks>
  find_facets(const Triangulation<dim> &coarse_mesh);
} // namespace Signoton

#endif
