#include <signoton/base/quoting.h>

#include <deal.II/base/utilities.h>

#include <cctype>

namespace Signoton
{
  using dealii::Utilities::trim;

  std::size_t
  find_unquoted(const std::string &text, const char character)
  {
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        if (text[i] == character)
          return i;
        if (text[i] != '"' ||
            (i > 0 && std::isalnum(static_cast<unsigned char>(text[i - 1]))))
          continue;
        // a doubled quote closes one pair and opens the next
        const std::size_t end = text.find('"', i + 1);
        if (end != std::string::npos)
          i = end;
      }
    return std::string::npos;
  }

  std::vector<std::string>
  split_unquoted(std::string text, const char separator)
  {
    std::vector<std::string> parts;
    while (!trim(text).empty())
      {
        const std::size_t end = find_unquoted(text, separator);
        parts.push_back(trim(text.substr(0, end)));
        text.erase(0, end == std::string::npos ? end : end + 1);
      }
    return parts;
  }

  std::string
  unquoted(const std::string &text)
  {
    if (text.size() < 2 || text.front() != '"')
      return text;
    std::string inner;
    for (std::size_t i = 1; i < text.size(); ++i)
      {
        if (text[i] == '"' && i + 1 == text.size())
          return inner;
        if (text[i] == '"' && text[++i] != '"')
          return text;
        inner += text[i];
      }
    return text;
  }

  std::string
  quoted(const std::string &name, const std::string &special)
  {
    if (!name.empty() && name == trim(name) && name.back() != '\\' &&
        name.find_first_of(special + '"') == std::string::npos)
      return name;
    std::string text = "\"";
    for (const char c : name)
      text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
  }

  std::string
  control_character_in(const std::string &text)
  {
    constexpr char digits[] = "0123456789abcdef";
    for (const char c : text)
      {
        const auto code = static_cast<unsigned char>(c);
        if (c == '\t' || (code >= 0x20 && code != 0x7f))
          continue;
        if (c == '\0')
          return "a NUL byte";
        if (c == '\n' || c == '\r')
          return "a line break";
        return std::string("the control character 0x") + digits[code / 16] +
               digits[code % 16];
      }
    return "";
  }
} // namespace Signoton
