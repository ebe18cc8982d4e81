#include "strikes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "case/problem.h"
#include "draws.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact::strikes {
namespace {

// Seconds a step takes for each unknown.
constexpr double seconds_elastic = 2.5e-9;
constexpr double seconds_yielding = 8e-9;

constexpr int pilot_cells = 151;  // on which sub-impacts are counted

bool yields(const Case& input) { return may_yield(input); }

double wave_speed(const Beam& beam) { return std::sqrt(beam.youngs_modulus / beam.density); }

void draw_beam(Random& random, Case& input, const Kind& kind) {
  Beam& beam = input.scene.beam;
  beam.length = random.log_uniform(0.2, 1.5);
  beam.thickness = beam.length * random.log_uniform(1.0 / 150.0, 1.0 / 25.0);
  beam.width = beam.thickness * random.log_uniform(0.5, 5.0);
  beam.density = random.log_uniform(2000.0, 9000.0);
  beam.youngs_modulus = random.log_uniform(5e10, 4e11);
  beam.theory = random.chance(0.6) ? BeamTheory::rayleigh : BeamTheory::euler_bernoulli;
  if (kind.shears) {
    beam.theory = BeamTheory::timoshenko;
    beam.poisson = 0.3;
  }
  constexpr std::array kinds{EndSupport::free, EndSupport::pinned, EndSupport::clamped};
  beam.ends = {random.one_of(kinds), random.one_of(kinds)};
  if (random.chance(0.5)) beam.ends[1] = beam.ends[0];
}

// If only striker and beam as a whole were in contact, it would last half a hundredth to a
// twentieth of the first period.
void draw_contact(Random& random, Case& input, double first_period) {
  const Beam& beam = input.scene.beam;
  Striker& striker = input.scene.striker;
  Contact& contact = input.scene.contact;
  const double mass = striker.mass * beam.mass() / (striker.mass + beam.mass());
  const double duration = first_period * random.log_uniform(0.005, 0.05);
  const double depth = duration * striker.velocity / 2.94;
  const double stiffness = 1.25 * mass * std::pow(striker.velocity, 2) / std::pow(depth, 2.5);
  const double kind = random.uniform();
  if (kind < 0.5) {
    contact.kind = ContactKind::foundation;
    // K = 4 sqrt(2 R) E b/(3 h)
    const double root = 0.75 * stiffness * beam.thickness / (beam.youngs_modulus * beam.width);
    striker.nose_radius = 0.5 * root * root;
  } else if (kind < 0.75) {
    contact.kind = ContactKind::hertz;
    contact.stiffness = stiffness;
  } else {
    contact.kind = ContactKind::linear;
    contact.stiffness = mass * std::pow(std::numbers::pi / duration, 2);
  }
}

double draw_position(Random& random, const Kind& kind) {
  if (!kind.hard) return random.chance(0.5) ? 0.5 : random.uniform(0.1, 0.9);
  const double place = random.uniform();
  if (place < 0.45) return 0.5;
  return place < 0.85 ? random.uniform(0.1, 0.9) : random.log_uniform(0.005, 0.1);
}

void draw_strike(Random& random, Case& input, const Kind& kind) {
  Scene& scene = input.scene;
  const bool light = kind.hard && random.chance(0.25);
  scene.striker.mass =
      scene.beam.mass() * (light ? random.log_uniform(0.005, 0.1) : random.log_uniform(0.1, 5.0));
  scene.striker.velocity = wave_speed(scene.beam) * random.log_uniform(2e-4, 4e-3);
  scene.striker.position = draw_position(random, kind);
  const double level = random.log_uniform(0.15, 1.0);
  const double section = random.uniform();
  input.model.section = section < 0.4    ? SectionKind::elastic
                        : section < 0.92 ? SectionKind::exact
                                         : SectionKind::layers;
  // The bending stress of a beam whose struck point is carried along at v is sqrt(3) E v/c.
  scene.beam.yield_stress = level * std::sqrt(3.0) * scene.beam.youngs_modulus *
                            scene.striker.velocity / wave_speed(scene.beam);
}

// Of the beam, by mass; of elastic contacts. Only some methods take it.
void draw_damping(Random& random, Case& input) {
  input.scene.beam.damping.mass = random.log_uniform(0.01, 1.0);
  if (input.solver.method == Method::nystrom) input.solver.method = Method::erk;
}

MeshKind elements_of(const Case& input) {
  return input.scene.beam.shears() ? MeshKind::spectral : MeshKind::hermite;
}

void draw_mesh(Random& random, Case& input, const Kind& kind) {
  ModelOptions& model = input.model;
  if (random.chance(0.6)) {
    model.mesh = MeshKind::cells;
    const double half =
        kind.hard ? random.log_uniform(75.0, 400.0) : random.log_uniform(100.0, 4001.0);
    model.segments = 2 * static_cast<int>(half) + 1;
    input.solver.method = Method::central_difference;
  } else {
    model.mesh = elements_of(input);
    const double finest = !uses_symmetry(input) ? 50.0 : yields(input) ? 100.0 : 400.0;
    model.elements = 2 * static_cast<int>(random.log_uniform(20.0, finest + 1.0));
    if (model.mesh == MeshKind::spectral) model.elements = 2 * (model.elements / 8 + 1);
    input.solver.method = yields(input) ? Method::nystrom : Method::exponential;
    input.solver.rtol = yields(input) ? 1e-7 : 1e-8;
  }
}

Case elements(Case input, int count) {
  input.model.mesh = elements_of(input);
  input.model.elements = count;
  input.solver = {};
  input.solver.method = Method::exponential;
  input.solver.rtol = 1e-11;
  return input;
}

Case cells(Case input, int count) {
  input.model.mesh = MeshKind::cells;
  input.model.segments = count;
  input.solver = {};
  input.solver.method = Method::central_difference;
  return input;
}

// Elastic beams: elements in modes, far more accurate than any run here. Beams that yield: cells,
// from the run's own mesh on if it has cells.
void choose_finer(DrawnScene& drawn, const Kind& kind) {
  const Case& input = drawn.input;
  const bool rotary = input.scene.beam.theory != BeamTheory::euler_bernoulli;
  if (!yields(input)) {
    drawn.order = 4;
    // Modes of whole models are the eigenvectors of a dense matrix.
    const int per_element = input.scene.beam.shears() ? 4 : 1;  // degree of spectral elements
    const int n = (uses_symmetry(input) ? 400 : 200) / per_element;
    const int coarse = input.model.mesh == MeshKind::cells ? 0 : input.model.elements;
    drawn.finer = {elements(input, std::max(n, 2 * coarse)),
                   elements(input, 2 * std::max(n, 2 * coarse))};
  } else if (input.model.mesh == MeshKind::cells) {
    const double factor = kind.hard ? 4.0 : 2.0;
    drawn.finer = {*on_other_mesh(input, factor), *on_other_mesh(input, 2.0 * factor)};
  } else if (kind.hard) {
    const int count = rotary ? 2401 : 1001;
    drawn.finer = {cells(input, count), cells(input, 2 * count - 1)};
  } else {
    const int count = rotary ? 2001 : 501;
    drawn.finer = {cells(input, count), cells(input, 2 * count - 1), cells(input, 4 * count - 3)};
  }
}

// Of a run by central differences; those by other methods are cheaper here.
double seconds_of(const Case& input) {
  if (input.solver.method == Method::exponential) return 1e-3;
  Case by_steps = input;
  by_steps.solver = {};
  by_steps.solver.method = Method::central_difference;
  const ResolvedSettings settings = resolve(by_steps).settings();
  const double steps = input.end_time / *settings.step;
  double each = static_cast<double>(settings.n_unknowns) *
                (yields(input) ? seconds_yielding : seconds_elastic);
  if (input.model.section == SectionKind::layers) each *= 2.0;
  if (input.solver.method == Method::nystrom) each *= 4.0;
  return steps * each;
}

// A few first periods, no longer than the budget lasts and than the sub-impacts wanted take.
bool draw_end(Random& random, DrawnScene& drawn, double first_period, const Budget& budget,
              const Kind& kind) {
  double end = random.log_uniform(0.3, 2.5) * first_period;
  std::vector<Case*> all{&drawn.input};
  for (Case& finer : drawn.finer) all.push_back(&finer);
  for (Case* input : all) {
    input->end_time = first_period;
    end = std::min(end, first_period * budget.seconds / seconds_of(*input));
  }
  Case pilot = cells(drawn.input, pilot_cells);
  pilot.end_time = end;
  const Result result = simulate(pilot);
  const std::vector<SubImpact>& list = result.sub_impacts;
  if (!result.outcome.completed() || list.size() < kind.fewest) return false;
  if (list.size() > kind.most) end = list[kind.most].start;
  for (Case* input : all) input->end_time = end;
  return true;
}

Random stream_of(std::uint64_t seed, int number, int attempt) {
  std::uint64_t state = Random(seed).next();
  for (const int part : {number, attempt}) {
    state = Random(state ^ (static_cast<std::uint64_t>(part) * 0xd1342543de82ef95ULL)).next();
  }
  return Random(state);
}

}  // namespace

DrawnScene draw(std::uint64_t seed, int number, const Budget& budget, const Kind& kind) {
  for (int attempt = 0;; ++attempt) {
    Random random = stream_of(seed, number, attempt);
    DrawnScene drawn;
    Case& input = drawn.input;
    input.output.interval = 0.0;
    input.end_time = 1.0;
    draw_beam(random, input, kind);
    draw_strike(random, input, kind);
    draw_mesh(random, input, kind);
    if (kind.hard && random.chance(0.2)) draw_damping(random, input);
    // The period depends on the beam alone.
    Case any = input;
    any.scene.contact = {ContactKind::linear, 1.0, {}, {}, {}};
    any.model.mesh = MeshKind::cells;
    any.model.segments = 51;
    any.solver = {};
    try {
      const double first_period = resolve(any).settings().first_period;
      draw_contact(random, input, first_period);
      if (input.scene.beam.damping.mass > 0.0) input.scene.beam.damping.mass /= first_period;
      choose_finer(drawn, kind);
      if (draw_end(random, drawn, first_period, budget, kind)) {
        resolve(input);
        return drawn;
      }
    } catch (const InvalidCase&) {  // a strike too close to an end for the mesh
    }
  }
}

}  // namespace subimpact::strikes
