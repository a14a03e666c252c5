#ifndef signoton_drivers_explicit_dynamics_h
#define signoton_drivers_explicit_dynamics_h

#include <signoton/drivers/dynamics.h>

namespace Signoton
{
  /**
   * Central differences: from displacement, velocity and acceleration at $t_n$,
   * $$ v_{n+1/2}=v_n+\tfrac{\tau}{2}a_n,\quad u_{n+1}=u_n+\tau v_{n+1/2},\quad
   *    Ma_{n+1}=L-F(u_{n+1})-Cv_{n+1},\quad
   *    v_{n+1}=v_{n+1/2}+\tfrac{\tau}{2}a_{n+1}, $$
   * of second order, stable for $\tau$ up to the time in which the fastest wave
   * crosses the smallest cell. Over a step, $\tfrac12 v\cdot Mv-
   * \tfrac{\tau^2}{8}a\cdot Ma$ changes by the work of the mean of the forces
   * at both ends, to round-off: the receipt is built on that. Where loads jump,
   * one step ends with the force before the jump, the next begins with the one
   * behind it.
   */
  template <int dim>
  class ExplicitDynamics : public Dynamics<dim>
  {
  public:
    using Dynamics<dim>::Dynamics;

  protected:
    void
    setup() override;

    /** Steps of one size up to the next time to meet. */
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
    using Dynamics<dim>::loads;
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

    /** What a cell must not exceed to be skipped, see
     *  Mechanics::dynamic_force(). */
    double
    quiet_displacement();

    /** From $t_n$ to velocities in the middle of the step and displacements at
     *  its end.
     *  @return twice the kinetic energy of prescribed motions, and $a\cdot
     *    Ma$, at $t_n$ on this rank */
    std::pair<double, double>
    move();

    /** Add a step to the receipt. */
    void
    account(const DynamicSums &own, const std::pair<double, double> &before);

    double       largest_displacement = 0.; ///< so far, in m
    double       quiet_share          = 0.; ///< of the cells, in the last step
    double       stable_step          = 0.; ///< with shock viscosity, in s
    double       next_to_meet         = 0.; ///< in s
    unsigned int steps_left           = 0;  ///< up to there
  };
} // namespace Signoton

#endif
