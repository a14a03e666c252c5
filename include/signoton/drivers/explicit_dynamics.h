#ifndef signoton_drivers_explicit_dynamics_h
#define signoton_drivers_explicit_dynamics_h

#include <signoton/drivers/receipt.h>
#include <signoton/drivers/run_output.h>
#include <signoton/operators/absorbing_boundary.h>
#include <signoton/operators/external_force.h>

namespace Signoton
{
  /**
   * Waves by central differences with a diagonal mass $M$: from displacement,
   * velocity and acceleration at $t_n$,
   * $$ v_{n+1/2}=v_n+\tfrac{\tau}{2}a_n,\quad u_{n+1}=u_n+\tau v_{n+1/2},\quad
   *    Ma_{n+1}=F(u_{n+1})-Cv_{n+1},\quad
   *    v_{n+1}=v_{n+1/2}+\tfrac{\tau}{2}a_{n+1}, $$
   * of second order, stable for $\tau$ up to the time in which the fastest wave
   * crosses the smallest cell. C are the dashpots of absorbing boundaries. Over
   * a step, $\tfrac12 v\cdot Mv-\tfrac{\tau^2}{8}a\cdot Ma$ changes by the work
   * of the mean of the forces at both ends, to round-off: the receipt is built
   * on that.
   */
  template <int dim>
  class ExplicitDynamics
  {
  public:
    explicit ExplicitDynamics(Model<dim> &model);

    /** Start from the initial state, or from a checkpoint. */
    ExitStatus
    run(const std::string &resume_directory = "");

    /** Throw what run() would throw before its first step. */
    void
    validate();

  private:
    /** Adapt to the mesh. */
    void
    setup();

    /** Steps of one size up to the end. */
    void
    choose_step();

    /** Velocities and forces at the start. */
    void
    start();

    void
    step();

    /** The loads at the present time. */
    void
    evaluate_loads();

    /** Accelerations by the present forces. */
    void
    accelerate();

    DynamicSums
    material_sums(const DynamicSums &own) const;

    double
    kinetic_energy() const;

    /** The numbers of the state, by name. */
    std::vector<std::pair<std::string, double *>>
    numbers_to_keep();
    void
    save();
    void
    resume(const std::string &directory);

    /** What a cell must not exceed to be skipped, see
     *  Mechanics::dynamic_force(). */
    double
    quiet_displacement();

    /** Statistics, fields and screen, as often as each is due. */
    void
    report();

    bool
    is_reported() const
    {
      return steps_left == 0 ||
             n_steps % model.time_integration.statistics_every == 0;
    }

    Model<dim>               &model;
    RunOutput<dim>            output;
    Supports<dim>             supports;
    AbsorbingBoundary<dim>    absorbing;
    SurfaceLoad<dim>          surface_load;
    std::vector<unsigned int> moved; ///< unknowns with a prescribed motion
    bool                      loads_vary = false; ///< in time
    bool                      remembers = false; ///< any material has a history

    VectorType displacement, velocity, acceleration;
    VectorType mass, inverse_mass;
    VectorType internal, external, dashpots;
    VectorType old_internal, old_external, old_dashpots;
    Receipt    receipt;
    /** Work of the internal force, and energy of the accelerations in the
     *  half steps, since the start. */
    double       internal_work = 0., half_steps = 0., initial_stored = 0.;
    double       largest_displacement = 0.; ///< so far, in m
    double       quiet_share          = 0.; ///< of the cells, in the last step
    double       time = 0., stable_step = 0., time_step = 0.;
    unsigned int n_steps = 0, steps_left = 0;
    unsigned int n_reported = 0, n_snapshots = 0, n_lines = 0;
    std::unique_ptr<PointSpace<dim>> history_space;
  };
} // namespace Signoton

#endif
