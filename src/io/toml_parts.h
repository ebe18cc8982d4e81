#pragma once

/// What reading a case file needs beside the parser toml++.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include <toml++/toml.h>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// Keys, tables and lists of a case are nested three deep at most.
constexpr std::size_t deepest_nesting = 32;

/// The number, from 1, of the first line of a TOML text on which more parts of a dotted key, or
/// more open lists and inline tables, follow one another than deepest_nesting. toml++ takes dotted
/// keys of any depth and frees their tables by recursion, which exhausts the stack. A text that is
/// no TOML is counted right up to its first error, where its parser stops.
std::optional<std::size_t> too_deep_at(std::string_view toml);

/// The node as a key's value; nothing if no key holds such a thing (a date, a table, a mixed list).
std::optional<KeyValue> to_key_value(const toml::node& node);

/// The node's type in words: "a date", "a table".
std::string describe_type(const toml::node& node);

/// The number with a decimal comma in a line (from 1) of TOML such as "mass = 0,201"; empty if
/// there is none. Lists are left alone: in [0,5] there are two numbers.
std::string decimal_comma_in(std::string_view text, std::size_t line);

}  // namespace subimpact
