#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <ranges>
#include <string_view>

#include "case/keys/materials.h"
#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

bool is_rigid(const Case& c) { return !descriptor_of(c.model.mesh).bends; }
bool is_fixed(const Case& c) { return c.scene.beam.fixed; }
bool has_elastic_sections(const Case& c) { return c.model.section == SectionKind::elastic; }
bool never_yields(const Case& c) { return std::isinf(c.scene.beam.yield_stress); }
bool does_not_shear(const Case& c) { return !c.scene.beam.shears(); }

bool is_central(const Case& c) { return descriptor_of(c.solver.method).has_fixed_steps(); }
bool is_not_central(const Case& c) { return !is_central(c); }
bool has_fixed_step(const Case& c) { return c.solver.step.has_value(); }
bool interpolates_events(const Case& c) { return events_of(c) == EventHandling::interpolated; }
bool central_interpolates(const Case& c) { return is_central(c) && !c.solver.events; }
// Section correction works to the tolerance, with a fixed step too.
bool locates_reversals(const Case& c) {
  return may_yield(c) && !interpolates_events(c) && reversals_of(c) == ReversalHandling::located;
}

constexpr const char* nose_radius = "striker.nose_radius";
bool law_ignores_the_nose(const Case& c) {
  return std::ranges::none_of(
      built_in_contact_law(c.scene.contact.kind).ways,
      [](const ContactConstants& way) { return uses_key(way, nose_radius); });
}
bool contact_uses(const Case& c, const char* key) {
  return uses_key(constants_given(c, built_in_contact_law(c.scene.contact.kind)), key);
}

/// A key that is idle where `is_idle` holds, because of the value of the key `because_of`.
struct IdleKey {
  const char* name;
  const char* because_of;
  bool (*is_idle)(const Case&);
};

// The first row that holds gives the reason.
constexpr IdleKey idle_keys[] = {
    {"strike.rest", "repeat.strikes",
     [](const Case& c) { return c.strikes == 1 && !c.parts.start; }},
    {"beam.poisson", "beam.theory",
     [](const Case& c) { return does_not_shear(c) && !contact_uses(c, "contact.beam_poisson"); }},
    {"beam.shear_coefficient", "beam.theory", does_not_shear},
    {nose_radius, "contact.law", law_ignores_the_nose},
    {nose_radius, "contact.stiffness", [](const Case& c) { return !contact_uses(c, nose_radius); }},
    {"striker.nose", "contact.law", law_ignores_the_nose},
    {"striker.nose", "contact.stiffness",
     [](const Case& c) { return !contact_uses(c, nose_radius); }},
    {"contact.indentation", "contact.law",
     [](const Case& c) {
       const ContactKind kind = c.scene.contact.kind;
       return kind == ContactKind::foundation || kind == ContactKind::linear ||
              kind == ContactKind::curve;
     }},
    {"contact.indentation", "contact.stiffness",
     [](const Case& c) { return c.scene.contact.stiffness.has_value(); }},
    {"contact.yield_pressure", "beam.yield_stress",
     [](const Case& c) { return c.scene.contact.pressure_by_depth && never_yields(c); }},
    {"beam.hardening", "model.mesh", is_rigid},
    {"beam.hardening", "model.section", has_elastic_sections},
    {"beam.hardening", "beam.yield_stress", never_yields},
    {"beam.pivot", "beam.angular_velocity",
     [](const Case& c) { return c.scene.beam.angular_velocity == 0.0; }},
    {"beam.load", "beam.fixed", is_fixed},
    {"beam.forces", "beam.fixed", is_fixed},
    {"beam.start", "beam.fixed", is_fixed},
    {"beam.start", "beam.ends",
     [](const Case& c) {
       const Beam& beam = c.scene.beam;
       return (beam.rests[0] || beam.rests[1]) && beam.start == BeamStart::straight;
     }},
    {"beam.damping.ratio", "model.mesh", is_rigid},
    {"beam.damping.stiffness", "model.mesh", is_rigid},
    {"model.section", "model.mesh", is_rigid},
    {"model.section", "beam.yield_stress",
     [](const Case& c) { return never_yields(c) && !has_elastic_sections(c); }},
    {"model.layers", "model.mesh", is_rigid},
    {"model.layers", "model.section",
     [](const Case& c) { return !descriptor_of(c.model.section).has_layers; }},
    {"model.layers", "beam.yield_stress", never_yields},
    {"solver.rtol", "solver.method",
     [](const Case& c) { return is_central(c) && !locates_reversals(c); }},
    // Implicit methods solve their equations to the tolerance, whatever the step.
    {"solver.rtol", "solver.step",
     [](const Case& c) {
       return has_fixed_step(c) && !descriptor_of(c.solver.method).implicit &&
              !locates_reversals(c);
     }},
    {"solver.max_step", "solver.method", is_central},
    {"solver.max_step", "solver.step", has_fixed_step},
    {"solver.reversals", "model.mesh", is_rigid},
    {"solver.reversals", "model.section", has_elastic_sections},
    {"solver.reversals", "beam.yield_stress", never_yields},
    {"solver.reversals", "solver.method", central_interpolates},
    {"solver.reversals", "solver.events", interpolates_events},
    {"study.pair_detection", "solver.method", central_interpolates},
    {"study.pair_detection", "solver.events", interpolates_events},
    {"study.vector_operations", "solver.method",
     [](const Case& c) { return !descriptor_of(c.solver.method).sundials; }},
    {"study.beyond_critical", "solver.method", is_not_central},
    {"study.striker_update", "solver.method", is_not_central},
};

constexpr std::string_view scatter_table = "scatter.";

// The key because of which another one has no effect; nullptr if it has one. A scatter has none if
// its key is not given, 0 or infinite, or has no effect itself.
const char* reason_of(const CaseKey& key, const Case& input) {
  if (key.name.starts_with(scatter_table)) {
    const CaseKey* of = find_case_key(std::string_view(key.name).substr(scatter_table.size()));
    const std::optional<KeyValue> value = of->get(input);
    const double* given = value ? std::get_if<double>(&*value) : nullptr;
    const double number = given != nullptr ? *given : 0.0;
    return number == 0.0 || std::isinf(number) ? of->name.c_str() : reason_of(*of, input);
  }
  const bool of_some_mesh = std::ranges::any_of(meshes(), [&](const MeshDescriptor& mesh) {
    return std::ranges::find(mesh.keys, key.name) != mesh.keys.end();
  });
  if (of_some_mesh && !mesh_uses(input, key.name.c_str())) return "model.mesh";
  for (const IdleKey& row : idle_keys) {
    if (row.name == key.name && row.is_idle(input)) return row.because_of;
  }
  return nullptr;
}

std::string setting_text(const Case& input, std::string_view name) {
  const std::optional<KeyValue> value = find_case_key(name)->get(input);
  return fmt::format("{} = {}", name, value ? to_text(*value) : "(not given)");
}

}  // namespace

std::vector<std::string> keys_without_effect(const Case& input, const GivenKeys& given) {
  std::vector<std::string> notes;
  for (const CaseKey& key : case_keys()) {
    const bool is_of_material = input.scene.beam.material && is_value_of_material(key.name);
    const bool is_asked = given.contain(key.name) && !is_of_material;
    const char* reason = is_asked ? reason_of(key, input) : nullptr;
    if (reason == nullptr) continue;
    if (!given.in_settings.contains(key.name) && given.in_settings.contains(reason)) continue;
    notes.push_back(setting_text(input, key.name) + " " + why_without_effect(input, key));
  }
  return notes;
}

std::string why_without_effect(const Case& input, const CaseKey& key) {
  const char* reason = reason_of(key, input);
  return reason == nullptr ? "" : "has no effect with " + setting_text(input, reason);
}

OpenChoices open_choices(const GivenKeys& given) {
  const auto has_any = [&](std::initializer_list<const char*> keys) {
    return std::ranges::any_of(keys, [&](const char* key) { return given.contain(key); });
  };
  OpenChoices open;
  open.size = !has_any({"model.segments", "model.elements"});
  open.mesh = open.size && !has_any({"model.mesh", "model.spacing"});
  open.tolerance = !has_any({"solver.rtol", "solver.step", "solver.max_step"});
  open.method = open.tolerance && !has_any({"solver.method", "solver.table", "solver.max_order",
                                            "solver.events", "solver.reversals"});
  return open;
}

}  // namespace subimpact
