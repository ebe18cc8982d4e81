#pragma once

#include <nlohmann/json.hpp>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// A value of a key as JSON, things at points as a list of objects, and such a list as a value.
nlohmann::ordered_json json_of(const KeyValue& value);
PlacedValues placed_of(const CaseKey& key, const nlohmann::ordered_json& json);

}  // namespace subimpact
