#include "case/units.h"

#include <algorithm>
#include <cstdlib>

namespace subimpact {
namespace {

struct NamedUnit {
  std::string_view of_keys, name;
  int power;  // of ten, to the unit of keys
};

constexpr NamedUnit named_units[] = {
    {"m", "m", 0},         {"m", "mm", -3},       {"m", "um", -6},     {"m", "cm", -2},
    {"m", "km", 3},        {"s", "s", 0},         {"s", "ms", -3},     {"s", "us", -6},
    {"s", "ns", -9},       {"kg", "kg", 0},       {"kg", "g", -3},     {"kg", "t", 3},
    {"m/s", "m/s", 0},     {"m/s", "mm/s", -3},   {"m/s", "km/s", 3},  {"Pa", "Pa", 0},
    {"Pa", "kPa", 3},      {"Pa", "MPa", 6},      {"Pa", "GPa", 9},    {"Pa", "N/mm2", 6},
    {"kg/m3", "kg/m3", 0}, {"kg/m3", "g/cm3", 3}, {"1/s", "1/s", 0},   {"s/m", "s/m", 0},
    {"N", "N", 0},         {"N", "mN", -3},       {"N", "kN", 3},      {"N", "MN", 6},
    {"Hz", "Hz", 0},       {"Hz", "kHz", 3},      {"Hz", "MHz", 6},    {"N/m", "N/m", 0},
    {"N/m", "N/mm", 3},    {"N/m", "kN/m", 3},    {"m/s2", "m/s2", 0}, {"rad/s", "rad/s", 0},
    {"N/m2", "N/m2", 0},
};

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
  const auto [number, given] = split_unit(text);
  for (const auto& [of_keys, name, power] : named_units) {
    if (number.empty() || of_keys != unit || name != given) continue;
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const int exponent = e < number.size() ? std::atoi(number.data() + e + 1) : 0;
    const std::string scaled =
        std::string(number.substr(0, e)) + 'e' + std::to_string(exponent + power);
    return std::strtod(scaled.c_str(), nullptr);
  }
  return std::nullopt;
}

std::string units_beside(std::string_view unit, std::string_view separator) {
  std::string names;
  for (const NamedUnit& known : named_units) {
    if (known.of_keys != unit) continue;
    names += names.empty() ? "" : separator;
    names += known.name;
  }
  return names;
}

}  // namespace subimpact
