#ifndef signoton_base_gnuplot_h
#define signoton_base_gnuplot_h

#include <string>

namespace Signoton
{
  /** A text as a string of gnuplot, in single quotes, in which nothing but a
   *  quote has a meaning; whatever a user wrote ends with it. */
  std::string
  gnuplot_string(const std::string &text);

  /** Run a script with gnuplot in the directory of the script, without a shell;
   *  whether it has drawn. */
  bool
  run_gnuplot(const std::string &directory, const std::string &script);
} // namespace Signoton

#endif
