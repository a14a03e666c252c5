#ifndef signoton_drivers_statics_h
#define signoton_drivers_statics_h

#include <signoton/drivers/equilibrium_problem.h>
#include <signoton/drivers/results.h>

namespace Signoton
{
  /**
   * Quasi-static equilibrium along a load history.
   *
   * A step goes from the accepted state at $t_n$ to a trial state at
   * $t_{n+1}$. The mesh is refined inside the step: accepted and trial state
   * move to the new mesh together and the step is solved again, so that a
   * step that fails later can still be cut. Only then is it accepted.
   *
   * What is tried when Newton's method fails, in this order: the same step with
   * strong binders that are weakened by tenths (if there are proportional
   * binders), half the step. Both halves are taken, each halved again if it
   * has to be, so that all steps end where they would have ended otherwise.
   * Below the smallest step the run ends with ExitStatus::no_equilibrium; all
   * accepted steps are on disk.
   *
   * The external work of a step is that of the mean of the loads before and
   * after, and of the mean of the reactions where displacements are prescribed.
   * What acts at the start is applied over the first step, growing from what
   * the body carries by its initial stress.
   */
  template <int dim>
  class Statics
  {
  public:
    Statics(Model<dim> &model, const StaticAnalysis<dim> &analysis);

    /** Start from the unloaded state, or from a checkpoint. */
    ExitStatus
    run(const std::string &resume_directory = "");

  private:
    void
    setup_unknowns();

    /** Solve for the trial state at @p time from a guess.
     *  @param predict whether the guess is the accepted state, from which a
     *    predictor leads to the new constraints */
    NewtonResult
    solve(const double time, VectorType &u, const bool predict);

    /** Take a step, or a part of one; false if no part succeeds. */
    bool
    advance();

    /** Where the next step would end: on a time to meet, or before. */
    double
    whole_step_end() const;

    /** Refine the mesh; false if it stays as it is. Changes the accepted
     *  state, and the trial displacement, to the new mesh. */
    bool
    refine(VectorType &trial);

    void
    transfer(VectorType &trial);

    void
    report_start();

    /** Say what binders bear of the reactions. */
    void
    report_binders();

    /** Integrate the loads of the accepted state on the present mesh. Before
     *  the first step the body carries what its initial stress is in balance
     *  with. */
    void
    find_carried_load();

    /** Report the trial state and make it the accepted one. */
    void
    accept(const VectorType &trial);

    /** Whether the accepted state, or the one being reported, is at the end of
     *  the load history. */
    bool
    is_last_step() const;

    Model<dim>                &model;
    const StaticAnalysis<dim> &analysis;
    Loads<dim>                 loads;
    Supports<dim>              supports;
    EquilibriumProblem<dim>    problem;
    Newton                     newton;
    Results<dim>               results;

    StepRecord   record;
    NewtonResult last_result;
    VectorType   displacement; ///< accepted
    /** Internal forces without loads in the accepted state: where the body is
     *  supported, the reactions. */
    VectorType          support_force;
    VectorType          carried_load;      ///< in the accepted state, in N
    double              support_work = 0.; ///< of these in the step, in J
    double              time         = 0.;
    double              step_size    = 0.; ///< of a step that is not cut
    std::vector<double> step_ends; ///< not reached yet, the innermost at last
  };
} // namespace Signoton

#endif
