#include <signoton/drivers/model.h>

namespace Signoton
{
  void
  OutputParameters::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Output");
    handler.add_parameter("Directory",
                          directory,
                          "Where results go; empty: output/ and the name of "
                          "the scene.");
    handler.add_parameter("Fields every",
                          fields_every,
                          "Write fields for ParaView every n-th step and "
                          "after the last; 0: never.");
    handler.add_parameter("Checkpoint every",
                          checkpoint_every,
                          "Write a checkpoint every n-th step and after the "
                          "last; 0: never.");
    handler.add_parameter("Probe points",
                          probe_text,
                          "Points whose displacement is a column of the "
                          "statistics: 'x, y; x, y' in 2D.");
    handler.add_parameter("Newton history",
                          newton_history,
                          "Print every Newton iteration.");
    handler.leave_subsection();
  }

  void
  LoadSteps::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection("Load steps");
    handler.add_parameter("Start time",
                          start,
                          "Pseudo-time t of the unloaded state.");
    handler.add_parameter("End time", end, "Pseudo-time of the last step.");
    handler.add_parameter("Step size",
                          step_size,
                          "First step of t.",
                          Patterns::Double(1e-300));
    handler.add_parameter("Minimum step size",
                          minimum_step_size,
                          "A failed step is halved down to this size before "
                          "the run gives up; 0: a thousandth of 'Step size'.",
                          Patterns::Double(0.));
    handler.add_parameter("Maximum step size",
                          maximum_step_size,
                          "Steps do not grow beyond this size.",
                          Patterns::Double(1e-300));
    handler.add_parameter("Easy iterations",
                          easy_iterations,
                          "A step with at most this many Newton iterations "
                          "lets the next one grow.");
    handler.add_parameter("Growth",
                          growth,
                          "Factor by which the step grows; after a cut it "
                          "regrows to the first size by at least 1.5.",
                          Patterns::Double(1., 10.));
    handler.leave_subsection();
  }

  void
  LoadSteps::check(const SceneFile &file)
  {
    const auto refuse = [&](const std::string &key,
                            const double       value,
                            const std::string &expected) {
      throw UserError(
        file.where({"Load steps"}, key),
        "'" + file.value({"Load steps"}, key, Utilities::to_string(value)) +
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
  }
} // namespace Signoton
