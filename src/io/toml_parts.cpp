#include "io/toml_parts.h"

#include <algorithm>

#include "case/slips.h"

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

std::optional<std::vector<double>> numbers_in(const toml::array& list) {
  std::vector<double> numbers;
  for (const toml::node& item : list) {
    if (const auto* whole = item.as_integer()) {  // value<double>() has none for large ones
      numbers.push_back(static_cast<double>(whole->get()));
    } else if (const auto* number = item.as_floating_point()) {
      numbers.push_back(number->get());
    } else {
      return std::nullopt;
    }
  }
  return numbers;
}

std::string_view line_of(std::string_view text, std::size_t number) {
  for (std::size_t i = 1; i < number && !text.empty(); ++i) {
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  }
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::optional<std::size_t> too_deep_at(std::string_view toml) {
  std::size_t dots = 0, brackets = 0;
  for (std::size_t i = 0; i < toml.size(); ++i) {
    const char c = toml[i];
    if (c == '"' || c == '\'') i = end_of_string(toml, i) - 1;
    if (c == '#') i = std::min(toml.find('\n', i), toml.size()) - 1;
    if (c == '.') ++dots;
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (std::string_view("[]{}=,\n").find(c) != std::string_view::npos) dots = 0;
    if (dots > deepest_nesting || brackets > deepest_nesting) {
      return 1 + std::count(toml.begin(), toml.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    }
  }
  return std::nullopt;
}

std::optional<KeyValue> to_key_value(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return KeyValue(flag->get());
  if (const auto* whole = node.as_integer()) return KeyValue(whole->get());
  if (const auto* number = node.as_floating_point()) return KeyValue(number->get());
  if (const auto* text = node.as_string()) return KeyValue(text->get());
  if (const auto* list = node.as_array()) {
    if (auto numbers = numbers_in(*list); numbers && !numbers->empty()) return *numbers;
    std::vector<std::string> texts;
    for (const toml::node& item : *list) {
      if (!item.is_string()) return std::nullopt;
      texts.push_back(item.as_string()->get());
    }
    return KeyValue(std::move(texts));
  }
  return std::nullopt;
}

std::string describe_type(const toml::node& node) {
  static constexpr const char* types[] = {
      "nothing",        "a table",        "a list of things of several types",
      "a text",         "a whole number", "a number",
      "a boolean",      "a date",         "a time of day",
      "a date and time"};
  static_assert(static_cast<int>(toml::node_type::date_time) == 9);
  return types[static_cast<int>(node.type())];
}

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
