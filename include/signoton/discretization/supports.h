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
     *  a vector; P and T of HeldNode. */
    struct Node
    {
      std::array<unsigned int, dim> index;
      Tensor<2, dim>                projector;
      Tensor<2, dim>                follow;

      Tensor<1, dim>
      read(const VectorType &vector) const
      {
        Tensor<1, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = vector.local_element(index[d]);
        return value;
      }

      void
      write(const Tensor<1, dim> &value, VectorType &vector) const
      {
        for (unsigned int d = 0; d < dim; ++d)
          vector.local_element(index[d]) = value[d];
      }

      /** The part of a vector that the conditions determine. */
      Tensor<1, dim>
      held_part(const VectorType &vector) const
      {
        const Tensor<1, dim> value = read(vector);
        return value - projector * value;
      }

      /** Set this part, and leave the rest. */
      void
      set_held_part(const Tensor<1, dim> &part, VectorType &vector) const
      {
        write(projector * read(vector) + part, vector);
      }
    };

    /** Collect the nodes of the current mesh. The constraints of the space
     *  must be those of the conditions. Both arguments must outlive the
     *  present mesh. */
    void
    reinit(const Space<dim> &space, const BoundaryConditions<dim> &conditions);

    /** Take away what the supports take. */
    void
    project(VectorType &acceleration) const;

    /** Take away velocity against supports that are at rest. */
    void
    stop(VectorType &velocity) const;

    /** Let the forces on components that follow others act on those: $T^Tf$. */
    void
    condense(VectorType &force) const;

    /** Set the velocity that conditions prescribe, constant over a step, such
     *  that the displacement is the prescribed one at its end.
     *  @param displacement at the begin of the step
     *  @param time at the begin of the step */
    void
    move(const VectorType &displacement,
         const double      time,
         const double      time_step,
         VectorType       &velocity) const;

    /** Set the displacement that conditions on it prescribe. */
    void
    place(VectorType &displacement, const double time) const;

    const std::vector<Node> &
    nodes() const
    {
      return supported;
    }

    /** Those of them with a prescribed motion. */
    const std::vector<Node> &
    moving() const
    {
      return moved;
    }

  private:
    std::vector<Node> supported, moved;
    /** Where the moving ones stand in the space. */
    std::vector<const HeldNode<dim> *> moved_by;
    const BoundaryConditions<dim>     *conditions = nullptr;
  };
} // namespace Signoton

#endif
