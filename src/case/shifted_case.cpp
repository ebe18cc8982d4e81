#include "case/shifted_case.h"

#include <fmt/ranges.h>

#include <cmath>

#include "case/problem.h"

namespace subimpact {

constexpr double largest_shift = 1e-3;  // that the range of a key must leave room for

bool is_number_of_scene(const CaseKey& key) {
  return key.type == KeyType::number &&
         (key.name.starts_with("beam.") || key.name.starts_with("striker.") ||
          key.name.starts_with("contact.") || key.name.starts_with("scene."));
}

std::optional<std::string> why_not_shifted(const Case& input, const CaseKey& key) {
  const bool is_of_mesh = key.type == KeyType::number && key.table() == "model";
  const bool is_placed = key.type == KeyType::placed && key.table() == "beam";
  if (!is_number_of_scene(key) && !is_of_mesh && !is_placed) {
    return fmt::format("is not a number of the scene or of its mesh; allowed here: {}",
                       fmt::join(shifted_keys(input), ", "));
  }
  if (!key.get(input)) return "is not given, so that it has no value to vary; give it in the case";
  if (is_placed) {
    if (!std::get<PlacedValues>(*key.get(input)).entries.empty()) return std::nullopt;
    return "is empty, so that it has no values to vary; give one";
  }
  if (std::holds_alternative<std::string>(*key.get(input))) {
    return fmt::format("is {}, which is no number to vary", to_text(*key.get(input)));
  }
  const double x = std::get<double>(*key.get(input));
  const std::string value = fmt::format("is {:g}, ", x);
  if (x == 0.0 || !std::isfinite(x)) {
    return value + "which has no logarithm to derive by; give a finite value other than 0";
  }
  if (key.name == "striker.position" && is_symmetric(input)) {
    return value +
           "where the scene is symmetric: shifts to either side have the same effect, so that a "
           "derivative is 0 or does not exist; allowed: other positions";
  }
  if (!key.limits.hold(x * std::exp(largest_shift)) ||
      !key.limits.hold(x * std::exp(-largest_shift))) {
    return value + fmt::format("at an end of its range ({}), and shifts to both sides are needed",
                               key.range);
  }
  const std::string why = why_without_effect(input, key);
  return why.empty() ? std::nullopt : std::optional(value + why);
}

std::vector<std::string> shifted_keys(const Case& input) {
  std::vector<std::string> names;
  for (const CaseKey& key : case_keys()) {
    const bool is_second_name = key.name == "contact.beam_poisson" && input.scene.beam.poisson;
    const bool is_of_scene =
        is_number_of_scene(key) || (key.type == KeyType::placed && key.table() == "beam");
    if (!is_of_scene || is_second_name) continue;
    if (!why_not_shifted(input, key)) names.push_back(key.name);
  }
  return names;
}

}  // namespace subimpact
