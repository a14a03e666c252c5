#include <signoton/discretization/polynomial_manifold.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/table.h>
#include <deal.II/numerics/rtree.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>

namespace Signoton
{
  namespace
  {
    /** Lagrange polynomials through 0, 1/order, ..., 1 and their slopes. */
    struct Basis
    {
      Basis(const unsigned int order, const double x)
      {
        const double t = order * x;
        for (unsigned int i = 0; i <= order; ++i)
          {
            values[i] = 1.;
            slopes[i] = 0.;
            for (unsigned int j = 0; j <= order; ++j)
              if (j != i)
                {
                  const double scale  = 1. / (double(i) - double(j));
                  const double factor = (t - j) * scale;
                  slopes[i]           = slopes[i] * factor + values[i] * scale;
                  values[i] *= factor;
                }
            slopes[i] *= order;
          }
      }

      std::array<double, PolynomialChart<2>::largest_order + 1> values, slopes;
    };

    template <int dim>
    std::array<Basis, dim>
    make_basis(const unsigned int order, const Point<dim> &unit)
    {
      if constexpr (dim == 2)
        return {{{order, unit[0]}, {order, unit[1]}}};
      else
        return {{{order, unit[0]}, {order, unit[1]}, {order, unit[2]}}};
    }

    template <int dim>
    Point<dim>
    center_of_unit_cell()
    {
      Point<dim> center;
      for (unsigned int d = 0; d < dim; ++d)
        center[d] = .5;
      return center;
    }

    template <int dim>
    double
    size(const BoundingBox<dim> &box)
    {
      return box.get_boundary_points().first.distance(
        box.get_boundary_points().second);
    }
  } // namespace

  template <int dim>
  PolynomialChart<dim>::PolynomialChart(const unsigned int             order,
                                        const std::vector<Point<dim>> &points)
    : order(order)
    , points(points)
    , box(points)
  {
    AssertThrow(order > 0 && order <= largest_order &&
                  points.size() == Utilities::pow(order + 1, dim),
                ExcInternalError());
    // between its points a polynomial may reach a little further
    box.extend(.15 * size(box));
    const auto [value, gradient] = evaluate(center_of_unit_cell<dim>());
    middle                       = value;
    if (determinant(gradient) != 0.)
      start = invert(gradient);
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        std::size_t rest = i;
        for (unsigned int d = 0; d < dim; ++d, rest /= order + 1)
          reach = std::max(reach,
                           std::abs(guess(points[i])[d] -
                                    double(rest % (order + 1)) / order));
      }
    reach = 1e-6 + 1.3 * reach;
  }

  template <int dim>
  Point<dim>
  PolynomialChart<dim>::guess(const Point<dim> &point) const
  {
    return center_of_unit_cell<dim>() + start * (point - middle);
  }

  template <int dim>
  bool
  PolynomialChart<dim>::may_hold(const Point<dim> &point) const
  {
    const auto unit = guess(point);
    for (unsigned int d = 0; d < dim; ++d)
      if (unit[d] < -reach || unit[d] > 1. + reach)
        return false;
    return true;
  }

  template <int dim>
  std::pair<Point<dim>, Tensor<2, dim>>
  PolynomialChart<dim>::evaluate(const Point<dim> &unit) const
  {
    const auto        basis  = make_basis(order, unit);
    const std::size_t n_rows = points.size() / (order + 1);
    const Point<dim> *point  = points.data();
    Point<dim>        value;
    // rows of derivatives by one coordinate
    std::array<Tensor<1, dim>, dim> slopes;
    for (std::size_t row = 0; row < n_rows; ++row)
      {
        // numbers of their own stay in registers
        double row_value[dim] = {}, row_slope[dim] = {};
        for (unsigned int i = 0; i <= order; ++i, ++point)
          for (unsigned int d = 0; d < dim; ++d)
            {
              row_value[d] += basis[0].values[i] * (*point)[d];
              row_slope[d] += basis[0].slopes[i] * (*point)[d];
            }
        const unsigned int j = row % (order + 1), k = row / (order + 1);
        const double       z  = dim == 3 ? basis[dim - 1].values[k] : 1.;
        const double       yz = basis[1].values[j] * z;
        for (unsigned int d = 0; d < dim; ++d)
          {
            value[d] += yz * row_value[d];
            slopes[0][d] += yz * row_slope[d];
            slopes[1][d] += basis[1].slopes[j] * z * row_value[d];
            if constexpr (dim == 3)
              slopes[2][d] +=
                basis[1].values[j] * basis[2].slopes[k] * row_value[d];
          }
      }
    Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[i][j] = slopes[j][i];
    return {value, gradient};
  }

  template <int dim>
  Point<dim>
  PolynomialChart<dim>::push_forward(const Point<dim> &unit) const
  {
    const auto        basis  = make_basis(order, unit);
    const std::size_t n_rows = points.size() / (order + 1);
    const Point<dim> *point  = points.data();
    Point<dim>        value;
    for (std::size_t row = 0; row < n_rows; ++row)
      {
        Tensor<1, dim> row_value;
        for (unsigned int i = 0; i <= order; ++i, ++point)
          row_value += basis[0].values[i] * (*point);
        const double weight =
          basis[1].values[row % (order + 1)] *
          (dim == 3 ? basis[dim - 1].values[row / (order + 1)] : 1.);
        value += weight * row_value;
      }
    return value;
  }

  template <int dim>
  Tensor<2, dim>
  PolynomialChart<dim>::gradient(const Point<dim> &unit) const
  {
    return evaluate(unit).second;
  }

  template <int dim>
  std::optional<Point<dim>>
  PolynomialChart<dim>::pull_back(const Point<dim> &point) const
  {
    // A corner on a smooth boundary has no angle, hence no inverse.
    const double round_off = 1e-14 * size(box);
    for (unsigned int vertex = 0; vertex < (1U << dim); ++vertex)
      {
        std::size_t index = 0;
        for (unsigned int d = 0; d < dim; ++d)
          if ((vertex >> d) & 1U)
            index += order * Utilities::pow(order + 1, d);
        if (points[index].distance(point) < round_off)
          return GeometryInfo<dim>::unit_cell_vertex(vertex);
      }

    const double overlap = 1e-7, largest_overlap = .25, converged = 1e-8;
    Point<dim>   unit = guess(point);
    for (unsigned int iteration = 0; iteration < 25; ++iteration)
      {
        const auto [value, gradient] = evaluate(unit);
        if (determinant(gradient) == 0.)
          return {};
        Point<dim> next = unit + invert(gradient) * (point - value);
        for (unsigned int d = 0; d < dim; ++d)
          next[d] = std::clamp(next[d], -largest_overlap, 1. + largest_overlap);
        // The error after a step is about the square of the step.
        const double step = next.distance(unit);
        unit              = next;
        if (step < converged)
          {
            for (unsigned int d = 0; d < dim; ++d)
              if (unit[d] < -overlap || unit[d] > 1. + overlap)
                return {};
            return unit;
          }
      }
    return {};
  }

  template <int dim>
  const BoundingBox<dim> &
  PolynomialChart<dim>::bounding_box() const
  {
    return box;
  }

  template <int dim>
  bool
  PolynomialChart<dim>::is_regular() const
  {
    const double      orientation = determinant(start);
    const QGauss<dim> inside(order + 1);
    return std::all_of(inside.get_points().begin(),
                       inside.get_points().end(),
                       [&](const Point<dim> &unit) {
                         return orientation * determinant(gradient(unit)) > 0.;
                       });
  }

  template <int dim>
  struct PolynomialManifold<dim>::Atlas
  {
    std::vector<PolynomialChart<dim>>                charts;
    RTree<std::pair<BoundingBox<dim>, unsigned int>> boxes;
  };

  template <int dim>
  PolynomialManifold<dim>::PolynomialManifold(
    std::vector<PolynomialChart<dim>> charts)
  {
    std::vector<std::pair<BoundingBox<dim>, unsigned int>> boxes;
    for (unsigned int i = 0; i < charts.size(); ++i)
      boxes.emplace_back(charts[i].bounding_box(), i);
    atlas = std::make_shared<const Atlas>(
      Atlas{std::move(charts), pack_rtree(boxes)});
  }

  template <int dim>
  std::unique_ptr<Manifold<dim>>
  PolynomialManifold<dim>::clone() const
  {
    return std::make_unique<PolynomialManifold<dim>>(*this);
  }

  template <int dim>
  const PolynomialChart<dim> &
  PolynomialManifold<dim>::find_chart(
    const ArrayView<const Point<dim>> &points,
    const ArrayView<Point<dim>>       &unit_points) const
  {
    namespace bgi = boost::geometry::index;
    boost::container::small_vector<unsigned int, 32> candidates;
    for (const auto &[box, index] :
         atlas->boxes | bgi::adaptors::queried(bgi::contains(points[0])))
      candidates.push_back(index);
    std::sort(candidates.begin(), candidates.end());
    for (const unsigned int index : candidates)
      {
        const auto &chart = atlas->charts[index];
        bool        holds = std::all_of(points.begin(),
                                 points.end(),
                                 [&](const Point<dim> &point) {
                                   return chart.may_hold(point);
                                 });
        for (unsigned int i = 0; holds && i < points.size(); ++i)
          if (const auto unit = chart.pull_back(points[i]))
            unit_points[i] = *unit;
          else
            holds = false;
        if (holds)
          return chart;
      }
    AssertThrow(false,
                ExcMessage("No coarse cell holds all points that a new one "
                           "should lie between."));
    return atlas->charts[0];
  }

  template <int dim>
  void
  PolynomialManifold<dim>::get_new_points(
    const ArrayView<const Point<dim>> &surrounding_points,
    const Table<2, double>            &weights,
    ArrayView<Point<dim>>              new_points) const
  {
    boost::container::small_vector<Point<dim>, 32> unit_points(
      surrounding_points.size());
    const auto &chart =
      find_chart(surrounding_points,
                 make_array_view(unit_points.begin(), unit_points.end()));
    for (unsigned int row = 0; row < weights.size(0); ++row)
      {
        Point<dim> unit;
        for (unsigned int i = 0; i < unit_points.size(); ++i)
          unit += weights(row, i) * unit_points[i];
        new_points[row] = chart.push_forward(unit);
      }
  }

  template <int dim>
  Point<dim>
  PolynomialManifold<dim>::get_new_point(
    const ArrayView<const Point<dim>> &surrounding_points,
    const ArrayView<const double>     &weights) const
  {
    Table<2, double> row(1, weights.size());
    std::copy(weights.begin(), weights.end(), &row(0, 0));
    Point<dim> point;
    get_new_points(surrounding_points, row, ArrayView<Point<dim>>(&point, 1));
    return point;
  }

  template <int dim>
  Tensor<1, dim>
  PolynomialManifold<dim>::get_tangent_vector(const Point<dim> &from,
                                              const Point<dim> &to) const
  {
    const std::array<Point<dim>, 2> points = {{from, to}};
    std::array<Point<dim>, 2>       unit;
    const auto                     &chart =
      find_chart(ArrayView<const Point<dim>>(points.data(), 2),
                 ArrayView<Point<dim>>(unit.data(), 2));
    return chart.gradient(unit[0]) * (unit[1] - unit[0]);
  }

  template class PolynomialChart<2>;
  template class PolynomialChart<3>;
  template class PolynomialManifold<2>;
  template class PolynomialManifold<3>;
} // namespace Signoton
