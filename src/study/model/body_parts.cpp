#include "study/model/body_runs.h"

#include <algorithm>
#include <numbers>

#include "case/meshes.h"
#include "case/problem.h"
#include "model/contact/contact_laws.h"
#include "subimpact/study/model.h"

namespace subimpact {
namespace {

constexpr double larger_coefficient = 1.02;
constexpr double larger_poisson = 0.05;
constexpr double fully_plastic = 2.8;  // mean pressure over yield stress
constexpr double deeper = 1.03;        // the error of Boussinesq's root there is 2.7 %
// w = 0.00725 F b^2/D under a force on a long plate clamped along both sides, b apart
// (S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 1959, table 37).
constexpr double plate_compliance = 0.00725;

template <class Change>
Case with(const Case& input, Change change) {
  Case other = input;
  change(other.scene);
  return other;
}

BodyVariant shear_of(const Case& input) {
  if (input.scene.beam.shears()) {
    return {BodyPart::shear_coefficient, {with(input, [](Scene& scene) {
              const double larger = larger_coefficient * scene.beam.used_shear_coefficient();
              scene.beam.shear_coefficient = std::min(1.0, larger);
            })}};
  }
  return {BodyPart::shear, {with(input, [](Scene& scene) {
            scene.beam.theory = BeamTheory::timoshenko;
            scene.beam.poisson = scene.beam_poisson().value_or(usual_poisson);
          })}};
}

// The wall of a hollow section under the nose as a spring in place of the contact.
std::optional<Case> on_wall(const Case& input) {
  const Beam& beam = input.scene.beam;
  const CrossSection& section = beam.section;
  const bool has_wall = section.shape == SectionShape::box || section.shape == SectionShape::tube;
  if (!has_wall || beam.fixed) return std::nullopt;
  return with(input, [&](Scene& scene) {
    const double nu = scene.beam_poisson().value_or(usual_poisson);
    const double wall = *section.wall, width = beam.outer_solid().width - wall;
    scene.contact = {};
    scene.contact.kind = ContactKind::linear;
    scene.contact.stiffness = beam.youngs_modulus * std::pow(wall, 3) /
                              (12.0 * (1.0 - nu * nu) * plate_compliance * width * width);
  });
}

std::optional<BodyVariant> law_of(const Case& input) {
  const Contact& contact = input.scene.contact;
  BodyVariant law{BodyPart::contact_law};
  if (contact.stiffness || contact.kind == ContactKind::curve) return std::nullopt;
  const bool is_line = contact.kind == ContactKind::line;
  if (!contact.is_from_mid_plane()) {
    Case next = input;
    choose_scene(next, {{"beam.theory"}, {}});
    const Contact& better = next.scene.contact;
    if (better.kind != contact.kind || better.indentation != contact.indentation) {
      law.cases.push_back(next);
      return law;
    }
    if (contact.kind == ContactKind::foundation) return law;
    if (const auto wall = on_wall(input)) law.cases.push_back(*wall);
  } else {
    Scene changed = input.scene;  // for the law alone
    Beam& beam = changed.beam;
    if (is_line) {
      beam.poisson = changed.contact.beam_poisson = 0.0;  // plane stress
    } else {
      beam.thickness *= deeper;
      if (beam.section.height) *beam.section.height *= deeper;
    }
    law.cases.emplace_back(input).parts.contact_law = make_contact_law(changed);
  }
  if (contact.kind != ContactKind::hertz && std::isfinite(input.scene.beam.yield_stress)) {
    const double first = is_line ? yield_pressure_over_stress_of_line : yield_pressure_over_stress;
    for (const double share : {first, fully_plastic}) {
      law.cases.push_back(with(input, [&](Scene& scene) {
        scene.contact.pressure_by_depth = false;
        scene.contact.yield_pressure = share * scene.beam.yield_stress;
      }));
    }
  }
  return law.cases.empty() ? std::nullopt : std::optional(law);
}

BodyVariant stretching_of(const Case& input) {
  if (input.scene.beam.stretches()) {
    return {BodyPart::stretching,
            {with(input, [](Scene& scene) { scene.beam.axial = AxialEnds::free; })}};
  }
  // A beam with a tension has no modes to damp.
  const Case base = with(input, [](Scene& scene) { scene.beam.damping = {}; });
  return {BodyPart::stretching,
          {with(base, [](Scene& scene) { scene.beam.axial = AxialEnds::held; })},
          base};
}

// Supports a tenth and ten times as stiff as those chosen for ends that rest.
BodyVariant supports_of(const Case& input) {
  BodyVariant variant{BodyPart::support};
  for (const double factor : {0.1, 10.0}) {
    variant.cases.push_back(with(input, [&](Scene& scene) {
      Beam& beam = scene.beam;
      for (const std::size_t end : {0, 1}) {
        if (!std::exchange(beam.rests[end], false)) continue;
        const double stiffness = factor * beam.rest_stiffness();
        beam.springs.push_back({static_cast<double>(end), stiffness, OneSided{}});
      }
      beam.start = BeamStart::equilibrium;
    }));
  }
  return variant;
}

// At rest under gravity where supports hold the beam.
Case under_gravity(const Case& input) {
  return with(input, [](Scene& scene) {
    Beam& beam = scene.beam;
    std::size_t n_held = beam.foundation > 0.0 ? 2 : beam.springs.size();
    for (const EndSupport end : beam.ends) {
      n_held += end == EndSupport::clamped ? 2 : end == EndSupport::pinned ? 1 : 0;
    }
    scene.gravity = standard_gravity;
    const bool rests = !beam.fixed && !beam.moves_at_start() && n_held >= 2;
    if (rests && !beam.has_loads()) beam.start = BeamStart::equilibrium;
  });
}

}  // namespace

std::vector<BodyVariant> body_variants(const Case& input, bool yields) {
  const Beam& beam = input.scene.beam;
  const bool bends = descriptor_of(input.model.mesh).bends && !beam.fixed;
  std::vector<BodyVariant> all;
  if (bends) all.push_back(shear_of(input));
  if (!bends && !beam.fixed) {
    all.push_back({BodyPart::bending, {input}});
    all.back().cases.front().model.mesh = MeshKind::cells;
    all.back().cases.front().model.mesh = default_mesh(all.back().cases.front());
  }
  if (const auto law = law_of(input)) all.push_back(*law);
  const bool assumes_poisson = input.assumed.contains("beam.poisson");
  if (beam.poisson && assumes_poisson && !input.scene.contact.beam_poisson) {
    all.push_back({BodyPart::poisson,
                   {with(input, [](Scene& scene) { *scene.beam.poisson += larger_poisson; })}});
  }
  if (const auto steel = with_steel_contact(input)) all.push_back({BodyPart::nose, {*steel}});
  if (input.assumed.contains("scene.gravity")) {
    all.push_back({BodyPart::gravity, {under_gravity(input)}});
  }
  const bool is_held = std::ranges::count(beam.ends, EndSupport::free) == 0;
  if (bends && is_held) all.push_back(stretching_of(input));
  if (beam.rests[0] || beam.rests[1]) all.push_back(supports_of(input));
  if (yields) {
    all.push_back({BodyPart::width, {input}});
    Case& wide = all.back().cases.front();
    wide.parts.contact_law = contact_law_of(input);
    wide.scene.beam.yield_stress *= 2.0 / std::numbers::sqrt3;
  }
  return all;
}

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

std::optional<Case> with_steel_contact(const Case& input) {
  constexpr double modulus = 210e9, poisson = 0.3;
  if (input.parts.contact_law) return std::nullopt;
  const auto& law = built_in_contact_law(input.scene.contact.kind);
  if (!uses_key(constants_given(input, law), "contact.beam_poisson")) return std::nullopt;
  Case steel = input;
  Contact& contact = steel.scene.contact;
  Beam& beam = steel.scene.beam;
  const bool is_plane_open = beam.fixed && beam.youngs_modulus == 0.0;
  if (contact.striker_modulus && !is_plane_open) return std::nullopt;
  if (!contact.striker_modulus) {
    contact.striker_modulus = modulus;
    contact.striker_poisson = poisson;
  }
  if (is_plane_open) {
    beam.youngs_modulus = modulus;
    beam.poisson = contact.beam_poisson = poisson;
  }
  return steel;
}

}  // namespace subimpact
