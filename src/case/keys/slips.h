#pragma once

/// What users write in place of what case files have, and what they probably meant: names that are
/// mistyped, misplaced or those of other programs, and decimal commas.

#include <string>
#include <string_view>

namespace subimpact {

/// The number with a decimal comma at the start of a text: "0,201" of "0,201 # kg"; else empty.
std::string_view leading_decimal_comma(std::string_view text);

/// The end of a message about a text that is such a number: how to write it; empty for other texts.
std::string decimal_comma_hint(std::string_view text);

/// What a choice of a key is called here, for its name elsewhere ("fixed": "clamped"); else empty.
std::string own_name(std::string_view key, std::string_view name);

/// What to use in place of a choice that was removed; empty if there was none of that name.
std::string advice_on_removed(std::string_view key, std::string_view name);

bool is_case_table(const std::string& name);

/// "table.leaf"; the leaf alone outside all tables, where `table` is empty.
std::string full_key_name(const std::string& table, const std::string& leaf);

/// What is wrong with a key or a table that case files do not have, what they have there, and what
/// the user probably meant: a slip of the pen, a name of another table or of another program.
std::string unknown_key(const std::string& table, const std::string& leaf);
std::string unknown_table(const std::string& name);

}  // namespace subimpact
