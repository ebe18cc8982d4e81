#include "io/records/record.h"

#include <algorithm>

#include "case/keys/units.h"

namespace subimpact {
namespace {

Json json_of(const PlacedValues& placed) {
  Json list = Json::array();
  for (const auto& [position, table, word, in_metres, one_sided] : placed.entries) {
    list.push_back({{"position", position}});
    if (in_metres) list.back()["position"] = fmt::format("{} m", position);
    if (table.size() > 1) {
      list.back()["table"] = table;
    } else {
      list.back()[placed.quantity] = table.empty() ? Json(word) : Json(table.front().second);
    }
    if (!one_sided) continue;
    list.back().update({{"one_sided", true},
                        {"gap", one_sided->gap},
                        {"side", one_sided->side == SpringSide::before ? "before" : "behind"},
                        {"damping", one_sided->damping}});
  }
  return list;
}

// A number, or a text of one with its unit.
std::optional<double> number_in(const Json& json, const std::string& unit) {
  if (json.is_string()) return value_in(unit, json.get<std::string>());
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

// Takes what makes a spring push only out of its object; false where it is not as it should be.
bool take_one_sided(Json& item, std::optional<OneSided>& one_sided) {
  const auto take = [&](const char* name, Json otherwise) {
    const Json value = item.value(name, std::move(otherwise));
    return item.erase(name) > 0 ? std::pair(true, value) : std::pair(false, value);
  };
  const auto [is_given, pushes_only] = take("one_sided", false);
  const auto [has_gap, gap] = take("gap", 0.0);
  const auto [has_side, side] = take("side", "behind");
  const auto [has_damping, damping] = take("damping", 0.0);
  if (!pushes_only.is_boolean()) return false;
  if (!pushes_only.get<bool>()) return !has_gap && !has_side && !has_damping;
  const auto length = number_in(gap, "m"), chi = number_in(damping, "s/m");
  if (!length || !chi || (side != "behind" && side != "before")) return false;
  one_sided = {*length, side == "before" ? SpringSide::before : SpringSide::behind, *chi};
  return true;
}

// A list of things at points, each a position and one other number, of forces perhaps a table, or
// of gauges a face, the back if there is none.
std::optional<KeyValue> placed_in(const Json& list, const CaseKey& key) {
  PlacedValues values{key.quantity(), {}};
  for (Json item : list) {
    if (!item.is_object() || !item.contains("position")) return std::nullopt;
    auto& entry = values.entries.emplace_back();
    entry.in_metres = item.at("position").is_string();
    const auto position = number_in(item.at("position"), entry.in_metres ? "m" : "");
    if (!key.choices.empty()) item.emplace("face", "back");
    if (key.leaf() == "springs" && !take_one_sided(item, entry.one_sided)) return std::nullopt;
    const bool is_table = key.leaf() == "forces" && item.contains("table");
    const char* what = is_table ? "table" : key.quantity();
    if (!position || item.size() != 2 || !item.contains(what)) return std::nullopt;
    entry.position = *position;
    if (!key.choices.empty()) {
      if (!item.at(what).is_string()) return std::nullopt;
      entry.word = item.at(what).get<std::string>();
      continue;
    }
    const Json rows = is_table ? item.at(what) : Json{{0.0, item.at(what)}};
    if (!rows.is_array() || rows.size() < (is_table ? 2 : 1)) return std::nullopt;
    for (const Json& row : rows) {
      if (!row.is_array() || row.size() != 2) return std::nullopt;
      const auto time = number_in(row[0], "s"), amount = number_in(row[1], key.unit);
      if (!time || !amount) return std::nullopt;
      entry.table.emplace_back(*time, *amount);
    }
  }
  return values;
}

}  // namespace

Json json_of(const KeyValue& value) {
  if (const auto* placed = std::get_if<PlacedValues>(&value)) return json_of(*placed);
  return std::visit(
      [](const auto& x) -> Json {
        if constexpr (std::is_constructible_v<Json, decltype(x)>) return x;
        return nullptr;
      },
      value);
}

std::optional<KeyValue> key_value_of(const CaseKey& key, const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number_integer()) return integer<std::int64_t>(json);
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  if (!json.is_array()) return std::nullopt;
  if (key.type == KeyType::placed) return placed_in(json, key);
  if (std::ranges::all_of(json, &Json::is_string)) return json.get<std::vector<std::string>>();
  if (std::ranges::all_of(json, &Json::is_number)) return json.get<std::vector<double>>();
  return std::nullopt;
}

Json json_of(double value, Form form) {
  const bool is_null = !std::isfinite(value) || (form == Form::zero_is_null && value == 0.0);
  return is_null ? Json(nullptr) : Json(value);
}

Json json_of(const std::string& text, Form form) {
  return text.empty() && form == Form::empty_is_null ? Json(nullptr) : Json(text);
}

Json& place_in(Json& object, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? object[name] : object[name.substr(0, dot)][name.substr(dot + 1)];
}

}  // namespace subimpact
