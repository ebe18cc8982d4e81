#include "case/keys/units.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace subimpact {
namespace {

struct NamedUnit {
  std::string_view of_keys, name;
  int power;                           // of ten, to the unit of keys
  double factor = 1.0, divisor = 1.0;  // whole numbers, besides
};

constexpr double pound_force = 44482216152605.0;  // 1e-13 N

// clang-format off
constexpr NamedUnit named_units[] = {
    {"m", "m", 0}, {"m", "mm", -3}, {"m", "um", -6}, {"m", "cm", -2}, {"m", "km", 3}, {"m", "nm", -9},
    {"m", "in", -4, 254}, {"m", "inch", -4, 254}, {"m", "ft", -4, 3048},
    {"s", "s", 0}, {"s", "ms", -3}, {"s", "us", -6}, {"s", "ns", -9}, {"s", "ps", -12},
    {"kg", "kg", 0}, {"kg", "g", -3}, {"kg", "t", 3}, {"kg", "mg", -6}, {"kg", "lb", -8, 45359237},
    {"m/s", "m/s", 0}, {"m/s", "mm/s", -3}, {"m/s", "cm/s", -2}, {"m/s", "km/s", 3}, {"m/s", "km/h", 0, 5, 18},
    {"m/s", "ft/s", -4, 3048}, {"m/s", "in/s", -4, 254}, {"m/s2", "m/s2", 0}, {"m/s2", "g", -5, 980665},
    {"Pa", "Pa", 0}, {"Pa", "kPa", 3}, {"Pa", "MPa", 6}, {"Pa", "GPa", 9}, {"Pa", "N/mm2", 6}, {"Pa", "bar", 5},
    {"Pa", "psi", -5, pound_force, 64516}, {"Pa", "ksi", -2, pound_force, 64516},
    {"kg/m3", "kg/m3", 0}, {"kg/m3", "g/cm3", 3}, {"kg/m3", "kg/dm3", 3}, {"kg/m3", "t/m3", 3}, {"kg/m3", "t/mm3", 12},
    {"1/s", "1/s", 0}, {"rad/s", "rad/s", 0}, {"s/m", "s/m", 0},
    {"N", "N", 0}, {"N", "mN", -3}, {"N", "kN", 3}, {"N", "MN", 6}, {"N", "uN", -6}, {"N", "nN", -9},
    {"N", "lbf", -13, pound_force},
    {"N/m2", "N/m2", 0},
    {"N/m", "N/m", 0}, {"N/m", "N/mm", 3}, {"N/m", "kN/m", 3}, {"N/m", "kN/mm", 6}, {"N/m", "MN/m", 6},
    {"N/m", "GN/m", 9},
    {"N/m^1.5", "N/m^1.5", 0}, {"N/m^1.5", "kN/m^1.5", 3}, {"N/m^1.5", "MN/m^1.5", 6}, {"N/m^1.5", "GN/m^1.5", 9},
};
// clang-format on

// Whether a unit of keys is that one, or "N/m^1.5 or N/m" with that one.
bool has_unit(std::string_view unit, std::string_view of_keys) {
  const auto at = std::min(unit.find(" or "), unit.size());
  return unit.substr(0, at) == of_keys || (at < unit.size() && unit.substr(at + 4) == of_keys);
}

// "um", "N/mm2": as in the table, for "µm" (of either letter), "N/mm^2" and "N/mm²".
std::string as_listed(std::string_view unit) {
  std::string name(unit);
  for (const auto& [written, listed] : {std::pair{"\u00b5", "u"},
                                        {"\u03bc", "u"},
                                        {"^2", "2"},
                                        {"^3", "3"},
                                        {"\u00b2", "2"},
                                        {"\u00b3", "3"}}) {
    if (const auto at = name.find(written); at != name.npos) {
      name.replace(at, std::string_view(written).size(), listed);
    }
  }
  return name;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

NumberAndUnit split_unit(std::string_view text) {
  text = trimmed(text);
  const std::string copy(text);
  char* rest = nullptr;
  std::strtod(copy.c_str(), &rest);
  const auto n = static_cast<std::size_t>(rest - copy.c_str());
  const std::string_view number = text.substr(0, n);
  if (number.find_first_of("0123456789") == number.npos) return {};  // "infinite"
  return {number, trimmed(text.substr(n))};
}

std::optional<double> value_in(std::string_view unit, std::string_view text) {
  const auto [number, written] = split_unit(text);
  const std::string given = as_listed(written);
  for (const auto& [of_keys, name, power, factor, divisor] : named_units) {
    if (number.empty() || !has_unit(unit, of_keys) || name != given) continue;
    if (factor != 1.0) {
      const double scale = divisor * std::pow(10.0, -power);
      return std::strtod(std::string(number).c_str(), nullptr) * factor / scale;
    }
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const int exponent = e < number.size() ? std::atoi(number.data() + e + 1) : 0;
    const std::string scaled =
        std::string(number.substr(0, e)) + 'e' + std::to_string(exponent + power);
    return std::strtod(scaled.c_str(), nullptr);
  }
  return std::nullopt;
}

bool is_position(const CaseKey& key) {
  constexpr std::string_view names[] = {"beam.pivot", "striker.position", "output.sections",
                                        "output.points"};
  return std::ranges::find(names, key.name) != std::end(names);
}

KeyValue in_unit_of(const CaseKey& key, KeyValue value) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value);
      texts != nullptr && key.type == KeyType::numbers) {
    std::vector<double> numbers;
    for (const std::string& text : *texts) {
      const std::optional<double> number = value_in(key.unit, text);
      if (!number) return value;
      numbers.push_back(*number);
    }
    if (!numbers.empty()) return numbers;
  }
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || key.type != KeyType::number) return value;
  if (const std::optional<double> number = value_in(key.unit, *text)) return *number;
  return value;
}

std::string units_beside(std::string_view unit, std::string_view separator) {
  std::string names;
  for (const NamedUnit& known : named_units) {
    if (!has_unit(unit, known.of_keys)) continue;
    names += names.empty() ? "" : separator;
    names += known.name;
  }
  return names;
}

}  // namespace subimpact
