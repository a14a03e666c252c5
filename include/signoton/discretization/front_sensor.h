#ifndef signoton_discretization_front_sensor_h
#define signoton_discretization_front_sensor_h

#include <deal.II/distributed/tria.h>
#include <deal.II/lac/la_parallel_vector.h>

namespace Signoton
{
  using namespace dealii;

  /**
   * What shock viscosity has to know of the neighbors of a cell: whether the
   * motion varies from cell to cell as at a front, and whether anything presses
   * on the cell from outside.
   *
   * Each cell tells some numbers of itself, look_around() compares them. All
   * are those of the step before, so that a sweep over the cells does not have
   * to wait for its neighbors.
   */
  template <int dim>
  class FrontSensor
  {
  public:
    /** Entries of the rate of the mean strain of a cell, in 1/s; shear entries
     *  times $\sqrt 2$, so that the product of two tensors is that of the
     *  numbers. They come first among the numbers of a cell. */
    static constexpr unsigned int n_rates = dim == 2 ? 4 : 6;

    /** Where the other numbers of a cell stand. */
    enum Number : unsigned int
    {
      /** Size of the largest traction lately, in Pa, on planes across each
       *  axis of the cell. */
      traction = n_rates,
      voids = traction + dim, ///< dilatation of the contacts, if they are open
      /** Traction of the law in the directions of closing, as the strain of
       *  plane waves. */
      elastic,
      fresh,     ///< 1 where a front has just closed the contacts, fading
      sharp,     ///< see sharpness(), fading
      viscous,   ///< mean of the normal stresses of shock viscosity, in Pa
      viscosity, ///< against shear, in Pa s
      n_numbers
    };

    /** Find the neighbors of all own cells, also across periodic faces. */
    void
    reinit(const parallel::distributed::Triangulation<dim> &mesh);

    bool
    empty() const
    {
      return first.empty();
    }

    /** The place of an own cell in what follows. */
    unsigned int
    index(const typename Triangulation<dim>::active_cell_iterator &cell) const
    {
      return place[cell->active_cell_index()];
    }

    /** The numbers of a cell. */
    double *
    operator[](const unsigned int cell)
    {
      return data.begin() + n_numbers * cell;
    }

    const double *
    operator[](const unsigned int cell) const
    {
      return data.begin() + n_numbers * cell;
    }

    /** Compare all cells with their neighbors. Collective. */
    void
    look_around();

    /**
     * Between 0, where the strain rate is smooth, and 1, where it jumps: by how
     * much it exceeds the mean of both sides, relative to the size of all three,
     * in the direction in which that is largest, to the third power, which lets
     * waves of twenty cells pass. What is a thousand times slower than the
     * fastest cell has none: its differences may be round-off.
     *
     * It is kept for a while, since peaks that travel from cell to cell would
     * otherwise be damped in steps, which are new peaks: in a smooth wave that
     * grows to a staircase.
     */
    double
    sharpness(const unsigned int cell) const
    {
      return (*this)[cell][sharp];
    }

    /** The direction from one face of an own cell to the opposite one. */
    const Tensor<1, dim> &
    axis(const unsigned int cell, const unsigned int d) const
    {
      return axes[dim * cell + d];
    }

    /** Size of the rate of strain along an axis of an own cell, in 1/s. */
    double
    stretching(const unsigned int cell, const unsigned int d) const;

    /** How strongly in Pa a cell with voids may be pushed from outside: by the
     *  traction of its neighbors without voids, in the directions in which it
     *  moves. Infinite if there are none. */
    double
    support(const unsigned int cell) const
    {
      return pressed[cell];
    }

    /** Norm of the rate of strain of the fastest cell of all ranks, in 1/s. */
    double
    fastest() const
    {
      return fastest_rate;
    }

    std::size_t
    memory_consumption() const;

  private:
    /** Of the rate, squared. */
    double
    norm_square(const unsigned int cell) const;
    double
    find_sharpness(const unsigned int cell) const;
    double
    find_support(const unsigned int cell) const;

    LinearAlgebra::distributed::Vector<double> data; ///< also of ghosts
    std::vector<double>                        pressed;
    double                                     fastest_rate = 0.;
    std::vector<unsigned int> place; ///< of cells, by active cell index
    /** Neighbors at face f of cell i begin at entry 2*dim*i+f of `first`. */
    std::vector<unsigned int> first, neighbors;
    /** Which axis of the neighbor is across the face. */
    std::vector<unsigned char> across;
    /** Of each face: size of the cell by the distance to the neighbor. */
    std::vector<float>          nearness;
    std::vector<Tensor<1, dim>> axes; ///< unit vectors
  };
} // namespace Signoton

#endif
