#include <signoton/base/number.h>
#include <signoton/drivers/program.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signoton
{
  double
  read_number(const std::string &text, const std::string &where)
  {
    double value = 0.;
    try
      {
        value = Utilities::string_to_double(Utilities::trim(text));
      }
    catch (const ExceptionBase &)
      {
        value = std::numeric_limits<double>::quiet_NaN();
      }
    if (!std::isfinite(value))
      throw UserError(where,
                      "'" + text + "'",
                      "a number",
                      "tables look like '0: 0, 1: -5e-4, 3: -5e-4'");
    return value;
  }

  Program::Program(const std::string &text,
                   const Constants   &constants,
                   const std::string &where)
    : where(where)
  {
    const bool is_table = text.find(':') != std::string::npos &&
                          text.find('?') == std::string::npos;
    if (!is_table)
      {
        expression = make_function<1>({text}, constants, where);
        return;
      }
    for (const std::string &item : Utilities::split_string_list(text, ','))
      {
        const auto colon = item.find(':');
        if (colon == std::string::npos)
          throw UserError(where,
                          "'" + item + "'",
                          "points 'time: value', separated by commas",
                          "tables look like '0: 0, 1: -5e-4, 3: -5e-4'");
        times.push_back(read_number(item.substr(0, colon), where));
        values.push_back(read_number(item.substr(colon + 1), where));
        if (times.size() > 1 && !(times.back() > times[times.size() - 2]))
          throw UserError(where,
                          "'" + item + "' after the time " +
                            number_text(times[times.size() - 2]),
                          "increasing times",
                          "leave a short time for a jump");
      }
  }

  double
  Program::operator()(const double time) const
  {
    if (expression)
      {
        expression->set_time(time);
        const double value = expression->value(Point<1>());
        if (!std::isfinite(value))
          throw UserError(where,
                          "no finite value at t = " + number_text(time),
                          "an expression that is finite at all times",
                          "look for divisions by zero and roots of negative "
                          "numbers");
        return value;
      }
    const auto next = std::lower_bound(times.begin(), times.end(), time);
    if (next == times.begin())
      return values.front();
    if (next == times.end())
      return values.back();
    const std::size_t i    = next - times.begin();
    const double      part = (time - times[i - 1]) / (times[i] - times[i - 1]);
    return values[i - 1] + part * (values[i] - values[i - 1]);
  }
} // namespace Signoton
