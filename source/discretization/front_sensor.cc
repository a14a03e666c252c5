#include <signoton/discretization/front_sensor.h>

#include <limits>

namespace Signoton
{
  namespace
  {
    /** The number of a face, also a periodic one, in the cell across it. */
    template <typename Cell>
    unsigned int
    face_of_neighbor(const Cell        &cell,
                     const unsigned int f,
                     const bool         is_coarser)
    {
      if (cell->has_periodic_neighbor(f))
        return is_coarser ?
                 cell->periodic_neighbor_of_coarser_periodic_neighbor(f).first :
                 cell->periodic_neighbor_face_no(f);
      return is_coarser ? cell->neighbor_of_coarser_neighbor(f).first :
                          cell->neighbor_face_no(f);
    }
  } // namespace

  template <int dim>
  void
  FrontSensor<dim>::reinit(
    const parallel::distributed::Triangulation<dim> &mesh)
  {
    const auto by_cell = mesh.global_active_cell_index_partitioner().lock();
    IndexSet   own(n_numbers * by_cell->size()),
      ghosts(n_numbers * by_cell->size());
    const auto begin = n_numbers * by_cell->local_range().first;
    own.add_range(begin, n_numbers * by_cell->local_range().second);
    for (const auto ghost : by_cell->ghost_indices())
      ghosts.add_range(n_numbers * ghost, n_numbers * (ghost + 1));
    data.reinit(own, ghosts, mesh.get_communicator());

    place.assign(mesh.n_active_cells(), numbers::invalid_unsigned_int);
    for (const auto &cell : mesh.active_cell_iterators())
      if (!cell->is_artificial())
        place[cell->active_cell_index()] =
          by_cell->global_to_local(cell->global_active_cell_index());

    const unsigned int n_own = by_cell->locally_owned_size();
    std::vector<typename Triangulation<dim>::cell_iterator> cells(n_own);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned())
        cells[index(cell)] = cell;
    first.assign(1, 0);
    neighbors.clear();
    across.clear();
    nearness.clear();
    axes.clear();
    for (const auto &cell : cells)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            const Tensor<1, dim> extent =
              cell->face(2 * d + 1)->center() - cell->face(2 * d)->center();
            axes.push_back(extent / extent.norm());
          }
        for (const auto f : cell->face_indices())
          {
            // of sizes one, two and a half, between centers
            nearness.push_back(1.);
            const bool beyond = cell->has_periodic_neighbor(f);
            if (beyond || !cell->at_boundary(f))
              {
                const auto neighbor = cell->neighbor_or_periodic_neighbor(f);
                const bool is_coarser =
                  beyond ? cell->periodic_neighbor_is_coarser(f) :
                           cell->neighbor_is_coarser(f);
                const unsigned int face = face_of_neighbor(cell, f, is_coarser);
                const unsigned int n =
                  neighbor->is_active() ?
                    1 :
                    GeometryInfo<dim>::max_children_per_face;
                for (unsigned int s = 0; s < n; ++s)
                  {
                    const auto other =
                      n == 1 ? neighbor :
                      beyond ? cell->periodic_neighbor_child_on_subface(f, s) :
                               cell->neighbor_child_on_subface(f, s);
                    neighbors.push_back(place[other->active_cell_index()]);
                    across.push_back(face / 2);
                  }
                if (is_coarser)
                  nearness.back() = 1. / 1.5;
              }
            if (neighbors.size() > first.back() + 1)
              nearness.back() = 1. / 0.75;
            first.push_back(neighbors.size());
          }
      }
    pressed.assign(n_own, std::numeric_limits<double>::infinity());
  }

  template <int dim>
  double
  FrontSensor<dim>::norm_square(const unsigned int cell) const
  {
    double result = 0.;
    for (unsigned int i = 0; i < n_rates; ++i)
      result += (*this)[cell][i] * (*this)[cell][i];
    return result;
  }

  template <int dim>
  double
  FrontSensor<dim>::find_sharpness(const unsigned int cell) const
  {
    const double *own    = (*this)[cell];
    const double  square = norm_square(cell);
    if (!(square > 1e-30 * fastest_rate * fastest_rate))
      return 0.;
    const double size    = std::sqrt(square);
    double       largest = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // how far the rate is above the mean of both sides, and the mean size
        double above = square, sum = 0.5 * size;
        for (const unsigned int face : {2 * d, 2 * d + 1})
          {
            const unsigned int begin = first[2 * dim * cell + face],
                               end   = first[2 * dim * cell + face + 1];
            double product = 0., sizes = 0.;
            for (unsigned int n = begin; n < end; ++n)
              {
                for (unsigned int i = 0; i < n_rates; ++i)
                  product += own[i] * (*this)[neighbors[n]][i];
                sizes += std::sqrt(norm_square(neighbors[n]));
              }
            // at the boundary as if it went on
            if (begin < end)
              above -= 0.5 * (square + nearness[2 * dim * cell + face] *
                                         (product / (end - begin) - square));
            else
              above -= 0.5 * square;
            sum += 0.25 * (begin < end ? sizes / (end - begin) : size);
          }
        largest = std::max(largest, above / (size * sum));
      }
    const double x = std::min(2.25 * largest, 1.);
    return x * x * x * square / (square + 1e-6 * fastest_rate * fastest_rate);
  }

  template <int dim>
  double
  FrontSensor<dim>::stretching(const unsigned int cell,
                               const unsigned int d) const
  {
    const Tensor<1, dim> &a    = axis(cell, d);
    const double         *rate = (*this)[cell];
    double                sum  = 0.;
    unsigned int          k    = 3;
    for (unsigned int i = 0; i < dim; ++i)
      {
        sum += a[i] * a[i] * rate[i];
        for (unsigned int j = i + 1; j < dim; ++j)
          sum += std::sqrt(2.) * a[i] * a[j] * rate[k++];
      }
    return std::abs(sum);
  }

  template <int dim>
  double
  FrontSensor<dim>::find_support(const unsigned int cell) const
  {
    // neighbors with a tenth of the voids count as closed in part
    const double part   = 0.1 * (*this)[cell][voids];
    double       result = std::numeric_limits<double>::infinity();
    if (!(part > 0.))
      return result;
    // Neighbors beside a cell that moves toward others hold nothing: a direction
    // counts by its share of the motion, not at all if that may be noise.
    std::array<double, dim> share{};
    double                  sum = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      sum += share[d] = stretching(cell, d);
    for (unsigned int d = 0; d < dim; ++d)
      if (share[d] > 1e-3 * sum)
        for (unsigned int n = first[2 * (dim * cell + d)];
             n < first[2 * (dim * cell + d + 1)];
             ++n)
          {
            const double *other = (*this)[neighbors[n]];
            if (other[voids] < part)
              result = std::min(result,
                                other[traction + across[n]] /
                                  (1. - other[voids] / part) * sum / share[d]);
          }
    return result;
  }

  template <int dim>
  void
  FrontSensor<dim>::look_around()
  {
    data.update_ghost_values();
    double fastest_square = 0.;
    for (unsigned int cell = 0; cell < pressed.size(); ++cell)
      fastest_square = std::max(fastest_square, norm_square(cell));
    fastest_rate = std::sqrt(
      Utilities::MPI::max(fastest_square, data.get_mpi_communicator()));
    for (unsigned int cell = 0; cell < pressed.size(); ++cell)
      {
        double &jumps = (*this)[cell][sharp];
        jumps         = std::max(jumps, find_sharpness(cell));
        pressed[cell] = find_support(cell);
      }
    data.zero_out_ghost_values();
  }

  template <int dim>
  std::size_t
  FrontSensor<dim>::memory_consumption() const
  {
    return sizeof(double) *
             (data.locally_owned_size() +
              data.get_partitioner()->n_ghost_indices() + pressed.size()) +
           sizeof(unsigned int) *
             (place.size() + first.size() + neighbors.size()) +
           across.size() + sizeof(float) * nearness.size() +
           sizeof(Tensor<1, dim>) * axes.size();
  }

  template class FrontSensor<2>;
  template class FrontSensor<3>;
} // namespace Signoton
