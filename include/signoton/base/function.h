#ifndef signoton_base_function_h
#define signoton_base_function_h

#include <signoton/base/scene_file.h>

#include <deal.II/base/function_parser.h>

#include <map>
#include <memory>

namespace Signoton
{
  /** Named constants that a scene defines for its expressions. */
  using Constants = std::map<std::string, double>;

  /** Read `a = 1, b = 2`; the constant `pi` is always there. */
  Constants
  parse_constants(const std::string &text, const std::string &where);

  /**
   * A function of space and time from the scene file, with one expression a
   * component, in the variables `x, y, z` (as many as dimensions, none of them if that
   * is one) and `t`.
   * @param where place named if an expression cannot be parsed
   */
  template <int dim>
  std::unique_ptr<FunctionParser<dim>>
  make_function(const std::vector<std::string> &expressions,
                const Constants                &constants,
                const std::string              &where);

  /** Whether the variable `t` occurs in an expression. */
  bool
  depends_on_time(const std::string &expression);

  /** Components separated by `;`. Throws unless there are @p n. */
  std::vector<std::string>
  split_components(const std::string &text,
                   const unsigned int n,
                   const std::string &where);
} // namespace Signoton

#endif
