#include "random_scenes/generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "draws.h"
#include "random_scenes/cost.h"
#include "random_scenes/scene_keys.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/simulate/options.h"

namespace subimpact::scenes {
namespace {

struct Budget {
  double seconds;          // of the drawn setting
  double seconds_at_best;  // of erk at rtol 1e-10; 0: not run
};

Budget budget_of(Purpose purpose) {
  switch (purpose) {
    case Purpose::checks:
      return {0.4, 0.0};
    case Purpose::counts:
    case Purpose::scene_keys:
      return {0.4, 0.8};
    case Purpose::slice:
      return {0.05, 0.0};
  }
  return {};
}

void draw_beam(Random& random, Beam& beam) {
  beam.length = random.log_uniform(0.05, 3.0);
  beam.thickness = beam.length * random.log_uniform(1.0 / 300.0, 1.0 / 8.0);
  beam.width = beam.thickness * random.log_uniform(0.3, 30.0);
  beam.density = random.log_uniform(500.0, 20000.0);
  beam.youngs_modulus = random.log_uniform(1e8, 1e12);
  beam.theory = random.chance(0.5) ? BeamTheory::rayleigh : BeamTheory::euler_bernoulli;
  constexpr std::array kinds{EndSupport::free, EndSupport::pinned, EndSupport::clamped};
  beam.ends = {random.one_of(kinds), random.one_of(kinds)};
  if (random.chance(0.3)) beam.ends[1] = beam.ends[0];
}

// Rarely the beam is rigid, for which it has to be free.
void draw_mesh(Random& random, Case& input) {
  ModelOptions& model = input.model;
  const double kind = random.uniform();
  model.symmetry = random.chance(0.75) ? SymmetryUse::automatic : SymmetryUse::off;
  const auto parity = [&](int count, bool odd) {
    return (count % 2 == 1) == odd || random.chance(0.1) ? count : count + 1;
  };
  if (kind < 0.5) {
    model.mesh = MeshKind::cells;
    model.segments = parity(static_cast<int>(random.log_uniform(5.0, 401.0)), true);
  } else if (kind < 0.96) {
    model.mesh = MeshKind::hermite;
    model.elements = parity(static_cast<int>(random.log_uniform(4.0, 100.0)), false);
    random.chance(0.3);  // of a choice that was removed: the scenes of a seed stay
  } else {
    model.mesh = MeshKind::rigid;
    input.scene.beam.ends = {EndSupport::free, EndSupport::free};
  }
}

// Mid-span, anywhere, or the outermost point that can be struck.
void draw_position(Random& random, Case& input) {
  double& position = input.scene.striker.position;
  const double kind = random.uniform();
  position = 0.5;
  if (kind < 0.4) return;
  position = random.uniform();
  if (kind < 0.8) return;
  const double outermost = input.model.mesh == MeshKind::cells ? 0.5 / input.model.segments : 0.0;
  position = position < 0.5 ? outermost : 1.0 - outermost;
}

// Stiffness against the beam's own at mid-span, over many decades.
void draw_contact(Random& random, Case& input) {
  const Beam& beam = input.scene.beam;
  Contact& contact = input.scene.contact;
  Striker& striker = input.scene.striker;
  const double of_beam = 48.0 * beam.bending_stiffness() / std::pow(beam.length, 3);
  const double stiffness = of_beam * random.log_uniform(1e-1, 1e7);
  const double radius = beam.length * random.log_uniform(1e-4, 1e2);
  const double kind = random.uniform();
  if (kind < 0.4) {
    contact.kind = ContactKind::foundation;
    striker.nose_radius = radius;
  } else if (kind < 0.7) {
    contact.kind = ContactKind::linear;
    contact.stiffness = stiffness;
  } else if (kind < 0.85) {
    contact.kind = ContactKind::hertz;
    contact.stiffness = stiffness / std::sqrt(beam.thickness * random.log_uniform(1e-6, 1e-1));
  } else {
    contact.kind = ContactKind::hertz;
    striker.nose_radius = radius;
    contact.striker_modulus = random.chance(0.2) ? INFINITY : random.log_uniform(1e8, 1e12);
    contact.striker_poisson = random.uniform(0.0, 0.5);
    contact.beam_poisson = random.uniform(0.0, 0.5);
  }
}

// The bending stress of a beam whose struck point is carried along at v is sqrt(3) E v/c.
void draw_yield(Random& random, Case& input) {
  Beam& beam = input.scene.beam;
  constexpr std::array kinds{SectionKind::elastic, SectionKind::layers, SectionKind::exact};
  input.model.section = random.one_of(kinds);
  if (input.model.section == SectionKind::layers) {
    input.model.layers = 2 * static_cast<int>(random.log_uniform(1.0, 41.0));
  }
  const double factor = random.log_uniform(0.03, 3.0);
  if (random.chance(0.25)) return;
  const double c = std::sqrt(beam.youngs_modulus / beam.density);
  beam.yield_stress =
      factor * std::sqrt(3.0) * beam.youngs_modulus * input.scene.striker.velocity / c;
}

void draw_strike(Random& random, Case& input) {
  const Beam& beam = input.scene.beam;
  Striker& striker = input.scene.striker;
  striker.mass = beam.mass() * random.log_uniform(1e-5, 1e5);
  striker.velocity = std::sqrt(beam.youngs_modulus / beam.density) * random.log_uniform(1e-7, 1e-2);
  draw_position(random, input);
  draw_contact(random, input);
  draw_yield(random, input);
}

constexpr std::array methods{Method::erk,
                             Method::erk,
                             Method::erk,
                             Method::nystrom,
                             Method::nystrom,
                             Method::nystrom,
                             Method::dirk,
                             Method::adams,
                             Method::exponential,
                             Method::exponential,
                             Method::exponential,
                             Method::dirk,
                             Method::dirk,
                             Method::dirk,
                             Method::adams,
                             Method::bdf,
                             Method::bdf,
                             Method::central_difference,
                             Method::central_difference};

void draw_table(Random& random, SolverOptions& solver) {
  std::vector<std::string> tables;
  for (const MethodTable& table : method_tables()) {
    if (table.method == solver.method) tables.push_back(table.name);
  }
  if (!tables.empty() && random.chance(0.7)) solver.table = random.one_of(tables);
}

void draw_fixed_step(Random& random, Case& input) {
  const double longest = 2.0 / std::max(highest_frequency(input), contact_frequency(input));
  input.solver.step = longest * random.log_uniform(0.02, 0.9);
}

void draw_solver(Random& random, Case& input) {
  SolverOptions& solver = input.solver;
  solver.method = random.one_of(methods);
  solver.rtol = random.log_uniform(1e-12, 1e-1);
  draw_table(random, solver);
  const bool multistep = solver.method == Method::adams || solver.method == Method::bdf;
  if (multistep && random.chance(0.4)) {
    solver.max_order = 1 + static_cast<int>(random.index(solver.method == Method::adams ? 12 : 5));
  }
  const bool needs_step =
      solver.method == Method::central_difference && input.model.mesh == MeshKind::rigid;
  if (needs_step || (!multistep && random.chance(0.08))) draw_fixed_step(random, input);
  if (random.chance(0.06)) {
    solver.events = solver.method == Method::central_difference ? EventHandling::located
                                                                : EventHandling::interpolated;
  }
  if (random.chance(0.06)) {
    solver.reversals = multistep ? ReversalHandling::located : ReversalHandling::step_end;
  }
  if (random.chance(0.06)) input.study.pair_detection = false;
  random.chance(0.05);  // of a choice that was removed: the scenes of a seed stay
  if (random.chance(0.05)) input.study.vector_operations = VectorOperationsKind::library;
  if (random.chance(0.05)) input.stop = StopRule::no_more_contact;
}

// A few first periods or several contact times, but no longer than the budget lasts.
bool draw_end(Random& random, const Budget& budget, Case& input, double& seconds) {
  const double contact = contact_time(input);
  const double period = first_period(input.scene.beam);
  const bool by_period = random.chance(0.5) && input.model.mesh != MeshKind::rigid;
  const double wanted =
      by_period ? random.log_uniform(0.3, 6.0) * period : random.log_uniform(1.5, 15.0) * contact;
  double rate = seconds_a_second(input);
  double longest = budget.seconds / rate;
  if (budget.seconds_at_best > 0.0) {
    Case best = input;
    best.solver = {};
    best.solver.rtol = 1e-10;
    const double best_rate = seconds_a_second(best);
    longest = std::min(longest, budget.seconds_at_best / best_rate);
  }
  input.end_time = std::min(wanted, longest);
  seconds = input.end_time * rate;
  return input.end_time >= std::min(1.2 * contact, 0.3 * period);
}

void draw_output(Random& random, Case& input) {
  input.output.interval = random.chance(0.85) ? input.end_time / 500.0 : 0.0;
  if (input.output.interval > 0.0 && input.model.mesh != MeshKind::rigid && random.chance(0.05)) {
    input.output.sections = {0.5, random.uniform()};
  }
}

bool is_refused(const Case& input) {
  try {
    resolve(input);
    return false;
  } catch (const InvalidCase&) {
    return true;
  }
}

// A stream of its own for each draw of each scene, so that no draw depends on another one's fate.
Random stream_of(const SceneId& id, int attempt) {
  Random random(id.seed);
  std::uint64_t state = random.next();
  for (const int part : {id.number, attempt}) {
    state = Random(state ^ (static_cast<std::uint64_t>(part) * 0xd1342543de82ef95ULL)).next();
  }
  return Random(state);
}

}  // namespace

Drawn draw(const SceneId& id) {
  Drawn drawn;
  for (int attempt = 0;; ++attempt) {
    Random random = stream_of(id, attempt);
    Case input;
    input.title = fmt::format("random scene {} of seed {}", id.number, id.seed);
    draw_beam(random, input.scene.beam);
    draw_mesh(random, input);
    draw_strike(random, input);
    draw_solver(random, input);
    if (!draw_end(random, budget_of(id.purpose), input, drawn.seconds)) {
      ++drawn.too_costly;
      continue;
    }
    draw_output(random, input);
    if (id.purpose == Purpose::scene_keys) draw_scene_keys(random, input);
    if (is_refused(input)) {
      ++drawn.refused;
      continue;
    }
    drawn.input = input;
    return drawn;
  }
}

std::string case_text(const Case& input) {
  std::string text, table;
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    if (!value) continue;
    if (key.table() != table) text += fmt::format("\n[{}]\n", table = key.table());
    text += fmt::format("{} = {}\n", key.leaf(), to_text(*value));
  }
  return text;
}

}  // namespace subimpact::scenes
