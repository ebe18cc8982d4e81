#include "case/keys/slips.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>
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

// The keys of that name in all tables, required ones first.
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

// For a key that `table` does not have: the keys of that name in other tables, else its own key
// with the nearest name.
std::string suggestion(const std::string& table, const std::string& leaf) {
  std::vector<std::string> elsewhere = keys_called(leaf);
  const bool is_moved = !elsewhere.empty() && !table.starts_with("scatter");
  const std::string near = nearest_name(leaf, leaves_of(table));
  if (!near.empty() && !is_moved) {
    return fmt::format("; did you mean \"{}\"?", full_key_name(table, near));
  }
  for (const CaseKey& key : case_keys()) {
    const bool is_within = !table.empty() && key.name.starts_with(table + ".");
    if (is_within && key.leaf() == leaf) return fmt::format("; did you mean \"{}\"?", key.name);
  }
  if (is_case_table(full_key_name(table, leaf))) return "; it is a table";
  if (!is_moved) return "; correct or remove it";
  if (!near.empty()) elsewhere.push_back(full_key_name(table, near));
  return fmt::format("; {} is a key of [{}]: did you mean \"{}\"?", leaf,
                     find_case_key(elsewhere.front())->table(), fmt::join(elsewhere, "\" or \""));
}

// The text after leading digits; nothing if it begins with none.
std::optional<std::string_view> after_digits(std::string_view text) {
  const std::size_t n = std::min(text.find_first_not_of("0123456789"), text.size());
  if (n == 0) return std::nullopt;
  return text.substr(n);
}

std::string_view after_any_of(std::string_view characters, std::string_view text) {
  const bool is_there = !text.empty() && characters.find(text.front()) != std::string_view::npos;
  return text.substr(is_there ? 1 : 0);
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

std::string_view leading_decimal_comma(std::string_view text) {
  const auto fraction = after_digits(after_any_of("+-", text));
  if (!fraction || !fraction->starts_with(',')) return {};
  auto rest = after_digits(fraction->substr(1));
  if (!rest) return {};
  if (rest->starts_with('e') || rest->starts_with('E')) {
    rest = after_digits(after_any_of("+-", rest->substr(1))).value_or(*rest);
  }
  return text.substr(0, text.size() - rest->size());
}

std::string decimal_comma_hint(std::string_view text) {
  const std::string_view comma = leading_decimal_comma(text), unit = text.substr(comma.size());
  const bool is_value = unit.empty() || unit[0] == ' ' || std::isalpha(unit[0]) != 0;
  if (comma.empty() || !is_value) return {};
  std::string number(text);
  number[number.find(',')] = '.';
  return "; TOML writes a decimal point: " + number;
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
