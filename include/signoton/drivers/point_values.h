#ifndef signoton_drivers_point_values_h
#define signoton_drivers_point_values_h

#include <signoton/discretization/point_locator.h>
#include <signoton/drivers/state.h>
#include <signoton/operators/mechanics.h>

namespace Signoton
{
  /**
   * Fields at given points. Those of the nodes are what the elements say. All else is known at the quadrature points of a cell; at a point it is
   * the polynomial through them, of the degree of the displacement, which is
   * exact for what varies so in a cell. Where cells of one material share a
   * point it is the mean of theirs. Beyond the outer quadrature points a
   * polynomial extrapolates: a stress there may be a little outside of the
   * admissible set. The region is that of the closest quadrature point, the
   * most advanced of several.
   *
   * What interpolates is kept until the mesh changes; an evaluation visits the
   * cells of the points and no others.
   */
  template <int dim>
  class PointValues
  {
  public:
    /** All arguments must outlive the object. */
    PointValues(const Space<dim>  &space,
                Mechanics<dim>    &mechanics,
                PointLocator<dim> &locator);

    /** By point, and by target of the locator. */
    struct Values
    {
      std::vector<std::vector<Tensor<1, dim>>> nodal; ///< for each field
      std::vector<PointState>                  states;
    };

    /** On all ranks.
     *  @param state with ghost values in its fields */
    Values
    evaluate(const State &state, const bool with_states);

  private:
    /** How a place is interpolated. */
    struct Stencil
    {
      unsigned int                         target, point, cell;
      double                               share_of_target, share_of_point;
      std::vector<types::global_dof_index> dofs;
      std::vector<double>                  shape;   ///< of each dof
      std::vector<double>                  weight;  ///< of quadrature points
      std::vector<unsigned int>            closest; ///< quadrature points
    };

    void
    update();

    void
    add_states(const std::vector<PointState> &at_points, Values &values) const;

    const Space<dim>                  &space;
    Mechanics<dim>                    &mechanics;
    PointLocator<dim>                 &locator;
    std::vector<Stencil>               stencils;
    std::vector<unsigned int>          cells; ///< as the mechanics has them
    unsigned int                       n_points;
    bool                               is_current = false;
    boost::signals2::scoped_connection mesh_changes;
  };
} // namespace Signoton

#endif
