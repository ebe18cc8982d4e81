#pragma once

#include <optional>
#include <string>

#include <toml++/toml.h>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// The node as a key's value; nothing if no key holds such a thing (a date, a table, a mixed list).
std::optional<KeyValue> to_key_value(const toml::node& node);

/// The node's type in words: "a date", "a table".
std::string describe_type(const toml::node& node);

}  // namespace subimpact
