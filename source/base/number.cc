#include <signoton/base/number.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace Signoton
{
  std::string
  number_text(const double value)
  {
    std::array<char, 32> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value).ptr};
  }

  bool
  moves_clock(const double time_step, const double time)
  {
    return time_step >
           16. * std::numeric_limits<double>::epsilon() * std::abs(time);
  }
} // namespace Signoton
