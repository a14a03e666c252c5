#ifndef signoton_operators_absorbing_boundary_h
#define signoton_operators_absorbing_boundary_h

#include <signoton/discretization/supports.h>
#include <signoton/rheology/material.h>

namespace Signoton
{
  /**
   * Dashpots that let waves leave: the traction $-\rho c_p\,v_n n-\rho c_s\,
   * v_t$ (Lysmer and Kuhlemeyer 1969), which absorbs plane waves that arrive
   * along the normal completely. Lumped to the nodes as the mass is.
   */
  template <int dim>
  class AbsorbingBoundary
  {
  public:
    /** Integrate on the current mesh; @p supports must be up to date. */
    void
    reinit(const Space<dim>                      &space,
           const std::vector<Rheology::Material> &materials,
           const BoundaryConditions<dim>         &conditions,
           const Supports<dim>                   &supports);

    bool
    empty() const
    {
      return nodes.empty();
    }

    /** Change accelerations $f/m$ to those under the dashpots as well, taken
     *  with the velocity at the end of the half step that they are for:
     *  $m a=f-C(v+\frac{\tau}{2}a)$.
     *  @param velocity  at the begin of the half step
     *  @param time_step $\tau$ of the whole step */
    void
    accelerate(const VectorType &mass,
               const VectorType &velocity,
               const double      time_step,
               VectorType       &acceleration) const;

    /** The forces $Cv$ on the nodes that have dashpots, added to @p force. */
    void
    add_force(const VectorType &velocity, VectorType &force) const;

    /** A node with dashpots; what the supports leave of it as in Supports. */
    struct Node : public Supports<dim>::Node
    {
      Tensor<2, dim> damping; ///< C in kg/s
    };

    const std::vector<Node> &
    damped_nodes() const
    {
      return nodes;
    }

  private:
    /** The columns of the matrices of all nodes, each in the form of a vector of
     *  unknowns. */
    static std::vector<VectorType>
    integrate(const Space<dim>                      &space,
              const std::vector<Rheology::Material> &materials,
              const BoundaryConditions<dim>         &conditions);

    /** The own nodes with dashpots, each once. */
    void
    collect(const Space<dim>              &space,
            const std::vector<VectorType> &columns,
            const Supports<dim>           &supports);

    std::vector<Node> nodes;
  };
} // namespace Signoton

#endif
