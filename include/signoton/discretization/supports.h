#ifndef signoton_discretization_supports_h
#define signoton_discretization_supports_h

#include <signoton/discretization/space.h>

namespace Signoton
{
  /**
   * The conditions on the displacement node by node, for time integration
   * with a diagonal mass: it moves nodes one by one, and a condition is a
   * projection of the acceleration, orthogonal since all components of a node
   * have the same mass.
   */
  template <int dim>
  class Supports
  {
  public:
    /** A node that is not free: where its unknowns stand in the local part of
     *  a vector, what is left of its accelerations, and how all its components
     *  follow those that the constraints leave free: $u=Tu_\text{free}$ with
     *  zero columns for the others. */
    struct Node
    {
      std::array<unsigned int, dim> index;
      Tensor<2, dim>                projector;
      Tensor<2, dim>                follow;
    };

    /** Collect the nodes of the current mesh. The constraints of the space
     *  must be those of the conditions. */
    void
    reinit(const Space<dim> &space, const BoundaryConditions<dim> &conditions);

    /** Take away what the supports take. */
    void
    project(VectorType &acceleration) const;

    /** Let the forces on components that follow others act on those: $T^Tf$. */
    void
    condense(VectorType &force) const;

    /** Set the prescribed components of the velocity, constant over a step,
     *  such that the displacement is the prescribed one at its end.
     *  @param displacement at the begin of the step
     *  @param time at the begin of the step */
    void
    move(const VectorType &displacement,
         const double      time,
         const double      time_step,
         VectorType       &velocity);

    /** Set the components with a prescribed displacement. */
    void
    place(VectorType &displacement, const double time) const;

    const std::vector<Node> &
    nodes() const
    {
      return supported;
    }

    /** Local indices of the components with a prescribed motion. */
    std::vector<unsigned int>
    moved() const;

  private:
    /** A component with a prescribed displacement or velocity. */
    struct Motion
    {
      unsigned int            index;
      Point<dim>              point;
      SpaceTimeFunction<dim> *function;
      bool                    is_velocity;
    };

    std::vector<Node>   supported;
    std::vector<Motion> motions;
  };

  /** Unknowns of the nodes of a cell: entry d of node n is the number in the
   *  cell of component d. */
  template <int dim>
  std::vector<std::array<unsigned int, dim>>
  nodes_of_cell(const FiniteElement<dim> &fe);
} // namespace Signoton

#endif
