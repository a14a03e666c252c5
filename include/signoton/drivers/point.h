#ifndef signoton_drivers_point_h
#define signoton_drivers_point_h

#include <signoton/base/csv_table.h>
#include <signoton/base/time_function.h>
#include <signoton/drivers/output_directory.h>
#include <signoton/drivers/point_law.h>
#include <signoton/rheology/material_parameters.h>

#include <array>
#include <iosfwd>
#include <optional>

namespace Signoton
{
  /**
   * One material point driven by strain, stress or both, component by
   * component, with time steps that a tolerance controls: each is compared
   * with two of half the size, and these are kept.
   *
   * Writes `point.csv`, a line a step, and with gnuplot the diagram
   * `point.svg`; the script `point.gp` makes it again.
   */
  class PointDriver
  {
  public:
    PointDriver(const MPI_Comm &communicator, const SceneFile &file);

    /** Run to the end; the accepted lines are written in any case. */
    ExitStatus
    run();

    /** Say what would run. */
    std::string
    explanation() const;

    /** A commented parameter file. */
    static void
    print_template(std::ostream &out);

    std::string directory;

  private:
    /** What is given for one component, in Mandel's order. */
    struct Component
    {
      std::string                 strain_text, stress_text;
      std::optional<TimeFunction> program;
      bool                        is_stress = false;
      double                      factor    = 1.; ///< to Mandel's component
    };

    using State = PointLaw::State;

    void
    add_parameters();
    [[noreturn]] void
    refuse(const std::string &key,
           const std::string &found,
           const std::string &expected,
           const std::string &hint) const;
    void
    interpret();
    /** What the file gives component by component, or by the kind of test. */
    void
    interpret_components();
    void
    interpret_kind();
    /** Of the diagram, unless the file names them. */
    void
    choose_axes();
    /** The end, and the times that steps have to meet. */
    void
    interpret_times();
    void
    give(const unsigned int component,
         const std::string &text,
         const bool         is_stress,
         const std::string &where);

    std::array<bool, 6>
    stress_is_given() const;

    /** What is given at the start, at once; the isotropic state of a triaxial
     *  test. Nothing if there is none. */
    std::optional<State>
    start();

    /** One step from @p from; nothing if none was found. */
    std::optional<State>
    step(const State &from, const double time_step);

    double
    difference(const State &a, const State &b) const;

    ExitStatus
    drive();

    // point_output.cc
    void
    record(const State &state);
    /** The table, and the diagram; whether that could be drawn. */
    bool
    write() const;
    bool
    plot() const;

    /** Steps are at least this part of the program. */
    static constexpr double resolution = 1e-9;

    /** Of the table, in the order of record(). */
    static const std::vector<std::string> columns;

    MPI_Comm                 communicator;
    SceneFile                file;
    ParameterHandler         handler;
    std::string              title, kind = "oedometer";
    std::string              strain_text, stress_text, constants_text;
    double                   confining_pressure = 0.;
    std::array<Component, 6> components;
    double                   start_time = 0., end_time = 1.;
    double                   step_size = 0., tolerance = 1e-5;
    std::string              turning_text;
    TimesToMeet              times_to_meet;
    bool                     by_strain = true; ///< no stress is given
    std::string              horizontal, vertical;
    std::optional<Rheology::MaterialParameters> constants;
    std::optional<Rheology::Material>           material;
    std::unique_ptr<PointLaw>                   law;
    Vector6                          origin{}; ///< strain that counts as zero
    double                           strain_scale = 0., stress_scale = 0.;
    std::vector<CSVTable::Numbers>   rows; ///< of the table
    std::unique_ptr<OutputDirectory> results;
  };
} // namespace Signoton

#endif
