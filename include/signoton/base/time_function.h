#ifndef signoton_base_time_function_h
#define signoton_base_time_function_h

#include <signoton/base/function.h>

namespace Signoton
{
  /** A number that changes in time: an expression in t, or a table. */
  class TimeFunction
  {
  public:
    /** @param where the place of the text, for messages */
    TimeFunction(const std::string &text,
                 const Constants   &constants,
                 const std::string &where);

    /** A UserError if it is not finite. */
    double
    operator()(const double time) const;

    /** The last time of a table; nothing for an expression. */
    std::optional<double>
    end_of_table() const;

    std::vector<Kink>
    kinks(const double start, const double end) const;

  private:
    std::shared_ptr<SpaceTimeFunction<1>> function;
    std::string                           where;
  };
} // namespace Signoton

#endif
