#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "subimpact/case/case_keys.h"

namespace subimpact {

using Json = nlohmann::ordered_json;  // readers see members in the order written

/// A value of a key: a number, a text, a list; things at points are a list of objects.
Json json_of(const KeyValue& value);
/// Its inverse, also for what a case file holds. Nothing if no key can hold it (a mixed list).
std::optional<KeyValue> key_value_of(const CaseKey& key, const Json& json);

}  // namespace subimpact
