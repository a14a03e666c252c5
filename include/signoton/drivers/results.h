#ifndef signoton_drivers_results_h
#define signoton_drivers_results_h

#include <signoton/drivers/run_output.h>
#include <signoton/drivers/static_analysis.h>
#include <signoton/solvers/newton.h>

namespace Signoton
{
  /** What is known of an accepted step. */
  struct StepRecord
  {
    double        time      = 0.;
    double        step_size = 0.;
    EnergyBalance balance;
    double        external_work   = 0.; ///< of the step, in J
    double        transfer_drift  = 0.; ///< of stored energy, in J
    double        estimated_error = 0.; ///< 0 without refinement
    /** Columns, see reaction_columns(). */
    CSVTable::Row reactions;
    /** One for each mesh and each binder of a continuation; the last one led
     *  to the accepted state. */
    std::vector<NewtonResult> solves;
  };

  /**
   * The results of statics: a line on the screen and a row of
   * `statistics.csv` a step, fields, and what RunOutput writes.
   */
  template <int dim>
  class Results
  {
  public:
    Results(Model<dim> &model, const StaticAnalysis<dim> &analysis);

    /** Open the output directory, and say what starts. */
    void
    start(const double time);

    /** Record the state at the start, as step 0. */
    void
    at_rest(const VectorType &displacement, const StepRecord &record);

    /** Record an accepted step. */
    void
    step(const VectorType &displacement,
         const StepRecord &record,
         const bool        is_last);

    /** One line for a solve that is repeated on a finer mesh. */
    void
    cycle_line(const unsigned int cycle, const StepRecord &record);

    /** One line for a step that is cut. */
    void
    failed_line(const double time, const NewtonResult &newton);

    /** Say that no equilibrium was found, how far it got and what to try. */
    void
    no_equilibrium(const double        time,
                   const double        step_size,
                   const NewtonResult &newton);

    /** Say what binders bear of the reactions, see binder_shares(). */
    void
    binders(const CSVTable::Row &shares);

    /** Write the ledger and the summary. */
    void
    finish();

    /** Put what must survive a restart into a checkpoint, and back. */
    void
    save(Checkpoint<dim> &checkpoint) const;
    void
    resume(const Checkpoint<dim> &checkpoint);

    unsigned int
    n_accepted() const
    {
      return accepted_steps;
    }

    /** See RunOutput. */
    std::string
    checkpoint_directory()
    {
      return output.checkpoint_directory();
    }

    void
    lock()
    {
      output.lock();
    }

    ExitStatus
    interrupt(const double time)
    {
      return output.interrupt(accepted_steps, time);
    }

    ExitStatus
    nothing_left(const double time)
    {
      return output.nothing_left(time, "Load steps");
    }

  private:
    void
    print_newton_history(const NewtonResult &newton);

    /** Stored and dissipated energy since the start that no work of loads and
     *  supports, and no change of the mesh, has brought, relative to the
     *  largest energy: the error of finite steps, and what a new mesh loosens. */
    double
    energy_gap(const StepRecord &record) const;

    State
    state_of(const VectorType &displacement, const StepRecord &record) const;

    CSVTable::Row
    statistics_row(const State &state, const StepRecord &record);

    Model<dim>                &model;
    const StaticAnalysis<dim> &analysis;
    RunOutput<dim>             output;
    unsigned int               accepted_steps = 0;
    /** Since the start, in J. */
    double external_work = 0., dissipation = 0., drift = 0.;
    double initial_energy = 0.; ///< stored, in J
  };
} // namespace Signoton

#endif
