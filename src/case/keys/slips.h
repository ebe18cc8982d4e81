#pragma once

/// Names of keys and tables that case files do not have, and what users probably meant.

#include <string>

namespace subimpact {

bool is_case_table(const std::string& name);

/// "table.leaf"; the leaf alone outside all tables, where `table` is empty.
std::string full_key_name(const std::string& table, const std::string& leaf);

/// What is wrong with a key or a table that case files do not have, what they have there, and what
/// the user probably meant: a slip of the pen or a name of another table.
std::string unknown_key(const std::string& table, const std::string& leaf);
std::string unknown_table(const std::string& name);

}  // namespace subimpact
