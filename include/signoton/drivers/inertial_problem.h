#ifndef signoton_drivers_inertial_problem_h
#define signoton_drivers_inertial_problem_h

#include <signoton/drivers/static_problem.h>
#include <signoton/operators/absorbing_boundary.h>

namespace Signoton
{
  /**
   * The minimization that an implicit step of dynamics is: that of statics with
   * the inertia of a diagonal mass and the dashpots of absorbing boundaries,
   * $$ J(u)=\int W_n(\varepsilon(u))+\tfrac m2(u-\tilde u)\cdot M(u-\tilde u)
   *    +\tfrac c2(u-\tilde u)\cdot C(u-\tilde u)-p\cdot u, $$
   * where the displacement $\tilde u$ would need no acceleration at the end of
   * the step, and the force p is all that does not depend on the solution.
   */
  template <int dim>
  class InertialProblem : public StaticProblem<dim>
  {
  public:
    /** The last three arguments must outlive the object. */
    InertialProblem(Model<dim>                   &model,
                    const Supports<dim>          &supports,
                    const AbsorbingBoundary<dim> &absorbing,
                    const VectorType             &mass);

    /** The part of a step that the solution does not change. Prescribed
     *  components of @p predicted are those of the solution, of @p pull zero.
     *  @param inertia m in 1/s^2
     *  @param damping c in 1/s */
    void
    set_step(const double      inertia,
             const double      damping,
             const VectorType &predicted,
             const VectorType &pull);

    double
    evaluate(const VectorType &u,
             VectorType       &gradient,
             const bool        linearize) override;

    double
    force_scale(const VectorType &u) override;

    double
    round_off(const VectorType &u) override;

  protected:
    void
    complete(TrilinosWrappers::SparseMatrix &matrix) override;

  private:
    const Supports<dim>          &supports;
    const AbsorbingBoundary<dim> &absorbing;
    const VectorType             &mass;

    double     inertia = 0., damping = 0.;
    VectorType predicted, pull;
    VectorType way, force; ///< $u-\tilde u$ and $mM(u-\tilde u)$
  };
} // namespace Signoton

#endif
