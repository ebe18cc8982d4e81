#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "io/records/record.h"

namespace subimpact {

/// Keys, tables and lists of a case are nested three deep at most.
constexpr std::size_t deepest_nesting = 32;

/// The number, from 1, of the first line of a TOML text on which more parts of a dotted key, or
/// more open lists and inline tables, follow one another than deepest_nesting. toml++ takes dotted
/// keys of any depth and frees their tables by recursion, which exhausts the stack. A text that is
/// no TOML is counted right up to its first error, where its parser stops.
std::optional<std::size_t> too_deep_at(std::string_view toml);

/// The value of a node. Dates and times, which no key holds, are null.
Json json_of(const toml::node& node);

/// What a node is, in words: "a text".
std::string describe_type(const toml::node& node);

}  // namespace subimpact
