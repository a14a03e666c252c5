#ifndef signoton_drivers_implicit_dynamics_h
#define signoton_drivers_implicit_dynamics_h

#include <signoton/drivers/dynamics.h>
#include <signoton/drivers/equilibrium_problem.h>
#include <signoton/operators/inertia.h>

namespace Signoton
{
  /**
   * Steps longer than the time in which a wave crosses a cell, by the
   * generalized-alpha method (Chung and Hulbert, J. Appl. Mech. 60 (1993)). With
   * the spectral radius r of infinitely fast oscillations and Newmark's
   * $$ u_{n+1}=u_n+\tau v_n+\tau^2((\tfrac12-\beta)a_n+\beta a_{n+1}),\quad
   *    v_{n+1}=v_n+\tau((1-\gamma)a_n+\gamma a_{n+1}), $$
   * the equation of motion is, multiplied by 1+r,
   * $$ M((2-r)a_{n+1}+(2r-1)a_n)+(F+Cv-L)_{n+1}+r(F+Cv-L)_n=0,\quad
   *    \beta=(1+r)^{-2},\ \gamma=\tfrac12+\tfrac{1-r}{1+r}. $$
   * Second order, and unconditionally stable for linear materials. Since forces
   * are mixed rather than evaluated in between, the material takes whole steps,
   * and each is a convex minimization, solved as in statics.
   *
   * Steps are chosen by the local error of the displacement, about
   * $(\beta-\tfrac16)\tau^2(a_{n+1}-a_n)$ (Zienkiewicz and Xie, Earthquake Eng.
   * Struct. Dyn. 20 (1991)), in the norm of the mass. They do not go below the
   * stable step of central differences for its sake.
   */
  template <int dim>
  class ImplicitDynamics : public Dynamics<dim>
  {
  public:
    ImplicitDynamics(Model<dim> &model, const DynamicAnalysis<dim> &analysis);

  protected:
    void
    setup() override;
    void
    choose_step() override;
    void
    step() override;

    std::string
    introduction() const override;
    void
    add_columns(CSVTable::Row &row) const override;
    std::pair<std::string, std::string>
    screen_column() const override;
    std::vector<std::pair<std::string, double *>>
    numbers_to_keep() override;

  private:
    using Dynamics<dim>::model;
    using Dynamics<dim>::analysis;
    using Dynamics<dim>::supports;
    using Dynamics<dim>::absorbing;
    using Dynamics<dim>::displacement;
    using Dynamics<dim>::velocity;
    using Dynamics<dim>::acceleration;
    using Dynamics<dim>::mass;
    using Dynamics<dim>::internal;
    using Dynamics<dim>::external;
    using Dynamics<dim>::dashpots;
    using Dynamics<dim>::old_internal;
    using Dynamics<dim>::old_external;
    using Dynamics<dim>::old_dashpots;
    using Dynamics<dim>::receipt;
    using Dynamics<dim>::time;
    using Dynamics<dim>::time_step;
    using Dynamics<dim>::n_steps;

    /** The motion at one end of a step. */
    struct Motion
    {
      VectorType displacement, velocity, acceleration;
    };

    /** Where loads jump, so do accelerations; the steps begin anew. */
    void
    restart_at_jump();

    /** The end of a step of the size wanted next: not beyond a time to meet, and
     *  shorter where loads vary within it. */
    double
    end_of_step(const double start);

    /** Say once that loads do what the steps do not see. */
    void
    warn_of_loads(const double start, const double bend);

    /** Solve for the end of the step of size `time_step`. */
    NewtonResult
    solve(Motion &trial);

    /** The local error in the displacement, relative to the largest one. */
    double
    local_error(const Motion &trial) const;

    void
    accept(const Motion &trial);

    /** Add the step to the receipt.
     *  @param before the state at its begin */
    void
    account(const DynamicSums &own, const Motion &before);

    double
    norm(const VectorType &vector) const;

    double
    shortest_step() const;

    const double radius;
    const double beta, gamma;
    /** The displacement that needs no acceleration at the end of the step, and
     *  the forces that do not depend on the solution. */
    VectorType              predicted, pull;
    Inertia<dim>            inertia;
    Dashpots<dim>           resistance;
    EquilibriumProblem<dim> problem;
    Newton                  newton;

    bool   has_warned        = false;
    bool   is_automatic      = true;
    double stable_step       = 0.; ///< of central differences
    double next_step         = 0.;
    double largest           = 0.; ///< norm of displacements so far
    double error             = 0.; ///< of the last step
    double newton_iterations = 0., linear_iterations = 0., rejected = 0.;
  };
} // namespace Signoton

#endif
