#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "case/keys/slips.h"
#include "case/keys/units.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

std::string in_quotes(const std::string& text) { return '"' + text + '"'; }

std::string quoted_list(std::vector<std::string> names) {
  for (std::string& name : names) name = in_quotes(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// A value of another type than the key's is shown together with its type.
std::string typed(const KeyValue& value) {
  static constexpr const char* kinds[] = {
      "a boolean", "a whole number",    "a floating-point number",           "a text",
      "a list",    "a list of numbers", "a list of loads, springs or gauges"};
  return fmt::format("{} ({})", kinds[value.index()], to_text(value));
}

bool is_choice(const CaseKey& key, const std::string& name) {
  return std::ranges::find(key.choices, name, &Choice::name) != key.choices.end();
}

std::optional<std::string> number_problem(const CaseKey& key, double number,
                                          const KeyValue& value) {
  const bool fits = key.type != KeyType::count || std::abs(number) <= 2147483647.0;
  if (fits && key.limits.hold(number)) return std::nullopt;
  return refusal(key, to_text(value));
}

std::optional<std::string> choice_problem(const CaseKey& key, const std::string& name) {
  if (is_choice(key, name)) return std::nullopt;
  const std::string meant = nearest_name(name, key.choice_names());
  return refusal(key, in_quotes(name)) +
         (meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?");
}

// For one name where two are required: the pair that is probably meant.
std::string pair_hint(const CaseKey& key, const std::string& name) {
  const std::string meant = nearest_name(name, key.choice_names());
  return meant.empty() ? "" : fmt::format("; did you mean [{0}, {0}]?", in_quotes(meant));
}

std::optional<std::string> pair_problem(const CaseKey& key, const std::vector<std::string>& names,
                                        const KeyValue& value) {
  if (names.size() == 1) return refusal(key, to_text(value)) + pair_hint(key, names[0]);
  if (names.size() != 2) return refusal(key, to_text(value));
  for (const std::string& name : names) {
    if (!is_choice(key, name)) return choice_problem(key, name);
  }
  return std::nullopt;
}

// The refusal of the first entry in a list of loads, springs or gauges that is not allowed.
std::optional<std::string> placed_problem(const CaseKey& key, const PlacedValues& value) {
  const auto refuse = [&](const std::string& what) { return refusal(key, "a list with " + what); };
  for (const auto& [position, table, word, in_metres, one_sided] : value.entries) {
    if (one_sided && !(one_sided->gap >= 0.0 && std::isfinite(one_sided->gap))) {
      return refuse(fmt::format("gap {}", one_sided->gap));
    }
    if (one_sided && !(one_sided->damping >= 0.0 && std::isfinite(one_sided->damping))) {
      return refuse(fmt::format("damping {}", one_sided->damping));
    }
    if (!(position >= 0.0 && (in_metres || position <= 1.0))) {
      return refuse(fmt::format("position {}", position));
    }
    const bool is_known = !table.empty() || is_choice(key, word);
    if (!is_known) return refuse(value.quantity + ' ' + in_quotes(word));
    for (std::size_t i = 0; i < table.size(); ++i) {
      const auto [time, number] = table[i];
      if (!key.limits.hold(number)) return refuse(fmt::format("{} {}", value.quantity, number));
      if (!(time >= 0.0 && std::isfinite(time)) || (i > 0 && time < table[i - 1].first)) {
        return refuse(fmt::format("time {} in a table", time));
      }
    }
  }
  return std::nullopt;
}

// What to change when the value is right but written as another type.
std::string spelling_hint(const CaseKey& key, const KeyValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) {
    const bool is_decimal = key.type == KeyType::count && std::holds_alternative<double>(value);
    return is_decimal ? "; write it without decimal point and exponent" : "";
  }
  if (key.type == KeyType::pair) return pair_hint(key, *text);
  if (key.type == KeyType::flag) return "; write it without quotes";
  if (key.type != KeyType::number && key.type != KeyType::count) return {};
  if (const std::string meant = nearest_name(*text, key.choice_names()); !meant.empty()) {
    return "; did you mean " + in_quotes(meant) + "?";
  }
  const std::string_view unit = split_unit(*text).unit;
  if (unit.empty()) return "; numbers are written without quotes";
  if (unit.front() == ',') return "; numbers have a decimal point";
  const std::string units = units_beside(is_position(key) ? "m" : key.unit);
  const bool is_known = value_in(key.unit, *text).has_value();
  return units.empty() || is_known ? "; write the number without a unit"
                                   : fmt::format("; \"{}\" is none of its units: {}", unit, units);
}

std::string remedy(const CaseKey& key) {
  if (key.required) {
    if (key.unit.empty()) return "give the " + key.meaning;
    return fmt::format("give the {} in {}", key.meaning.substr(0, key.meaning.find_first_of(";,")),
                       key.unit);
  }
  const bool as_written = key.default_text.find(':') == std::string::npos;
  return fmt::format("correct it, or leave it out for the default{}{}", as_written ? ", " : " (",
                     key.default_text) +
         (as_written ? "" : ")");
}

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

std::string CaseKey::table() const {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? std::string() : name.substr(0, dot);
}

std::string CaseKey::leaf() const {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? name : name.substr(dot + 1);
}

std::vector<std::string> CaseKey::choice_names() const {
  std::vector<std::string> names;
  for (const Choice& choice : choices) names.push_back(choice.name);
  return names;
}

const char* CaseKey::quantity() const {
  return !choices.empty() ? "face" : leaf() == "forces" ? "force" : "stiffness";
}

std::string to_text(const KeyValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return in_quotes(x); }
    std::string operator()(const std::vector<std::string>& x) const {
      return fmt::format("[{}]", quoted_list(x));
    }
    std::string operator()(const std::vector<double>& x) const {
      return fmt::format("[{}]", fmt::join(x, ", "));
    }
    std::string operator()(const PlacedValues& x) const {
      std::vector<std::string> entries;
      for (const auto& [position, table, word, in_metres, one_sided] : x.entries) {
        std::string amount = x.quantity + " = ";
        amount += table.empty() ? in_quotes(word) : fmt::format("{}", table.front().second);
        if (table.size() > 1) {
          std::vector<std::string> pairs;
          for (const auto& [t, f] : table) pairs.push_back(fmt::format("[{}, {}]", t, f));
          amount = fmt::format("table = [{}]", fmt::join(pairs, ", "));
        }
        if (one_sided) {
          amount += fmt::format(", one_sided = true, gap = {}", one_sided->gap);
          if (one_sided->side == SpringSide::before) amount += R"(, side = "before")";
          if (one_sided->damping > 0.0) amount += fmt::format(", damping = {}", one_sided->damping);
        }
        entries.push_back(fmt::format("{{ position = {}, {} }}", position, amount));
      }
      return fmt::format("[{}]", fmt::join(entries, ", "));
    }
  };
  return std::visit(Writer{}, value);
}

std::string value_text(const Case& input, std::string_view key) {
  const CaseKey& known = *find_case_key(key);
  const std::optional<KeyValue> value = known.get(input);
  return value ? to_text(*value) : known.default_text;
}

std::string allowed_values(const CaseKey& key) {
  const std::string unit = key.unit.empty() ? "" : fmt::format(" ({})", key.unit);
  const std::string range = key.range.empty() ? "" : ", " + key.range;
  switch (key.type) {
    case KeyType::number:
      return "a number" + range + unit +
             (key.choices.empty() ? "" : ", or " + quoted_list(key.choice_names()));
    case KeyType::count:
      return "a whole number" + range + unit;
    case KeyType::flag:
      return "true or false";
    case KeyType::text:
      return "a text in quotes";
    case KeyType::choice:
      return (key.choices.size() == 1 ? "" : "one of ") + quoted_list(key.choice_names());
    case KeyType::pair:
      return "a list of two out of " + quoted_list(key.choice_names());
    case KeyType::numbers:
      return "a list of numbers" + (range.empty() ? "" : ", each " + key.range) + unit;
    case KeyType::placed: {
      const std::string list = "a list of { position = x, ";
      const std::string x = R"( }, x from 0 to 1, or a length such as "0.3 m" up to the beam's, )";
      if (!key.choices.empty()) {
        return list + "face = f" + x + "f one of " + quoted_list(key.choice_names());
      }
      if (key.leaf() == "forces") {
        return list + "force = F } or { position = x, table = [[t, F], ...]" + x +
               "F in N, t in s, 0 or above and not descending";
      }
      return list + "stiffness = k" + x + "k " + key.range + unit +
             ", perhaps with one_sided = true, gap = \"0 mm\" or more, side = \"behind\" or "
             "\"before\", damping = 0 s/m or more";
    }
  }
  return {};
}

std::string refusal(const CaseKey& key, const std::string& found) {
  return fmt::format("is {}; allowed: {}; {}", found, allowed_values(key), remedy(key));
}

std::optional<std::string> problem_with(const CaseKey& key, const KeyValue& value) {
  using enum KeyType;
  const KeyType type = key.type;
  const auto* word = std::get_if<std::string>(&value);
  const auto* real = std::get_if<double>(&value);
  const auto* whole = std::get_if<std::int64_t>(&value);
  const auto* names = std::get_if<std::vector<std::string>>(&value);
  const auto* list = std::get_if<std::vector<double>>(&value);
  const auto* things = std::get_if<PlacedValues>(&value);
  const bool is_word = word && (type == text || (type == number && is_choice(key, *word)));
  const bool is_empty = names && names->empty() && (type == numbers || type == placed);
  const bool is_flag = type == flag && std::holds_alternative<bool>(value);
  if (is_word || is_empty || is_flag) return std::nullopt;
  if (word && type == choice) return choice_problem(key, *word);
  if (real && type == number) return number_problem(key, *real, value);
  if (whole && (type == number || type == count)) {
    return number_problem(key, static_cast<double>(*whole), value);
  }
  if (names && type == pair) return pair_problem(key, *names, value);
  if (things && type == placed) return placed_problem(key, *things);
  if (list && type == numbers) {
    const auto fits = [&](double x) { return key.limits.hold(x); };
    return std::ranges::all_of(*list, fits) ? std::nullopt
                                            : std::optional(refusal(key, to_text(value)));
  }
  return refusal(key, typed(value)) + spelling_hint(key, value);
}

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
