#include <signoton/base/function.h>
#include <signoton/base/number.h>
#include <signoton/drivers/run_checks.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace Signoton
{
  namespace
  {
    /** No run ends that has more steps, no disk is meant for more lines. */
    constexpr double most_steps = 1e9, most_lines = 1e7;

    std::string
    about(const double number)
    {
      std::ostringstream text;
      text << "about " << std::setprecision(2) << number;
      return text.str();
    }
  } // namespace

  void
  check_steps(const std::string &where,
              const double       time_step,
              const double       start,
              const double       end,
              const double       n_steps,
              const double       n_lines,
              const std::string &remedy)
  {
    const std::string steps =
      about(n_steps) + " steps of " + number_text(time_step) + " s from " +
      number_text(start) + " s to " + number_text(end) + " s";
    if (!(n_steps <= most_steps))
      throw UserError(where, steps, "at most 1e9 steps", remedy);
    if (!moves_clock(time_step, std::max(std::abs(start), std::abs(end))))
      throw UserError(where,
                      steps,
                      "steps that a clock with 16 digits can tell apart",
                      "begin at time zero, or take longer steps");
    if (!(n_lines <= most_lines))
      throw UserError(where,
                      steps + ", and " + about(n_lines) +
                        " lines of statistics",
                      "at most 1e7 lines",
                      "set 'Statistics every' in dynamics; " + remedy);
  }

  template <int dim>
  void
  refuse_trouble_of_loads(const Model<dim> &model)
  {
    std::vector<const Function<dim> *> functions{model.gravity.get()};
    for (const auto &condition : model.conditions)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            functions.push_back(condition.displacement[d].get());
            functions.push_back(condition.velocity[d].get());
          }
        functions.push_back(condition.traction.get());
        functions.push_back(condition.pressure.get());
      }
    for (const auto &force : model.point_forces)
      functions.push_back(force.force.get());
    refuse_trouble<dim>(model.communicator, functions);
  }

  template void
  refuse_trouble_of_loads<2>(const Model<2> &);
  template void
  refuse_trouble_of_loads<3>(const Model<3> &);
} // namespace Signoton
