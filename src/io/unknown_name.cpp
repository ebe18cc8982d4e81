#include "io/unknown_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "case/other_names.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {

bool is_case_table(const std::string& name) {
  return std::any_of(case_keys().begin(), case_keys().end(), [&](const CaseKey& key) {
    return !name.empty() && (key.table() == name || key.name.starts_with(name + "."));
  });
}

std::string full_key_name(const std::string& table, const std::string& leaf) {
  return table.empty() ? leaf : table + "." + leaf;
}

namespace {

std::vector<std::string> table_names() {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) {
    const bool is_scatter = key.name.starts_with("scatter.");
    const std::string table = is_scatter ? "scatter" : key.table();
    if (!table.empty() && (names.empty() || names.back() != table)) names.push_back(table);
  }
  return names;
}

std::vector<std::string> leaves_of(const std::string& table) {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) {
    if (key.table() == table) names.push_back(key.leaf());
  }
  if (!names.empty() || table.empty()) return names;
  for (const CaseKey& key : case_keys()) {  // of tables within it
    if (key.name.starts_with(table + ".")) names.push_back(key.name.substr(table.size() + 1));
  }
  return names;
}

// The keys of all tables with that name, those that a case must have first.
std::vector<std::string> keys_called(const std::string& leaf) {
  std::vector<std::string> names;
  for (const bool required : {true, false}) {
    for (const CaseKey& key : case_keys()) {
      const bool is_scatter = key.name.starts_with("scatter.");
      if (!is_scatter && key.leaf() == leaf && key.required == required) names.push_back(key.name);
    }
  }
  return names;
}

// For a key that is not known in `table`: the slip meant, else the table in which the name is
// known.
std::string suggestion(const std::string& table, const std::string& leaf) {
  const std::string near = nearest_name(leaf, leaves_of(table));
  if (!near.empty()) return fmt::format("; did you mean \"{}\"?", full_key_name(table, near));
  for (const CaseKey& key : case_keys()) {
    const bool is_within = !table.empty() && key.name.starts_with(table + ".");
    if (is_within && key.leaf() == leaf) return fmt::format("; did you mean \"{}\"?", key.name);
  }
  if (is_case_table(full_key_name(table, leaf))) return "; it is a table";
  const std::vector<std::string> elsewhere = keys_called(leaf);
  if (elsewhere.empty() || table.starts_with("scatter")) return "; correct or remove it";
  return fmt::format("; did you mean \"{}\"?", fmt::join(elsewhere, "\" or \""));
}

}  // namespace

std::string unknown_key(const std::string& table, const std::string& leaf) {
  if (const char* name = moved_to(full_key_name(table, leaf))) {
    const CaseKey& key = *find_case_key(name);
    return fmt::format("unknown key \"{}\"; it has moved to \"{}\": the {}; write {} under [{}]",
                       full_key_name(table, leaf), name, key.meaning, key.leaf(), key.table());
  }
  const std::string where = table.empty() ? "outside all tables" : "in [" + table + "]";
  return fmt::format("unknown key \"{}\"; allowed {}: {}{}", full_key_name(table, leaf), where,
                     fmt::join(leaves_of(table), ", "), suggestion(table, leaf));
}

std::string unknown_table(const std::string& name) {
  const std::string near = nearest_name(name, table_names());
  return fmt::format("unknown table [{}]; allowed: [{}]; {}", name,
                     fmt::join(table_names(), "], ["),
                     near.empty() ? "correct or remove it" : "did you mean [" + near + "]?");
}

}  // namespace subimpact
