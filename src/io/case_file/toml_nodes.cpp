#include "io/case_file/toml_nodes.h"

#include <algorithm>
#include <type_traits>

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
