#include "io/key_json.h"

namespace subimpact {

using Json = nlohmann::ordered_json;

Json json_of(const KeyValue& value) {
  const auto* placed = std::get_if<PlacedValues>(&value);
  if (placed == nullptr) {
    return std::visit(
        [](const auto& x) -> Json {
          if constexpr (std::is_same_v<std::decay_t<decltype(x)>, PlacedValues>)
            return nullptr;
          else
            return Json(x);
        },
        value);
  }
  Json list = Json::array();
  for (const auto& [position, table] : placed->entries) {
    Json entry = {{"position", position}};
    if (table.size() > 1) {
      entry["table"] = table;
    } else {
      entry[placed->quantity] = table.front().second;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

PlacedValues placed_of(const CaseKey& key, const Json& json) {
  PlacedValues placed{key.leaf() == "forces" ? "force" : "stiffness", {}};
  for (const Json& item : json) {
    auto& [position, table] = placed.entries.emplace_back();
    position = item.at("position").get<double>();
    if (item.contains("table")) {
      table = item.at("table").get<std::vector<std::pair<double, double>>>();
    } else {
      table = {{0.0, item.at(placed.quantity).get<double>()}};
    }
  }
  return placed;
}

}  // namespace subimpact
