#include "case/scale_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// Squares and quotients of two such numbers are finite, on the finest mesh too.
constexpr double most_decades = 60.0;

/// A key to a power.
struct Factor {
  const char* key;
  double power;
};

/// A product of powers of keys.
struct Quantity {
  const char* name;
  const char* unit;
  std::vector<Factor> factors;
};

const std::vector<Quantity> quantities = {
    {"mass of the beam",
     "kg",
     {{"beam.density", 1}, {"beam.width", 1}, {"beam.thickness", 1}, {"beam.length", 1}}},
    {"moment of inertia of the beam",
     "kg m2",
     {{"beam.density", 1}, {"beam.width", 1}, {"beam.thickness", 1}, {"beam.length", 3}}},
    {"rotary inertia of the sections",
     "kg m",
     {{"beam.density", 1}, {"beam.width", 1}, {"beam.thickness", 3}}},
    {"bending stiffness",
     "N m2",
     {{"beam.youngs_modulus", 1}, {"beam.width", 1}, {"beam.thickness", 3}}},
    {"stiffness of the beam",
     "N/m",
     {{"beam.youngs_modulus", 1}, {"beam.width", 1}, {"beam.thickness", 3}, {"beam.length", -3}}},
    {"square of the beam's lowest frequency",
     "1/s2",
     {{"beam.youngs_modulus", 1},
      {"beam.density", -1},
      {"beam.thickness", 2},
      {"beam.length", -4}}},
    {"slenderness of the beam", "", {{"beam.thickness", 1}, {"beam.length", -1}}},
    {"yield curvature",
     "1/m",
     {{"beam.yield_stress", 1}, {"beam.youngs_modulus", -1}, {"beam.thickness", -1}}},
    {"yield moment", "N m", {{"beam.yield_stress", 1}, {"beam.width", 1}, {"beam.thickness", 2}}},
    {"energy of the strike", "J", {{"striker.mass", 1}, {"striker.velocity", 2}}},
};

// log10 of a key's value; 0 for a value that is not given, zero or infinite.
double decades_of(const Case& input, const char* name) {
  const std::optional<KeyValue> value = find_case_key(name)->get(input);
  const double number = value ? std::abs(std::get<double>(*value)) : 1.0;
  return number > 0.0 && std::isfinite(number) ? std::log10(number) : 0.0;
}

[[noreturn]] void refuse(const Case& input, const char* name, const std::string& consequence) {
  const CaseKey& key = *find_case_key(name);
  throw InvalidCase(name,
                    fmt::format("is {}{}{}{}; allowed: from 1e-{:.0f} to 1e{:.0f}; check the units",
                                to_text(*key.get(input)), key.unit.empty() ? "" : " ", key.unit,
                                consequence, most_decades, most_decades));
}

}  // namespace

void check_scales(const Case& input) {
  for (const CaseKey& key : case_keys()) {
    if (key.type != KeyType::number || !key.get(input)) continue;
    if (std::abs(decades_of(input, key.name.c_str())) > most_decades) {
      refuse(input, key.name.c_str(), ", beyond what a run can follow");
    }
  }
  for (const Quantity& quantity : quantities) {
    double decades = 0.0;
    const Factor* farthest = &quantity.factors.front();
    const auto share = [&](const Factor& factor) {
      return factor.power * decades_of(input, factor.key);
    };
    for (const Factor& factor : quantity.factors) {
      decades += share(factor);
      if (std::abs(share(factor)) > std::abs(share(*farthest))) farthest = &factor;
    }
    if (std::abs(decades) <= most_decades) continue;
    refuse(input, farthest->key,
           fmt::format(", with which the {} is some 1e{:+.0f}{}{}", quantity.name, decades,
                       *quantity.unit == '\0' ? "" : " ", quantity.unit));
  }
}

}  // namespace subimpact
