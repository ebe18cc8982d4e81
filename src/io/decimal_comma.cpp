#include "io/decimal_comma.h"

#include <algorithm>
#include <optional>

namespace subimpact {
namespace {

// The text after leading digits; nothing if it begins with none.
std::optional<std::string_view> after_digits(std::string_view text) {
  const std::size_t n = std::min(text.find_first_not_of("0123456789"), text.size());
  if (n == 0) return std::nullopt;
  return text.substr(n);
}

std::string_view after_any_of(std::string_view characters, std::string_view text) {
  const bool is_there = !text.empty() && characters.find(text.front()) != std::string_view::npos;
  return text.substr(is_there ? 1 : 0);
}

// "0,201" of the text "0,201 # kg"; empty for a text that does not begin so.
std::string_view leading_decimal_comma(std::string_view text) {
  const auto fraction = after_digits(after_any_of("+-", text));
  if (!fraction || !fraction->starts_with(',')) return {};
  auto rest = after_digits(fraction->substr(1));
  if (!rest) return {};
  if (rest->starts_with('e') || rest->starts_with('E')) {
    rest = after_digits(after_any_of("+-", rest->substr(1))).value_or(*rest);
  }
  return text.substr(0, text.size() - rest->size());
}

std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t i = 1; i < number && !text.empty(); ++i) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::string decimal_comma_in(std::string_view text, std::size_t line_number) {
  const std::string_view line = line_of(text, line_number);
  for (std::size_t at = line.find('='); at < line.size(); at = line.find('=', at + 1)) {
    const std::size_t start = std::min(line.find_first_not_of(" \t", at + 1), line.size());
    const std::string_view number = leading_decimal_comma(line.substr(start));
    if (!number.empty()) return std::string(number);
  }
  return {};
}

}  // namespace subimpact
