#include "io/case_file/toml_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <type_traits>

#include "case/keys/slips.h"
#include "case/keys/units.h"

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

std::string misspelt_number_in(std::string_view text, std::size_t line_number) {
  const std::string_view line = line_of(text, line_number);
  for (std::size_t at = line.find('='); at < line.size(); at = line.find('=', at + 1)) {
    const std::size_t start = std::min(line.find_first_not_of(" \t", at + 1), line.size());
    const std::string_view value = line.substr(start, line.find_first_of("#]}\n", start) - start);
    const std::string number(leading_decimal_comma(value));
    if (!number.empty()) return number + " has a decimal comma" + decimal_comma_hint(number);
    const auto [digits, rest] = split_unit(value.substr(0, value.find(',')));
    if (digits.empty() || rest.empty() || !std::isalpha(static_cast<unsigned char>(rest[0]))) {
      continue;
    }
    return fmt::format(
        "{0} {1} is a value with a unit; write it in quotes, \"{0} {1}\", or the number alone, in "
        "SI units",
        digits, rest);
  }
  return {};
}

Json json_of(const toml::node& node) {
  return node.visit([](const auto& value) -> Json {
    if constexpr (toml::is_array<decltype(value)>) {
      Json list = Json::array();
      for (const toml::node& item : value) list.push_back(json_of(item));
      return list;
    } else if constexpr (toml::is_table<decltype(value)>) {
      Json object = Json::object();
      for (const auto& [key, item] : value) object[std::string(key.str())] = json_of(item);
      return object;
    } else if constexpr (std::is_constructible_v<Json, decltype(value.get())>) {
      return value.get();
    }
    return nullptr;
  });
}

std::string describe_type(const toml::node& node) {
  static constexpr const char* types[] = {
      "nothing",        "a table",        "a list of values of several types",
      "a text",         "a whole number", "a number",
      "a boolean",      "a date",         "a time of day",
      "a date and time"};
  static_assert(static_cast<int>(toml::node_type::date_time) == 9);
  return types[static_cast<int>(node.type())];
}

}  // namespace subimpact
