#include <signoton/base/number.h>
#include <signoton/base/time_function.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Signoton
{
  TimeFunction::TimeFunction(const std::string &text,
                             const Constants   &constants,
                             const std::string &where)
    : function(make_function<1>({text}, constants, where))
    , where(where)
  {}

  double
  TimeFunction::operator()(const double time) const
  {
    function->set_time(time);
    const double value = function->value(Point<1>());
    if (!std::isfinite(value))
      throw UserError(where,
                      "no finite value at t = " + number_text(time),
                      "an expression that is finite at all times",
                      "look for divisions by zero and roots of negative "
                      "numbers");
    return value;
  }

  std::optional<double>
  TimeFunction::end_of_table() const
  {
    return function->end_of_tables();
  }

  std::vector<Kink>
  TimeFunction::kinks(const double start, const double end) const
  {
    return function->kinks(start, end, {Point<1>()});
  }
} // namespace Signoton
