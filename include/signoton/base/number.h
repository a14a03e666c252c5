#ifndef signoton_base_number_h
#define signoton_base_number_h

#include <string>

namespace Signoton
{
  /** Lengths of time, constants and the like are below this, and above its
   *  inverse, so that no product of a few of them overflows. */
  constexpr double largest_number = 1e30;

  /** The shortest text that is read as the same number. */
  std::string
  number_text(const double value);

  /** Whether a length of time added to another one changes it by what it is,
   *  but for a few percent. */
  bool
  moves_clock(const double time_step, const double time);
} // namespace Signoton

#endif
