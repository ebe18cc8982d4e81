#pragma once

/// What users write in place of what case files have, and what they probably meant: names that are
/// mistyped or misplaced, and decimal commas.

#include <string>
#include <string_view>

namespace subimpact {

/// The number with a decimal comma at the start of a text: "0,201" of "0,201 # kg"; else empty.
std::string_view leading_decimal_comma(std::string_view text);

/// The end of a message about a text that is such a number: how to write it; empty for other texts.
std::string decimal_comma_hint(std::string_view text);

bool is_case_table(const std::string& name);

/// "table.leaf"; the leaf alone outside all tables, where `table` is empty.
std::string full_key_name(const std::string& table, const std::string& leaf);

/// What is wrong with a key or a table that case files do not have, what they have there, and what
/// the user probably meant: a slip of the pen or a name of another table.
std::string unknown_key(const std::string& table, const std::string& leaf);
std::string unknown_table(const std::string& name);

}  // namespace subimpact
