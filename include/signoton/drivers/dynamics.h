#ifndef signoton_drivers_dynamics_h
#define signoton_drivers_dynamics_h

#include <signoton/drivers/dynamic_analysis.h>
#include <signoton/drivers/loads.h>
#include <signoton/drivers/receipt.h>
#include <signoton/drivers/run_output.h>
#include <signoton/operators/absorbing_boundary.h>

namespace Signoton
{
  /**
   * Waves: the equation of motion $Ma+F(u)+Cv=L(t)$ with a diagonal mass M,
   * internal forces F, dashpots C of absorbing boundaries and loads L, from the
   * initial state to the end. Derived classes take the steps; here is what they
   * share, the state and all that is told about it.
   */
  template <int dim>
  class Dynamics
  {
  public:
    Dynamics(Model<dim> &model, const DynamicAnalysis<dim> &analysis);
    virtual ~Dynamics() = default;

    /** Start from the initial state, or from a checkpoint. */
    ExitStatus
    run(const std::string &resume_directory = "");

    /** Throw what run() would throw before its first step. */
    void
    validate();

  protected:
    /** Adapt to the mesh. */
    virtual void
    setup();

    /** Choose the size of the steps from the present time on. */
    virtual void
    choose_step() = 0;

    /** Go on to the next time: displacement, velocity, acceleration, forces,
     *  trial history and receipt. */
    virtual void
    step() = 0;

    /** What a scheme tells at its begin; of every step, in the statistics and
     *  in a column of the screen. */
    virtual std::string
    introduction() const = 0;
    virtual void
    add_columns(CSVTable::Row &row) const = 0;
    virtual std::pair<std::string, std::string>
    screen_column() const = 0;

    /** Numbers of the state of a scheme, by name, for checkpoints. */
    virtual std::vector<std::pair<std::string, double *>>
    numbers_to_keep();

    /** The loads at the present time, by those that vary. */
    void
    evaluate_loads();

    /** If loads jump at the present time, take those behind the jump.
     *  @return whether they do */
    bool
    pass_jump();

    /** Accelerations by the present forces.
     *  @param step in s if the velocity is that of the middle of a step, see
     *    AbsorbingBoundary::accelerate(); zero if it is the present one */
    void
    accelerate(const double step);

    /** The dashpots' forces at the present velocity. */
    void
    evaluate_dashpots();

    /** Enter a step into the receipt. All numbers are those of this rank.
     *  @param force_work of what balances in the equation of motion, but for
     *    the change of the kinetic energy; what the material has not got of it
     *    is lost by time stepping
     *  @param outer_work of loads and supports
     *  @param damped     by absorbing boundaries
     *  @param kinetic    energy at the end
     *  @return @p own, summed over all ranks */
    DynamicSums
    enter_step(const double       force_work,
               const double       outer_work,
               const double       damped,
               const double       kinetic,
               const DynamicSums &own);

    /** Throw if a law had no answer in the last sweep.
     *  @param sums over all ranks */
    void
    refuse_failure(const DynamicSums &sums) const;

    /** Sums over all ranks. */
    template <std::size_t n>
    std::array<double, n>
    sum(std::array<double, n> own) const
    {
      Utilities::MPI::sum(ArrayView<const double>(own.data(), n),
                          model.communicator,
                          ArrayView<double>(own.data(), n));
      return own;
    }

    /** Whether the step that ends now gets a row of statistics. */
    bool
    is_reported() const
    {
      return is_finished() ||
             n_steps % analysis.time_integration.statistics_every == 0;
    }

    bool
    is_finished() const
    {
      return !(time < analysis.time_integration.end);
    }

    /** Whether this step is reported or may change the mesh: then energies are
     *  integrated, and the accepted history is kept until commit(), see
     *  Mechanics::dynamic_force(). */
    bool
    is_observed() const
    {
      return is_told() || is_mesh_due();
    }

    Model<dim>                 &model;
    const DynamicAnalysis<dim> &analysis;
    RunOutput<dim>              output;
    Supports<dim>               supports;
    AbsorbingBoundary<dim>      absorbing;
    Loads<dim>                  loads;

    VectorType   displacement, velocity, acceleration;
    VectorType   mass, inverse_mass;
    VectorType   internal, external, dashpots;
    VectorType   steady_load; ///< part of the external one, if not all of it
    VectorType   old_internal, old_external, old_dashpots;
    Receipt      receipt;
    double       time      = 0.;
    double       time_step = 0.; ///< the last one, or the next
    unsigned int n_steps   = 0;

  private:
    double
    part_of_run() const
    {
      const TimeIntegration &parameters = analysis.time_integration;
      return (time - parameters.start) / (parameters.end - parameters.start);
    }

    /** How many of @p n events, evenly over the run, are behind. */
    unsigned int
    part_of(const unsigned int n) const
    {
      return static_cast<unsigned int>(n * part_of_run() + 1e-9);
    }

    bool
    is_screen_line_due() const
    {
      return n_steps > 0 && part_of(20) > n_screen_lines;
    }

    bool
    is_snapshot_due() const
    {
      const unsigned int wanted = analysis.time_integration.snapshots;
      return wanted > 0 && (n_steps == 0 || part_of(wanted) > n_snapshots);
    }

    bool
    is_sample_due() const
    {
      return !model.transects.empty() &&
             (n_steps == 0 || part_of(analysis.transect_samples) > n_samples);
    }

    bool
    is_told() const
    {
      return is_reported() || is_snapshot_due() || is_sample_due() ||
             is_screen_line_due();
    }

    bool
    is_look_due() const
    {
      return analysis.wave_refinement.is_on() &&
             n_steps % analysis.wave_refinement.interval() == 0;
    }

    bool
    is_mesh_due() const
    {
      return is_look_due() && !is_finished();
    }

    /** Add the loads of a kind at the present time. */
    void
    add_loads(const LoadKind kind, VectorType &force);

    /** Velocities and forces at the start, on a mesh that suits them. */
    void
    start();

    /** A displacement that does not begin at zero would be an impact whose
     *  strength is that of the step: refuse it. */
    void
    refuse_jump();
    void
    set_initial_motion();

    /** Mark cells by the waves as they will be at the next look at the mesh;
     *  false if none changes. */
    bool
    mark();

    /** Go to the mesh that is marked. */
    void
    transfer();

    /** Give the nodes what momentum they miss, and take what energy the
     *  transfer has gained.
     *  @param missing see MomentumTransfer
     *  @param before  kinetic and stored energy on the old mesh */
    void
    balance_transfer(VectorType missing, const double before);

    /** The force of dampers and of shock viscosity goes by rates, which a new
     *  mesh does not know: without it each change of the mesh would take half a
     *  step of their work. */
    void
    resist_motion();

    /** Take an energy in J from the motion of some unknowns relative to their
     *  center of gravity, whose momentum stays; false if there is too little. */
    bool
    slow_down(const std::vector<bool> &wanted, const double energy);

    /** Energy that is stored before anything moves. */
    double
    energy_at_rest() const;

    double
    kinetic_energy() const;

    /** In kg m/s (per metre in plane strain). */
    std::array<double, dim>
    momentum() const;

    void
    save();

    /** Go back to a checkpoint; false if it has reached the end. */
    bool
    resume(const std::string &directory);

    /** A look at the mesh that was due at what has been the end before. */
    void
    make_up_for_mesh();

    /** Statistics, fields and screen, as often as each is due. */
    void
    report();

    /** What the supports do to the body, see reaction_columns(). Sets the time
     *  of the conditions to the next step. */
    VectorType
    support_forces() const;

    void
    add_statistics(const State &state);

    unsigned int n_reported = 0, n_snapshots = 0, n_samples = 0,
                 n_screen_lines = 0;
    double unknown_steps        = 0.; ///< unknowns of all steps together
    double rest_energy          = 0.; ///< see energy_at_rest()
    double largest_jump         = 0.; ///< see WaveRefinement::mark()
    double missed_look    = 0.;    ///< 1: the mesh is as before the last step
    bool   is_interrupted = false; ///< by a signal to any rank
  };
} // namespace Signoton

#endif
