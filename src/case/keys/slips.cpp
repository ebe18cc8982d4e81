#include "case/keys/slips.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// Insertions, deletions, replacements and swaps of neighbours (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Distances of the first i letters of `a`, and of i - 1 and i - 2, from the first j of `b`.
  std::vector<std::size_t> now(b.size() + 1), before(b.size() + 1), two_before(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) now[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(two_before, before);
    std::swap(before, now);
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now[j] = std::min({before[j] + 1, now[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) now[j] = std::min(now[j], two_before[j - 2] + 1);
    }
  }
  return now[b.size()];
}

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

bool is_of_scatter(std::string_view name) { return name.starts_with("scatter"); }

// The keys of that name in all tables that are or are not of the scatter, required ones first.
std::vector<std::string> keys_called(const std::string& leaf, bool of_scatter) {
  std::vector<std::string> names;
  for (const bool required : {true, false}) {
    for (const CaseKey& key : case_keys()) {
      const bool is_it = is_of_scatter(key.name) == of_scatter && key.leaf() == leaf;
      if (is_it && key.required == required) names.push_back(key.name);
    }
  }
  return names;
}

// The keys that may be meant by one that `table` does not have: those of that name elsewhere, and
// the nearest of the table.
std::string suggestion(const std::string& table, const std::string& leaf) {
  if (is_case_table(full_key_name(table, leaf))) return "; it is a table";
  std::vector<std::string> meant = keys_called(leaf, is_of_scatter(table));
  const std::string near = nearest_name(leaf, leaves_of(table));
  if (!near.empty()) meant.push_back(full_key_name(table, near));
  return meant.empty() ? "; correct or remove it"
                       : fmt::format("; did you mean \"{}\"?", fmt::join(meant, "\" or \""));
}

}  // namespace

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  // A name that differs in more than a third of its letters is another word, not a slip; one that
  // is cut short is none.
  const std::size_t furthest = std::max<std::size_t>(1, name.size() / 3);
  std::size_t best_distance = furthest + 1;
  constexpr std::size_t fewest_letters = 3;
  for (const std::string& candidate : candidates) {
    if (name.size() > candidate.size() + furthest) continue;
    if (name.size() >= fewest_letters && candidate.starts_with(name)) return candidate;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

bool is_case_table(const std::string& name) {
  return std::any_of(case_keys().begin(), case_keys().end(), [&](const CaseKey& key) {
    return !name.empty() && (key.table() == name || key.name.starts_with(name + "."));
  });
}

std::string full_key_name(const std::string& table, const std::string& leaf) {
  return table.empty() ? leaf : table + "." + leaf;
}

std::string unknown_key(const std::string& table, const std::string& leaf) {
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
