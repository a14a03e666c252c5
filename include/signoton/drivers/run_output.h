#ifndef signoton_drivers_run_output_h
#define signoton_drivers_run_output_h

#include <signoton/base/csv_table.h>
#include <signoton/base/signals.h>
#include <signoton/drivers/checkpoint.h>
#include <signoton/drivers/field_output.h>
#include <signoton/drivers/output_directory.h>
#include <signoton/drivers/probes.h>

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/numerics/vector_tools_common.h>

#include <optional>

namespace Signoton
{
  /**
   * What every run writes to its directory, whatever it computes:
   * `resolved.prm`, a row of `statistics.csv` at a time, fields,
   * `ledger.json`; and the screen.
   */
  template <int dim>
  class RunOutput
  {
  public:
    explicit RunOutput(Model<dim> &model);

    /** Open the directory; remove what an earlier run left, unless this one is
     *  resumed. */
    void
    start(const double start_time, const double end_time);

    /** Columns of every statistics: values of fields at the probes, errors
     *  against references, seconds and memory.
     *  @param phases of the ledger */
    void
    add_common(CSVTable::Row                  &row,
               const State                    &state,
               const std::vector<std::string> &phases);

    void
    append(const CSVTable::Row &row);

    /** Fields for ParaView. */
    void
    write_fields(const State &state);

    /** See Probes::write_transects(). */
    void
    write_transects(const State &state);

    /** Estimate of the time left, at a time of the run. */
    std::string
    time_left(const double time) const;

    /** Write the ledger and the summary.
     *  @param n_steps that were accepted */
    void
    finish(const unsigned int n_steps);

    /** The same for a run that a signal ends, and how to go on with it.
     *  Collective. */
    ExitStatus
    interrupt(const unsigned int n_steps, const double time);

    /** Say that the run that is to be resumed has reached its end, and how to
     *  go on beyond it.
     *  @param section of the scene that has the end */
    ExitStatus
    nothing_left(const double time, const std::string &section);

    /** Put what must survive a restart into a checkpoint, and back.
     *  @param n_rows of the statistics that are kept */
    void
    save(Checkpoint<dim> &checkpoint) const;
    void
    resume(const Checkpoint<dim> &checkpoint, const unsigned int n_rows);

    /** Keep other runs from the directory, before a checkpoint is read. */
    void
    lock();

    /** Where a checkpoint is to be written. */
    std::string
    checkpoint_directory();

    ConditionalOStream screen;

  private:
    /** Errors against a reference, absolute and relative. */
    std::pair<double, double>
    reference_error(const VectorType           &field,
                    const Function<dim>        &reference,
                    const VectorTools::NormType norm);

    std::optional<SignalWatch> watch; ///< from the first step on

    Model<dim>      &model;
    double           start_time = 0., end_time = 1.;
    bool             resumed = false;
    OutputDirectory  directory;
    CSVTable         statistics;
    FieldOutput<dim> fields;
    Probes<dim>      probes;
  };

  /** A number for the screen. */
  std::string
  short_number(const double value, const int digits = 3);
} // namespace Signoton

#endif
