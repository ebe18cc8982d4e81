// Descriptions of case keys, and messages about refused values.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/other_names.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

std::string quoted(const std::string& text) { return '"' + text + '"'; }

std::vector<std::string> choice_names(const CaseKey& key) {
  std::vector<std::string> names;
  for (const Choice& choice : key.choices) names.push_back(choice.name);
  return names;
}

std::string choice_list(const CaseKey& key) {
  std::vector<std::string> names;
  for (const std::string& name : choice_names(key)) names.push_back(quoted(name));
  return fmt::format("{}", fmt::join(names, ", "));
}

// A value of another type than the key's is shown together with its type.
std::string typed(const KeyValue& value) {
  static constexpr const char* kinds[] = {"a boolean", "a whole number", "a floating-point number",
                                          "a text",    "a list",         "a list of numbers"};
  return fmt::format("{} ({})", kinds[value.index()], to_text(value));
}

bool has_type(const CaseKey& key, const KeyValue& value) {
  switch (key.type) {
    case KeyType::flag:
      return std::holds_alternative<bool>(value);
    case KeyType::count:
      return std::holds_alternative<std::int64_t>(value);
    case KeyType::number:
      return std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
    case KeyType::text:
    case KeyType::choice:
      return std::holds_alternative<std::string>(value);
    case KeyType::pair:
      return std::holds_alternative<std::vector<std::string>>(value);
    case KeyType::numbers: {
      const auto* texts = std::get_if<std::vector<std::string>>(&value);
      return std::holds_alternative<std::vector<double>>(value) ||
             (texts != nullptr && texts->empty());
    }
  }
  return false;
}

bool is_choice(const CaseKey& key, const std::string& name) {
  return std::any_of(key.choices.begin(), key.choices.end(),
                     [&](const Choice& choice) { return choice.name == name; });
}

std::optional<std::string> number_problem(const CaseKey& key, double number,
                                          const KeyValue& value) {
  const bool fits = key.type != KeyType::count || std::abs(number) <= 2147483647.0;
  if (fits && key.limits.hold(number)) return std::nullopt;
  return refusal(key, to_text(value));
}

// The choice meant by a name that is none; empty if there is no telling.
std::string choice_meant(const CaseKey& key, const std::string& name) {
  if (is_choice(key, name)) return name;
  const std::string own = own_name(key.name, name);
  return own.empty() ? nearest_name(name, choice_names(key)) : own;
}

std::optional<std::string> choice_problem(const CaseKey& key, const std::string& name) {
  if (is_choice(key, name)) return std::nullopt;
  const std::string meant = choice_meant(key, name);
  return refusal(key, quoted(name)) +
         (meant.empty() ? "" : "; did you mean " + quoted(meant) + "?");
}

// For one name where two are required: the pair that is probably meant.
std::string pair_hint(const CaseKey& key, const std::string& name) {
  if (key.name == "beam.ends" && name == "cantilever") {
    return R"(; did you mean ["clamped", "free"]?)";
  }
  const std::string meant = choice_meant(key, name);
  return meant.empty() ? "" : fmt::format("; did you mean [{0}, {0}]?", quoted(meant));
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

// "0.201" for "0,201"; empty for a text without decimal comma.
std::string with_decimal_point(std::string text) {
  const std::size_t comma = text.find(',');
  const bool is_decimal = comma != std::string::npos && comma > 0 && comma + 1 < text.size() &&
                          text.find(',', comma + 1) == std::string::npos &&
                          text.find_first_not_of("+-0123456789,.eE") == std::string::npos;
  if (!is_decimal) return {};
  text[comma] = '.';
  return text;
}

}  // namespace

std::string decimal_comma_hint(const std::string& text) {
  const std::string number = with_decimal_point(text);
  return number.empty() ? "" : "; TOML writes a decimal point: " + number;
}

namespace {

// What to change when the value is right but written as another type.
std::string spelling_hint(const CaseKey& key, const KeyValue& value) {
  const bool is_text = std::holds_alternative<std::string>(value);
  if (is_text && key.type == KeyType::pair) return pair_hint(key, std::get<std::string>(value));
  if (is_text && key.type == KeyType::number) {
    const std::string hint = decimal_comma_hint(std::get<std::string>(value));
    if (!hint.empty()) return hint;
  }
  if (is_text && (key.type == KeyType::number || key.type == KeyType::count)) {
    return "; numbers are written without quotes";
  }
  if (key.type == KeyType::count && std::holds_alternative<double>(value)) {
    return "; write it without decimal point and exponent";
  }
  if (key.type == KeyType::flag && is_text) return "; write it without quotes";
  return {};
}

// Insertions, deletions, replacements and swaps of neighbours that turn one word into the other
// (optimal string alignment).
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

std::string remedy(const CaseKey& key) {
  if (key.required) {
    return fmt::format("give the {}{}", key.meaning, key.unit.empty() ? "" : " in " + key.unit);
  }
  const bool as_written = key.default_text.find(':') == std::string::npos;
  return fmt::format("correct it, or leave it out for the default{}{}", as_written ? ", " : " (",
                     key.default_text) +
         (as_written ? "" : ")");
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

std::string to_text(const KeyValue& value) {
  struct Writer {
    std::string operator()(bool x) const { return x ? "true" : "false"; }
    std::string operator()(std::int64_t x) const { return std::to_string(x); }
    std::string operator()(double x) const { return fmt::format("{}", x); }
    std::string operator()(const std::string& x) const { return quoted(x); }
    std::string operator()(const std::vector<std::string>& x) const {
      std::vector<std::string> items;
      for (const std::string& item : x) items.push_back(quoted(item));
      return fmt::format("[{}]", fmt::join(items, ", "));
    }
    std::string operator()(const std::vector<double>& x) const {
      return fmt::format("[{}]", fmt::join(x, ", "));
    }
  };
  return std::visit(Writer{}, value);
}

std::string allowed_values(const CaseKey& key) {
  const std::string unit = key.unit.empty() ? "" : fmt::format(" ({})", key.unit);
  const std::string range = key.range.empty() ? "" : ", " + key.range;
  switch (key.type) {
    case KeyType::number:
      return "a number" + range + unit;
    case KeyType::count:
      return "a whole number" + range + unit;
    case KeyType::flag:
      return "true or false";
    case KeyType::text:
      return "a text in quotes";
    case KeyType::choice:
      return (key.choices.size() == 1 ? "" : "one of ") + choice_list(key);
    case KeyType::pair:
      return "a list of two out of " + choice_list(key);
    case KeyType::numbers:
      return "a list of numbers" + (range.empty() ? "" : ", each " + key.range) + unit;
  }
  return {};
}

std::string refusal(const CaseKey& key, const std::string& found) {
  return fmt::format("is {}; allowed: {}; {}", found, allowed_values(key), remedy(key));
}

std::optional<std::string> problem_with(const CaseKey& key, const KeyValue& value) {
  if (!has_type(key, value)) return refusal(key, typed(value)) + spelling_hint(key, value);
  switch (key.type) {
    case KeyType::number:
      if (const auto* number = std::get_if<double>(&value)) {
        return number_problem(key, *number, value);
      }
      [[fallthrough]];
    case KeyType::count:
      return number_problem(key, static_cast<double>(std::get<std::int64_t>(value)), value);
    case KeyType::choice:
      return choice_problem(key, std::get<std::string>(value));
    case KeyType::pair:
      return pair_problem(key, std::get<std::vector<std::string>>(value), value);
    case KeyType::numbers:
      if (const auto* numbers = std::get_if<std::vector<double>>(&value)) {
        for (const double number : *numbers) {
          if (number_problem(key, number, value)) return refusal(key, to_text(value));
        }
      }
      return std::nullopt;
    case KeyType::flag:
    case KeyType::text:
      return std::nullopt;
  }
  return std::nullopt;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  // Further away than a third of its letters it is another word, not a slip.
  const std::size_t furthest = std::max<std::size_t>(1, name.size() / 3);
  std::size_t best_distance = furthest + 1;
  for (const std::string& candidate : candidates) {
    if (name.size() > candidate.size() + furthest) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace subimpact
