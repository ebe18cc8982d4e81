#include "io/toml_depth.h"

#include <algorithm>
#include <string>

namespace subimpact {
namespace {

// The index after the string that begins at `at`. A string in three quotes may hold one or two
// quotes, and those at its end belong to it.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const std::string three(3, quote);
  const bool is_long = text.substr(at, 3) == three;
  const bool has_escapes = quote == '"';
  for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (has_escapes && text[i] == '\\') {
      ++i;
    } else if (!is_long && (text[i] == quote || text[i] == '\n')) {
      return i + 1;
    } else if (is_long && text.substr(i, 3) == three) {
      i += 3;
      while (i < text.size() && text[i] == quote) ++i;
      return i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> too_deep_at(std::string_view toml) {
  std::size_t dots = 0, brackets = 0;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    switch (toml[i]) {
      case '"':
      case '\'':
        i = end_of_string(toml, i) - 1;
        break;
      case '#':
        i = std::min(toml.find('\n', i), toml.size()) - 1;
        break;
      case '.':
        ++dots;
        break;
      case '[':
      case '{':
        ++brackets;
        dots = 0;
        break;
      case ']':
      case '}':
        brackets -= brackets > 0;
        dots = 0;
        break;
      case '=':
      case ',':
      case '\n':
        dots = 0;
        break;
      default:
        break;
    }
    if (dots > deepest_nesting || brackets > deepest_nesting) {
      return 1 + std::count(toml.begin(), toml.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    }
  }
  return std::nullopt;
}

}  // namespace subimpact
