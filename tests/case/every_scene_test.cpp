// One scene in ways that must agree: by every method that takes it, on one half and on the whole,
// and mirrored; and its accounts by all of them.

#include "paper_case.h"
#include "settings.h"

namespace subimpact {
namespace {

/// The published strike on 101 cells, up to `end` (s), but for these keys.
struct SceneRow {
  const char* name;
  SectionKind section;
  double end;
  Settings settings;
  void (*more)(Case&) = [](Case&) {};
};

void PrintTo(const SceneRow& row, std::ostream* out) { *out << row.name; }

const Settings shear{{"beam.theory", "timoshenko"}, {"beam.poisson", 0.33}};

Settings ends(const char* first, const char* last, double position = 0.5) {
  return {{"beam.ends", Names{first, last}}, {"striker.position", position}};
}
Settings mesh(const char* name, std::int64_t elements) {
  return {{"model.mesh", name}, {"model.elements", elements}};
}

// A beam that may lift off springs at its ends and meets another one under its middle.
void put_on_supports(Case& input) {
  input.scene.beam.springs = {
      {0.0, 2e7, OneSided{0.0}}, {1.0, 2e7, OneSided{0.0}}, {0.5, 5e6, OneSided{2e-4}}};
}

void put_on_damped_supports(Case& input) {
  put_on_supports(input);
  for (Spring& spring : input.scene.beam.springs) spring.one_sided->damping = 0.3;
}

// Struck while a load rises, on springs and a bedding, under gravity, turning at first.
void load(Case& input) {
  Beam& beam = input.scene.beam;
  beam.springs = {{0.7, 3e4}, {1.0, 1e4}};
  beam.foundation = 2e4;
  beam.load = 40.0;
  beam.forces = {{0.3, {{1e-4, 0.0}, {7e-4, 60.0}, {1.1e-3, -20.0}, {1.1e-3, 10.0}}}};
  beam.angular_velocity = -0.4;
  input.scene.gravity = 9.81;
  input.scene.striker.gap = 1e-4;
  input.scene.contact = {ContactKind::linear, 2e6, {}, {}, {}};
  input.scene.striker.nose_radius.reset();
}

void damp_contact(Case& input) {
  input.scene.contact = {ContactKind::hertz, 3e10, {}, {}, {}};
  input.scene.contact.damping = 0.3;
  input.scene.striker.nose_radius.reset();
  input.scene.striker.velocity = 8.0;
}

using enum SectionKind;

const SceneRow rows[] = {
    {"elastic", elastic, 0.5e-3, {}},
    {"exact", exact, 0.5e-3, {}},
    {"layers_aside", layers, 0.5e-3, ends("free", "free", 0.31)},
    {"pinned", exact, 0.6e-3, ends("pinned", "pinned")},
    {"clamped", elastic, 0.6e-3, ends("clamped", "clamped")},
    {"cantilever", exact, 0.5e-3, ends("clamped", "free", 0.7)},
    {"clamped_and_pinned", elastic, 0.5e-3, ends("clamped", "pinned", 0.37)},
    {"elements", elastic, 0.4e-3, mesh("hermite", 80)},
    {"elements_that_yield", exact, 0.3e-3, mesh("hermite", 40) + ends("clamped", "clamped")},
    {"elements_aside", exact, 0.3e-3, mesh("hermite", 40) + ends("pinned", "clamped", 0.31)},
    {"shear", exact, 0.5e-3, shear},
    {"shear_aside", elastic, 0.5e-3, shear + ends("clamped", "pinned", 0.37)},
    {"shear_on_elements", elastic, 0.5e-3, shear + mesh("spectral", 20)},
    {"held", exact, 0.6e-3, ends("pinned", "pinned") + Settings{{"beam.axial", "held"}}},
    {"held_on_elements", elastic, 0.6e-3,
     shear + mesh("spectral", 20) + ends("clamped", "clamped") + Settings{{"beam.axial", "held"}}},
    {"damped", elastic, 0.5e-3, {{"beam.damping.mass", 400.0}, {"beam.damping.stiffness", 2e-8}}},
    {"damped_by_modes", elastic, 0.5e-3, {{"beam.damping.ratio", 0.01}}},
    {"damped_and_yields", exact, 0.4e-3, {{"beam.damping.stiffness", 2e-8}}},
    {"damped_contact", exact, 0.4e-3, {}, damp_contact},
    {"on_supports", elastic, 0.6e-3, mesh("hermite", 20), put_on_supports},
    {"on_supports_and_yields", exact, 0.4e-3, {}, put_on_supports},
    {"on_damped_supports", elastic, 0.6e-3, mesh("hermite", 20), put_on_damped_supports},
    {"loaded", elastic, 2e-3,
     mesh("hermite", 20) + ends("pinned", "free", 0.6) + Settings{{"striker.velocity", 1.5}}, load},
    {"loaded_and_yields", exact, 1.2e-3,
     mesh("hermite", 20) + ends("pinned", "free", 0.6) +
         Settings{{"striker.velocity", 4.0}, {"beam.yield_stress", 20e6}},
     load},
    {"rigid", exact, 1e-3, {{"model.mesh", "rigid"}, {"striker.velocity", 1.9}}},
    {"gap", exact, 0.5e-3, {{"striker.gap", 1e-3}}},
};

Case case_of(const SceneRow& row) {
  Case input = paper_case(row.section, row.end, 101, Method::nystrom);
  input = changed(input, row.settings);
  row.more(input);
  if (!refusal_of(input).key.empty()) input.solver.method = Method::erk;  // a damped one
  input.solver.rtol = 1e-10;
  return input;
}

struct Way {
  Method method;
  double rtol, tolerance_us, energy;
};

constexpr Way ways[] = {
    {Method::erk, 1e-10, 1e-4, 1e-7}, {Method::exponential, 1e-10, 1e-4, 1e-7},
    {Method::dirk, 1e-9, 2e-4, 1e-6}, {Method::adams, 1e-10, 1e-3, 1e-6},
    {Method::bdf, 1e-10, 1e-3, 1e-6}, {Method::central_difference, 1e-9, 0.05, 1e-3}};

// Contacts of the striker and of supports, as far as both runs go.
void expect_same_contacts(const Result& result, const Result& reference, double tolerance_us) {
  const double end = std::min(result.outcome.time, reference.outcome.time);
  const auto times = [end](const Result& of) {
    std::vector<double> all;
    const auto add = [&](const auto& contacts) {
      for (const auto& contact : contacts) {
        if (contact.peak_force < 1.0) continue;
        if (contact.start < end - 1e-8) all.push_back(1e6 * contact.start);
        if (contact.end && *contact.end < end - 1e-8) all.push_back(1e6 * *contact.end);
      }
    };
    add(of.sub_impacts);
    add(of.support_contacts);
    return all;
  };
  expect_near(times(result), times(reference), tolerance_us);
}

class EveryScene : public testing::TestWithParam<SceneRow> {};
INSTANTIATE_TEST_SUITE_P(, EveryScene, testing::ValuesIn(rows), NamedAsPrinted{});

TEST_P(EveryScene, IsTheSameByEveryMethodThatTakesIt) {
  const Case input = case_of(GetParam());
  const Result reference = completed(input);
  EXPECT_LT(reference.max_energy_error, 1e-7);
  // Springs give momentum as their rows do.
  const double of_momentum = input.scene.beam.springs.empty() ? 1e-11 : 1e-8;
  EXPECT_LT(reference.max_momentum_error.value_or(0.0), of_momentum);
  int n_ways = 0;
  for (const Way& way : ways) {
    SCOPED_TRACE(to_string(way.method));
    Case other = input;
    other.solver.method = way.method;
    other.solver.rtol = way.rtol;
    if (way.method == Method::central_difference) other.solver.step = 1e-8;
    const bool is_slow = way.method != Method::erk && way.method != Method::exponential;
    if (is_slow) other.end_time *= 0.6;
    if (!refusal_of(other).key.empty()) continue;
    ++n_ways;
    const Result result = completed(other);
    expect_same_contacts(result, reference, way.tolerance_us);
    EXPECT_LT(result.max_energy_error, way.energy);
    EXPECT_LT(result.max_momentum_error.value_or(0.0), of_momentum);
  }
  EXPECT_GE(n_ways, 2);
}

// With one fixed step, never cut for what sections do in it, both differ by rounding alone.
TEST_P(EveryScene, IsTheSameOnOneHalfAndInAMirror) {
  Case input = case_of(GetParam());
  input.solver.step = 1e-7;
  input.solver.rtol = 1e-2;
  const Result here = completed(input);
  Case other = input;
  if (here.used.half_model) {
    other.model.symmetry = SymmetryUse::off;
  } else {
    Beam& beam = other.scene.beam;
    other.scene.striker.position = 1.0 - other.scene.striker.position;
    std::swap(beam.ends[0], beam.ends[1]);
    beam.angular_velocity = -beam.angular_velocity;
    for (Spring& spring : beam.springs) spring.position = 1.0 - spring.position;
    for (PointForce& force : beam.forces) force.position = 1.0 - force.position;
  }
  const Result there = completed(other);
  EXPECT_FALSE(there.used.half_model);
  expect_same_contacts(there, here, 1e-5);
  EXPECT_NEAR(there.striker_velocity, here.striker_velocity, 1e-7);
  EXPECT_NEAR(there.max_force, here.max_force, 1e-6 * here.max_force);
}

}  // namespace
}  // namespace subimpact
