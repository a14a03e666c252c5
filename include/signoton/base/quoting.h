#ifndef signoton_base_quoting_h
#define signoton_base_quoting_h

#include <string>
#include <vector>

namespace Signoton
{
  /**
   * The one rule of quoting in scene files and on the command line: what stands
   * in double quotes is taken as it is, whether it is the name of a section, a
   * key, an item of a list or a whole value; a double quote within is doubled,
   * as in CSV. A quote begins where a word does: that of `12" pipe` does not,
   * nor does one that is never closed.
   */

  /** Where a character stands for the first time outside of quotes, or
   *  std::string::npos. */
  std::size_t
  find_unquoted(const std::string &text, const char character);

  /** The parts of a text between separators that are not in quotes, trimmed,
   *  with their quotes. The last part may be empty and does not count then. */
  std::vector<std::string>
  split_unquoted(std::string text, const char separator);

  /** What is in the quotes, if the whole text is. */
  std::string
  unquoted(const std::string &text);

  /** The name, in quotes if it needs them.
   *  @param special characters that would not be taken as they are */
  std::string
  quoted(const std::string &name, const std::string &special);

  /** `a line break`, or whatever is the first control character of a text but
   *  for tabs; empty if there is none. */
  std::string
  control_character_in(const std::string &text);
} // namespace Signoton

#endif
