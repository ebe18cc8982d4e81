#include "study/model/contact_limits.h"

#include <algorithm>
#include <cmath>

#include "case/problem.h"
#include "model/contact/contact_laws.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {

double largest_possible_force(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  if (!(scene.contact_damping() == 0.0)) return HUGE_VAL;  // NaN before a flight
  const Beam& beam = scene.beam;
  double load = std::abs(beam.load) * beam.length;
  for (const PointForce& force : beam.forces) {
    double largest = 0.0;
    for (const auto& [time, value] : force.table) largest = std::max(largest, std::abs(value));
    load += largest;
  }
  const double striker = scene.striker.fixed ? 0.0 : scene.striker.mass;
  load += std::abs(scene.gravity) * (striker + (beam.fixed ? 0.0 : beam.mass()));
  const double way = result.largest_displacement + result.max_indentation + scene.striker.gap;
  const auto law = contact_law_of(input);
  return law->contact_force({}, law->indentation_at(result.used.initial_energy + load * way));
}

std::optional<SteelContact> with_steel_contact(const Case& input) {
  constexpr double modulus = 210e9, poisson = 0.3;
  if (input.parts.contact_law) return std::nullopt;
  const auto& law = built_in_contact_law(input.scene.contact.kind);
  if (!uses_key(constants_given(input, law), "contact.beam_poisson")) return std::nullopt;
  SteelContact steel{input, {}};
  Contact& contact = steel.input.scene.contact;
  Beam& beam = steel.input.scene.beam;
  if (!contact.striker_modulus) {
    contact.striker_modulus = modulus;
    contact.striker_poisson = poisson;
    steel.keys = {"contact.striker_modulus", "contact.striker_poisson"};
  }
  if (beam.fixed && beam.youngs_modulus == 0.0) {
    beam.youngs_modulus = modulus;
    beam.poisson = contact.beam_poisson = poisson;
    steel.keys.insert(steel.keys.end(), {"beam.youngs_modulus", "beam.poisson"});
  }
  return steel.keys.empty() ? std::nullopt : std::optional(std::move(steel));
}

}  // namespace subimpact
