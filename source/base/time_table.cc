#include <signoton/base/function.h>
#include <signoton/base/number.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Signoton
{
  namespace
  {
    /** A number, or an expression of constants. */
    double
    read_number(const std::string &text,
                const Constants   &constants,
                const std::string &where)
    {
      double value = std::numeric_limits<double>::quiet_NaN();
      try
        {
          value = Utilities::string_to_double(Utilities::trim(text));
        }
      catch (const ExceptionBase &)
        {
          try
            {
              if (!depends_on_time(text))
                value =
                  make_function<1>({text}, constants, where)->value(Point<1>());
            }
          catch (const UserError &)
            {}
        }
      if (!std::isfinite(value))
        throw UserError(where,
                        "'" + text + "'",
                        "a number",
                        "tables look like '0: 0, 1: -5e-4, 3: -5e-4'");
      return value;
    }
  } // namespace

  bool
  TimeTable::is_table(const std::string &text)
  {
    return text.find(':') != std::string::npos &&
           text.find('?') == std::string::npos;
  }

  TimeTable::TimeTable(const std::string &text,
                       const Constants   &constants,
                       const std::string &where)
  {
    for (const std::string &item : Utilities::split_string_list(text, ','))
      {
        const auto colon = item.find(':');
        if (colon == std::string::npos ||
            item.find(':', colon + 1) != std::string::npos)
          throw UserError(where,
                          "'" + item + "'",
                          "points 'time: value', separated by commas",
                          "tables look like '0: 0, 1: -5e-4, 3: -5e-4'");
        const double time =
          read_number(item.substr(0, colon), constants, where);
        values.push_back(read_number(item.substr(colon + 1), constants, where));
        if (!points.empty() && !(time > points.back()))
          throw UserError(where,
                          "'" + item + "' after the time " +
                            number_text(points.back()),
                          "increasing times",
                          "leave a short time for a jump");
        points.push_back(time);
      }
  }

  double
  TimeTable::operator()(const double time) const
  {
    const auto next = std::lower_bound(points.begin(), points.end(), time);
    if (next == points.begin())
      return values.front();
    if (next == points.end())
      return values.back();
    const std::size_t i = next - points.begin();
    const double part   = (time - points[i - 1]) / (points[i] - points[i - 1]);
    return values[i - 1] + part * (values[i] - values[i - 1]);
  }
} // namespace Signoton
