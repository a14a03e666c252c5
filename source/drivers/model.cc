#include <signoton/base/number.h>
#include <signoton/drivers/run_checks.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
  namespace
  {
    const Patterns::Double time_pattern(-largest_number, largest_number);
    const Patterns::Double length_pattern(0., largest_number);
  } // namespace

  void
  OutputParameters::add_parameters(ParameterHandler &handler,
                                   const bool        is_dynamic)
  {
    handler.enter_subsection("Output");
    handler.add_parameter("Directory",
                          directory,
                          "Where results go; empty: output/ and the name of "
                          "the scene.");
    if (!is_dynamic)
      handler.add_parameter("Fields every",
                            fields_every,
                            "Write fields for ParaView every n-th step and "
                            "after the last; 0: never.",
                            Patterns::Integer(0));
    handler.add_parameter("Nodal stress",
                          nodal_stress,
                          "Write the stress at nodes beside its averages over "
                          "cells: better at surfaces, and about as many "
                          "numbers again.");
    handler.add_parameter("Checkpoint every",
                          checkpoint_every,
                          "Write a checkpoint every n-th step and after the "
                          "last; 0: never.",
                          Patterns::Integer(0));
    handler.add_parameter("Probe points",
                          probe_text,
                          "Points with columns in the statistics: 'x, y; x, y' "
                          "in 2D.");
    handler.add_parameter("Probe surfaces",
                          surface_text,
                          "Boundaries with columns in the statistics, by name: "
                          "means of displacement, velocity and, for stress, "
                          "traction. 'top, plate'; names with a ',' in double "
                          "quotes.");
    handler.add_parameter(
      "Probe quantities",
      probe_quantities,
      "Columns of points and surfaces (of these displacement, velocity and, "
      "for "
      "stress, traction); lines have displacement, velocity and stress in any "
      "case. On an interface there is a column for each material, 'stress xx "
      "at probe 1 in sand', and in lines a row for each. Strain is what the "
      "material sees, with the initial one; "
      "principal stresses begin with the largest, tension is positive; region "
      "is a number, see README.",
      Patterns::MultipleSelection(
        "displacement|velocity|stress|strain|contact strain|plastic strain|"
        "principal stress|pressure|shear intensity|energy density|region"));
    handler.add_parameter("Probe lines",
                          transect_text,
                          "Lines with files of their own, and pictures over "
                          "place and time: 'from : to : number of points; "
                          "...', for instance '0, 0 : 1, 0 : 200'.");
    if (is_dynamic)
      handler.add_parameter("Probe line samples",
                            transect_samples,
                            "How often lines are written, evenly over the "
                            "run. In statics it is every step.",
                            Patterns::Integer(1, 1000000));
    if (!is_dynamic)
      handler.add_parameter("Newton history",
                            newton_history,
                            "Print every Newton iteration.");
    handler.leave_subsection();
  }

  void
  TimeIntegration::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Time integration");
    handler.add_parameter("Scheme",
                          scheme,
                          "explicit: central differences, in steps shorter "
                          "than the time in which a wave crosses a cell. "
                          "implicit: generalized alpha, in steps of any size, "
                          "each a Newton iteration as in statics; for motions "
                          "that are slow beside waves.",
                          Patterns::Selection("explicit|implicit"));
    handler.add_parameter("Start time", start, "In s.", time_pattern);
    handler.add_parameter("End time", end, "In s.", time_pattern);
    handler.add_parameter("Time step",
                          time_step,
                          "In s; 0: the stable one by 'Safety', or implicit "
                          "steps by 'Error tolerance'.",
                          length_pattern);
    handler.add_parameter(
      "Safety",
      safety,
      "Explicit: the step as a part of the stable one, in which the "
      "fastest wave crosses the smallest cell.",
      Patterns::Double(0.01, 1.));
    handler.add_parameter("Error tolerance",
                          error_tolerance,
                          "Implicit: local error of a step, relative to the "
                          "largest displacement, by which steps are chosen.",
                          Patterns::Double(1e-12, 1.));
    handler.add_parameter("Maximum time step",
                          maximum_step,
                          "Implicit: in s; 0: a fiftieth of the run.",
                          length_pattern);
    handler.add_parameter("Spectral radius",
                          spectral_radius,
                          "Implicit: what is left after a step of an "
                          "oscillation that is much faster; 1: all, 0: "
                          "nothing.",
                          Patterns::Double(0., 1.));
    handler.add_parameter(
      "Linear shock viscosity",
      shock_viscosity.linear,
      "Without unit; as a part of the impedance of the "
      "closed medium, what damps oscillations behind fronts "
      "and stops contacts that close. By default zero if "
      "all materials are elastic.",
      Patterns::Double(0., 2.));
    handler.add_parameter(
      "Quadratic shock viscosity",
      shock_viscosity.quadratic,
      "Without unit; spreads fronts that close contacts over "
      "twice to three times its root in cells. By default "
      "zero if all materials are elastic.",
      Patterns::Double(0., 100.));
    handler.add_parameter("Quiet zones",
                          quiet_zones,
                          "Explicit: skip cells that no wave has reached.");
    handler.add_parameter("Times",
                          times,
                          "In s, separated by commas, that steps have to meet "
                          "besides the end. Times at which loads or prescribed "
                          "motions bend or jump by 'if', '?:', comparisons, "
                          "min, max, abs, floor and the like, or by a table, "
                          "are met anyway.");
    handler.add_parameter("Statistics every",
                          statistics_every,
                          "A line of statistics every n-th step and after the "
                          "last.",
                          Patterns::Integer(1));
    handler.add_parameter("Snapshots",
                          snapshots,
                          "Fields for ParaView at the start and as often as "
                          "this, evenly over the run; 0: never.",
                          Patterns::Integer(0, 100000));
    handler.leave_subsection();
  }

  void
  TimeIntegration::check(const SceneFile &file) const
  {
    if (!(end > start))
      throw UserError(file.where({"Time integration"}, "End time"),
                      number_text(end),
                      "a time after the start at " + number_text(start),
                      "set it");
    if (!is_implicit())
      return; // when the mesh is there
    const bool   is_fixed = time_step > 0.;
    const double step     = is_fixed ? time_step : longest_step();
    check_steps(file.where({"Time integration"},
                           is_fixed ? "Time step" : "Maximum time step"),
                step,
                start,
                end,
                (end - start) / step,
                (end - start) / step / statistics_every,
                "take longer steps");
  }

  void
  LoadSteps::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Load steps");
    handler.add_parameter("Start time",
                          start,
                          "Pseudo-time t of the unloaded state.",
                          time_pattern);
    handler.add_parameter("End time",
                          end,
                          "Pseudo-time of the last step.",
                          time_pattern);
    handler.add_parameter("Step size",
                          step_size,
                          "First step of t.",
                          Patterns::Double(1. / largest_number,
                                           largest_number));
    handler.add_parameter("Minimum step size",
                          minimum_step_size,
                          "A failed step is halved down to this size before "
                          "the run gives up; 0: a thousandth of 'Step size'.",
                          length_pattern);
    handler.add_parameter("Maximum step size",
                          maximum_step_size,
                          "Steps do not grow beyond this size.",
                          Patterns::Double(1. / largest_number));
    handler.add_parameter(
      "Times",
      times,
      "Values of t, separated by commas, that steps have to meet "
      "besides the end. Times at which loads or prescribed "
      "motions bend or jump by 'if', '?:', comparisons, "
      "min, max, abs, floor and the like, or by a table, "
      "are met anyway; a jump is crossed by a step of its own.");
    handler.add_parameter("Easy iterations",
                          easy_iterations,
                          "A step with at most this many Newton iterations "
                          "lets the next one grow.",
                          Patterns::Integer(0));
    handler.add_parameter("Growth",
                          growth,
                          "Factor by which the step grows; one that has to be "
                          "cut takes both halves, and brings what had grown "
                          "back towards the first size.",
                          Patterns::Double(1., 10.));
    handler.leave_subsection();
  }

  void
  LoadSteps::check(const SceneFile &file)
  {
    const auto refuse = [&](const std::string &key,
                            const double       value,
                            const std::string &expected) {
      throw UserError(file.where({"Load steps"}, key),
                      "'" +
                        file.value({"Load steps"}, key, number_text(value)) +
                        "'",
                      expected,
                      "pseudo-time grows from 'Start time' to 'End time' in "
                      "steps that begin with 'Step size'");
    };
    if (!(end > start))
      refuse("End time", end, "a time after 'Start time'");
    if (!(minimum_step_size > 0.))
      minimum_step_size = 1e-3 * step_size;
    if (minimum_step_size > step_size)
      refuse("Minimum step size", minimum_step_size, "at most 'Step size'");
    if (maximum_step_size < step_size)
      refuse("Maximum step size", maximum_step_size, "at least 'Step size'");
    // as many as it takes if no step fails
    const double length = end - start;
    double       n = 0., step = step_size, reached = 0.;
    for (; reached < length && growth > 1.001 && step < maximum_step_size; ++n)
      {
        reached += step;
        step *= growth;
      }
    n += std::max(0., length - reached) / std::min(step, maximum_step_size);
    check_steps(file.where({"Load steps"}, "Step size"),
                step_size,
                start,
                end,
                n,
                n,
                "take longer steps");
    // a step that fails is cut until the clock would stand still
    while (
      !moves_clock(minimum_step_size, std::max(std::abs(start), std::abs(end))))
      minimum_step_size *= 2.;
  }
} // namespace Signoton
