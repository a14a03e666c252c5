#include <signoton/base/number.h>
#include <signoton/drivers/run_checks.h>
#include <signoton/drivers/static_analysis.h>
#include <signoton/drivers/statics.h>

#include <algorithm>
#include <cmath>

namespace Signoton
{
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

  template <int dim>
  void
  StaticAnalysis<dim>::add_parameters(ParameterHandler &handler)
  {
    load_steps.add_parameters(handler);
    refinement.add_parameters(handler);
    model.newton.add_parameters(handler);
    model.linear_solver.add_parameters(handler);
    handler.enter_subsection("Output");
    handler.add_parameter("Fields every",
                          fields_every,
                          "Write fields for ParaView every n-th step and "
                          "after the last; 0: never.",
                          Patterns::Integer(0));
    handler.add_parameter("Newton history",
                          newton_history,
                          "Print every Newton iteration.");
    handler.leave_subsection();
  }

  template <int dim>
  void
  StaticAnalysis<dim>::check(const Constants &)
  {
    load_steps.check(model.file);
    if (!model.file.has({"Refinement"}, "Minimum level"))
      refinement.set_minimum_level(model.geometry.initial_refinement);
    refinement.check(model.file);
  }

  template <int dim>
  std::string
  StaticAnalysis<dim>::equations() const
  {
    return "find the displacement u that minimizes\n"
           "  sum over the body of W_n(strain(u)) - work of the loads,\n"
           "  strain = sym grad u, stress = dW_n/dstrain";
  }

  template <int dim>
  ExitStatus
  StaticAnalysis<dim>::run(const std::string &resume_directory)
  {
    return Statics<dim>(model, *this).run(resume_directory);
  }

  template class StaticAnalysis<2>;
  template class StaticAnalysis<3>;
} // namespace Signoton
