#ifndef signoton_drivers_program_h
#define signoton_drivers_program_h

#include <signoton/base/function.h>

namespace Signoton
{
  /** A number that changes in time: an expression in t, or a table `t: value`
   *  of points joined by straight lines. */
  class Program
  {
  public:
    /** @param where the place of the text, for messages */
    Program(const std::string &text,
            const Constants   &constants,
            const std::string &where);

    double
    operator()(const double time) const;

    /** Times of a table, where the rate jumps. */
    const std::vector<double> &
    turning_points() const
    {
      return times;
    }

  private:
    std::shared_ptr<FunctionParser<1>> expression;
    std::vector<double>                times, values;
    std::string                        where;
  };

  /** A number of a program; @p where is its place, for messages. */
  double
  read_number(const std::string &text, const std::string &where);
} // namespace Signoton

#endif
