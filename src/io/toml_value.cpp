#include "io/toml_value.h"

namespace subimpact {

namespace {

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

}  // namespace

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
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list of things of several types";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    case toml::node_type::date:
      return "a date";
    case toml::node_type::time:
      return "a time of day";
    case toml::node_type::date_time:
      return "a date and time";
    case toml::node_type::none:
      break;
  }
  return "nothing";
}

}  // namespace subimpact
