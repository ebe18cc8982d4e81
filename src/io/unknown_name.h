#pragma once

#include <string>

namespace subimpact {

/// Whether case files have a table of that name, or tables within it.
bool is_case_table(const std::string& name);

/// "table.leaf"; the leaf alone outside all tables, where `table` is empty.
std::string full_key_name(const std::string& table, const std::string& leaf);

/// What is wrong with a key or a table that case files do not have, what they have there, and what
/// the user probably meant: a slip of the pen, the name in another table, an older name.
std::string unknown_key(const std::string& table, const std::string& leaf);
std::string unknown_table(const std::string& name);

}  // namespace subimpact
