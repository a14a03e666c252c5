#ifndef signoton_base_time_table_h
#define signoton_base_time_table_h

#include <signoton/base/kinks.h>

namespace Signoton
{
  /** A number that changes in time, by a table `t: value, t: value` of points
   *  that straight lines join; before the first and behind the last it is
   *  constant. Times and values are numbers, or expressions of constants. */
  class TimeTable
  {
  public:
    /** Whether a text is meant to be a table, and not an expression. */
    static bool
    is_table(const std::string &text);

    /** @param where the place of the text, for messages */
    TimeTable(const std::string &text,
              const Constants   &constants,
              const std::string &where);

    double
    operator()(const double time) const;

    /** Where the rate jumps. */
    const std::vector<double> &
    times() const
    {
      return points;
    }

  private:
    std::vector<double> points, values;
  };
} // namespace Signoton

#endif
