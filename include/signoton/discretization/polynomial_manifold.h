#ifndef signoton_discretization_polynomial_manifold_h
#define signoton_discretization_polynomial_manifold_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/grid/manifold.h>

#include <memory>
#include <optional>
#include <vector>

namespace Signoton
{
  using namespace dealii;

  /**
   * A polynomial map of the unit cell, x = sum_i L_i(xi) x_i, by the points x_i
   * of a regular lattice and the Lagrange polynomials L_i through them.
   */
  template <int dim>
  class PolynomialChart
  {
  public:
    static constexpr unsigned int largest_order = 6;

    /** @param order of the polynomials in each coordinate
     *  @param points (order + 1)^dim of them, the first coordinate fastest */
    PolynomialChart(const unsigned int             order,
                    const std::vector<Point<dim>> &points);

    Point<dim>
    push_forward(const Point<dim> &unit) const;

    /** Entry (i, j) is the derivative of x_i by xi_j. */
    Tensor<2, dim>
    gradient(const Point<dim> &unit) const;

    /** False if a point is outside for sure; costs little. */
    bool
    may_hold(const Point<dim> &point) const;

    /** The point that is mapped to a given one, or nothing if there is none
     *  in the unit cell (to round-off) that Newton's method would find. */
    std::optional<Point<dim>>
    pull_back(const Point<dim> &point) const;

    /** A box that holds the chart. */
    const BoundingBox<dim> &
    bounding_box() const;

    /** False where the map folds: at some point inside the unit cell its
     *  Jacobian is not positive. */
    bool
    is_regular() const;

  private:
    /** The inverse of the linear part. */
    Point<dim>
    guess(const Point<dim> &point) const;

    std::pair<Point<dim>, Tensor<2, dim>>
    evaluate(const Point<dim> &unit) const;

    unsigned int            order;
    std::vector<Point<dim>> points;
    BoundingBox<dim>        box;       ///< with a margin
    Point<dim>              middle;    ///< of the chart
    Tensor<2, dim>          start;     ///< inverse of the gradient there
    double                  reach = 0; ///< bounds the error of the guess
  };

  /**
   * The geometry of a mesh whose coarse cells are polynomial maps. New points
   * are weighted means in the unit cell of one coarse cell, so that all
   * refinements of it lie on the same curves and surfaces. Charts that share
   * an edge or a face agree on it to round-off; the first chart that holds all
   * points is taken, the same on every rank. The manifold needs no mesh and
   * goes with copies of one.
   */
  template <int dim>
  class PolynomialManifold : public Manifold<dim>
  {
  public:
    explicit PolynomialManifold(std::vector<PolynomialChart<dim>> charts);

    std::unique_ptr<Manifold<dim>>
    clone() const override;

    Point<dim>
    get_new_point(const ArrayView<const Point<dim>> &surrounding_points,
                  const ArrayView<const double>     &weights) const override;

    void
    get_new_points(const ArrayView<const Point<dim>> &surrounding_points,
                   const Table<2, double>            &weights,
                   ArrayView<Point<dim>> new_points) const override;

    /** The exact direction of the chart, by which normals are computed. */
    Tensor<1, dim>
    get_tangent_vector(const Point<dim> &from,
                       const Point<dim> &to) const override;

  private:
    struct Atlas;

    /** The first chart that holds all points, and where they are in it. */
    const PolynomialChart<dim> &
    find_chart(const ArrayView<const Point<dim>> &points,
               const ArrayView<Point<dim>>       &unit_points) const;

    std::shared_ptr<const Atlas> atlas;
  };
} // namespace Signoton

#endif
