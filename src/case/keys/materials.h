#pragma once

#include <algorithm>
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

// clang-format off
inline constexpr Material materials[] = {
    {"S235",      7850, 210e9,   0.30,  235e6, "structural steel, EN 10025-2, up to 16 mm"},
    {"S355",      7850, 210e9,   0.30,  355e6, "structural steel, EN 10025-2, up to 16 mm"},
    {"S690QL",    7850, 210e9,   0.30,  690e6, "quenched structural steel, EN 10025-6, up to 50 mm"},
    {"1.4301",    7900, 200e9,   0.30,  210e6, "stainless steel (304), EN 10088-2, plate"},
    {"1.4404",    8000, 200e9,   0.30,  220e6, "stainless steel (316L), EN 10088-2, plate"},
    {"2024-T3",   2780, 73.1e9,  0.33,  345e6, "aluminium, typical, ASM handbook"},
    {"5754-H111", 2670, 70e9,    0.33,   80e6, "aluminium (AlMg3), EN 485-2, sheet"},
    {"6061-T6",   2700, 68.9e9,  0.33,  240e6, "aluminium, EN 485-2, sheet"},
    {"6082-T6",   2700, 70e9,    0.33,  260e6, "aluminium, EN 485-2, sheet up to 6 mm"},
    {"7075-T6",   2810, 71.7e9,  0.33,  503e6, "aluminium, typical, ASM handbook"},
    {"Ti-6Al-4V", 4430, 113.8e9, 0.342, 880e6, "titanium, annealed, typical, ASM handbook"},
    {"Cu-ETP-R240", 8930, 127e9, 0.34,  180e6, "copper, half hard, EN 1652, strip"}};
// clang-format on

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

inline bool is_value_of_material(std::string_view key) {
  return std::ranges::count(material_values, key, &MaterialValue::key) > 0;
}

}  // namespace subimpact
