#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

#include "case/keys/units.h"
#include "io/directory/listed_files.h"
#include "io/records/record.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

// A text as TOML writes it on one line; JSON escapes the same way, but for DEL.
std::string toml_text(const std::string& text) {
  const std::string json = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return std::regex_replace(json, std::regex("\x7f"), "\\u007f");
}

bool is_empty_list(const KeyValue& value) {
  if (const auto* placed = std::get_if<PlacedValues>(&value)) return placed->entries.empty();
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  return numbers != nullptr && numbers->empty();
}

Json number_schema(const char* type, const Limits& limits) {
  Json schema = {{"type", limits.infinity ? Json{type, "null"} : Json(type)}};
  if (limits.minimum) schema["minimum"] = *limits.minimum;
  if (limits.exclusive_minimum) schema["exclusiveMinimum"] = *limits.exclusive_minimum;
  if (limits.maximum) schema["maximum"] = *limits.maximum;
  if (limits.multiple_of) schema["multipleOf"] = *limits.multiple_of;
  return schema;
}

// A number, or a text of a number with its unit.
Json number_or_unit_schema(const CaseKey& key) {
  Json schema = number_schema("number", key.limits);
  std::string units = units_beside(is_position(key) ? "m" : key.unit, "|");
  if (units.empty()) return schema;
  units = std::regex_replace(units, std::regex("[.^]"), "\\$&");
  units = std::regex_replace(units, std::regex("\\|u"), "|(u|\u00b5|\u03bc)");
  units = std::regex_replace(units, std::regex("m([23])"), "m\\^?$1");
  if (!schema["type"].is_array()) schema["type"] = Json{schema["type"]};
  schema["type"].push_back("string");
  std::string words;
  for (const Choice& choice : key.choices) words += "|^" + choice.name + "$";
  schema["pattern"] = "^[-+.0-9eE]+ *(" + units + ")$" + words;
  return schema;
}

// The notes on the choices stand where the language server Taplo looks for them.
Json choice_schema(const std::vector<Choice>& choices) {
  Json names = Json::array(), notes = Json::array();
  for (const Choice& choice : choices) {
    names.push_back(choice.name);
    notes.push_back(choice.note);
  }
  return {{"type", "string"}, {"enum", names}, {"x-taplo", {{"docs", {{"enumValues", notes}}}}}};
}

// A list of objects: a position, and a number, a table of pairs or a face.
Json placed_schema(const CaseKey& key) {
  const bool gauges = !key.choices.empty();
  CaseKey position;
  position.unit = "m";
  position.limits = {.minimum = 0.0, .maximum = 1.0};
  Json items = {
      {"type", "object"},
      {"properties",
       {{"position", number_or_unit_schema(position)},
        {key.quantity(), gauges ? choice_schema(key.choices) : number_or_unit_schema(key)}}},
      {"required", Json::array({"position"})},
      {"minProperties", gauges ? 1 : 2},
      {"maxProperties", 2},
      {"additionalProperties", false}};
  if (key.leaf() == "forces") {
    const Json any = {{"type", Json::array({"number", "string"})}};
    const Json pair = {{"type", "array"}, {"items", any}, {"minItems", 2}, {"maxItems", 2}};
    items["properties"]["table"] = {{"type", "array"}, {"items", pair}, {"minItems", 2}};
  }
  if (key.leaf() == "springs") {
    CaseKey gap = position, damping;
    gap.limits = damping.limits = {.minimum = 0.0};
    items["properties"].update({{"one_sided", {{"type", "boolean"}}},
                                {"gap", number_or_unit_schema(gap)},
                                {"side", {{"enum", {"behind", "before"}}}},
                                {"damping", number_schema("number", damping.limits)}});
    items["maxProperties"] = 6;
  }
  return {{"type", "array"}, {"items", items}};
}

Json value_schema(const CaseKey& key) {
  switch (key.type) {
    case KeyType::text:
      return {{"type", "string"}};
    case KeyType::flag:
      return {{"type", "boolean"}};
    case KeyType::number:
      return number_or_unit_schema(key);
    case KeyType::count:
      return number_schema("integer", key.limits);
    case KeyType::choice:
      return choice_schema(key.choices);
    case KeyType::pair:
      return {{"type", "array"},
              {"items", choice_schema(key.choices)},
              {"minItems", 2},
              {"maxItems", 2}};
    case KeyType::numbers:
      return {{"type", "array"}, {"items", number_or_unit_schema(key)}};
    case KeyType::placed:
      return placed_schema(key);
  }
  return Json::object();
}

std::string description(const CaseKey& key) {
  return key.meaning + (key.unit.empty() ? "" : " (" + key.unit + ")") +
         (key.range.empty() ? "" : "; " + key.range) +
         (key.required ? "; required" : "; default: " + key.default_text);
}

// Nothing where the default follows from other keys or has no form in JSON.
Json default_value(const CaseKey& key) {
  const std::optional<KeyValue> value = key.get(Case{});
  if (key.required || !value || to_text(*value) != key.default_text) return nullptr;
  if (const auto* x = std::get_if<double>(&*value); x != nullptr && !std::isfinite(*x)) {
    return nullptr;
  }
  return json_of(*value);
}

Json key_schema(const CaseKey& key) {
  Json schema = {{"description", description(key)}};
  schema.update(value_schema(key));
  if (const Json value = default_value(key); !value.is_null()) schema["default"] = value;
  return schema;
}

Json object_schema() {
  return {{"type", "object"}, {"properties", Json::object()}, {"additionalProperties", false}};
}

void require(Json& object, const std::string& name) {
  Json& required = object["required"];
  if (std::find(required.begin(), required.end(), name) == required.end()) {
    required.push_back(name);
  }
}

// The object of a table, such as "beam" or "beam.damping", within another one.
Json& object_of(Json& outer, const std::string& table) {
  const std::size_t dot = table.find('.');
  Json& objects = outer["properties"];
  const std::string first = table.substr(0, dot);
  if (!objects.contains(first)) objects[first] = object_schema();
  return dot == std::string::npos ? objects[first]
                                  : object_of(objects[first], table.substr(dot + 1));
}

}  // namespace

std::string case_file_text(const Case& input) {
  std::string text, table;
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    if (!value || is_empty_list(*value)) continue;
    if (key.table() != table) {
      table = key.table();
      text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    }
    const auto* words = std::get_if<std::string>(&*value);
    const char* comment = input.assumed.contains(key.name) ? "# assumed: " : "";
    text += fmt::format("{}{} = {}{}\n", comment, key.leaf(),
                        words ? toml_text(*words) : to_text(*value),
                        key.unit.empty() || words ? "" : "  # " + key.unit);
  }
  return text;
}

std::string case_identity(const Case& input, const GivenKeys& given, const std::string& how) {
  constexpr std::size_t n_digits = 32;
  std::string text = project_version() + '\n';
  for (const CaseKey& key : case_keys()) {
    if (key.name == "title") continue;
    const auto value = key.get(input);
    text += key.name + '=' + (value ? to_text(*value) : std::string()) + '\n';
  }
  const OpenChoices open = open_choices(given);
  text +=
      fmt::format("open: {} {} {} {}\n{}", open.mesh, open.size, open.method, open.tolerance, how);
  std::istringstream stream(text);
  return fingerprint_of(stream).sha256.substr(0, n_digits);
}

std::string case_schema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                 {"title", "subimpact case"},
                 {"description", "A strike of a rigid mass on a beam, in SI units"}};
  schema.update(object_schema());
  for (const CaseKey& key : case_keys()) {
    const std::string table = key.table();
    Json& object = table.empty() ? schema : object_of(schema, table);
    object["properties"][key.leaf()] = key_schema(key);
    if (!key.required) continue;
    if (!key.is_needless) require(object, key.leaf());
    if (!table.empty()) require(schema, table);
  }
  return schema.dump(2) + "\n";
}

}  // namespace subimpact
