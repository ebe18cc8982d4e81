#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace subimpact {

/// What `beam.material` stands for: the values of beam.density, beam.youngs_modulus, beam.poisson
/// and beam.yield_stress, where the case does not give them. Nominal values at room temperature and
/// low rates; yield stresses are least values of the standard named, or typical ones of a handbook.
struct Material {
  const char* name;
  double density;         ///< kg/m3
  double youngs_modulus;  ///< Pa
  double poisson;
  double yield_stress;  ///< Pa
  const char* source;   ///< of the yield stress, with the thickness that it holds for
};

std::span<const Material> materials();
/// Nothing for a name that is not in the table.
const Material* find_material(std::string_view name);

/// The keys that a material has values for, and these.
struct MaterialValue {
  const char* key;
  double Material::*value;
};
inline constexpr MaterialValue material_values[] = {
    {"beam.density", &Material::density},
    {"beam.youngs_modulus", &Material::youngs_modulus},
    {"beam.poisson", &Material::poisson},
    {"beam.yield_stress", &Material::yield_stress}};

bool is_value_of_material(std::string_view key);

}  // namespace subimpact
