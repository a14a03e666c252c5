#ifndef signoton_discretization_stress_jumps_h
#define signoton_discretization_stress_jumps_h

#include <signoton/discretization/boundary_conditions.h>
#include <signoton/discretization/space.h>

#include <boost/container/flat_map.hpp>

namespace Signoton
{
  /** How much the traction of the mean stress of a cell differs from those of
   *  its neighbors, or from what is given at the boundary. */
  template <int dim>
  class StressJumps
  {
  public:
    /**
     * @param mean_stress    of each own cell, by active cell index
     * @param initial_stress whose change from cell to cell is none of a wave;
     *   nullptr for none. Components as in Mechanics::InitialState
     * @param shear_modulus  by material
     * @param round_off      of the stresses in Pa: what jumps by less is at rest
     */
    StressJumps(const Space<dim>                           &space,
                const std::vector<SymmetricTensor<2, dim>> &mean_stress,
                const Function<dim>                        *initial_stress,
                const boost::container::flat_map<types::material_id, double>
                            &shear_modulus,
                const double round_off);

    void
    add_neighbors();

    /** By the loads at the time last set. */
    void
    add_boundary(const BoundaryConditions<dim> &conditions);

    /** The largest so far of each own cell, over the root of its shear modulus,
     *  in the root of Pa; by active cell index. */
    std::vector<double> values;

  private:
    using Cell = typename Triangulation<dim>::cell_iterator;

    SymmetricTensor<2, dim>
    initial(const Point<dim> &p) const;

    static Tensor<1, dim>
    normal(const Cell &cell, const unsigned int f);

    void
    enter(const Cell &cell, const Tensor<1, dim> &traction);

    const Space<dim>    &space;
    const Function<dim> *initial_stress;
    const boost::container::flat_map<types::material_id, double> &shear_modulus;
    const double                                                  round_off;
    std::vector<SymmetricTensor<2, dim>> stress; ///< but for the initial one
  };
} // namespace Signoton

#endif
