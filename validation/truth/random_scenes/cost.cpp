#include "random_scenes/cost.h"

#include <algorithm>
#include <cmath>

#include "case/problem.h"
#include "subimpact/simulate/options.h"

namespace subimpact::scenes {
namespace {

double unknowns(const Case& input) {
  const bool half = input.model.symmetry == SymmetryUse::automatic &&
                    input.scene.striker.position == 0.5 &&
                    input.scene.beam.ends[0] == input.scene.beam.ends[1];
  double n = 1.0;
  if (input.model.mesh == MeshKind::cells) n = input.model.segments;
  if (input.model.mesh == MeshKind::hermite) n = 2.0 * input.model.elements;
  return half ? 0.5 * n : n;
}

const MethodTable* table_of(const SolverOptions& solver) {
  for (const MethodTable& table : method_tables()) {
    if (table.method == solver.method && (!solver.table || table.name == *solver.table)) {
      return &table;
    }
  }
  return nullptr;
}

// Angle omega h of a step and its right-hand sides.
struct StepCost {
  double angle;
  double evaluations;
};

StepCost step_cost(const SolverOptions& solver) {
  const double rtol = solver.rtol;
  if (const MethodTable* table = table_of(solver)) {
    const bool implicit = solver.method == Method::dirk;
    const double gain = solver.method == Method::nystrom ? 2.0 : 1.0;
    return {0.11 * table->evaluations * gain *
                std::pow(rtol / 1e-8, 1.0 / (table->embedded_order + 1.0)),
            table->evaluations * (implicit ? 12.0 : 1.0)};
  }
  switch (solver.method) {
    case Method::central_difference:
      return {1.8, 1.0};
    case Method::adams:
      return {0.5 * std::pow(rtol / 1e-4, 1.0 / (std::min(solver.max_order.value_or(12), 8) + 1.0)),
              3.0};
    case Method::bdf:
      return {0.3 * std::pow(rtol / 1e-4, 1.0 / (solver.max_order.value_or(5) + 1.0)), 8.0};
    default:  // exponential: on yielding beams nystrom
      return {0.22 * 9.0 * std::pow(rtol / 1e-8, 1.0 / 7.0), 9.0};
  }
}

}  // namespace

double first_period(const Beam& beam) {
  const auto count = [&](EndSupport kind) {
    return std::count(beam.ends.begin(), beam.ends.end(), kind);
  };
  double beta = 4.7300;  // free-free and clamped-clamped
  if (count(EndSupport::pinned) == 2) beta = M_PI;
  if (count(EndSupport::pinned) == 1) beta = 3.9266;
  if (count(EndSupport::clamped) == 1 && count(EndSupport::free) == 1) beta = 1.8751;
  const double speed = std::sqrt(beam.bending_stiffness() / beam.mass_per_length());
  return 2.0 * M_PI * beam.length * beam.length / (beta * beta * speed);
}

double contact_stiffness(const Case& input) {
  const Beam& beam = input.scene.beam;
  const Striker& striker = input.scene.striker;
  const double mass = striker.mass * beam.mass() / (striker.mass + beam.mass());
  const double radius = striker.nose_radius.value_or(0.0);
  const Contact& contact = input.scene.contact;
  if (contact.kind == ContactKind::linear) return *contact.stiffness;
  double k = 0.0;
  if (contact.kind == ContactKind::foundation) {
    k = 4.0 * std::sqrt(2.0 * radius) * beam.youngs_modulus * beam.width / (3.0 * beam.thickness);
  } else if (contact.stiffness) {
    k = *contact.stiffness;
  } else {
    const auto softness = [](double modulus, double poisson) {
      return (1.0 - poisson * poisson) / modulus;
    };
    k = 4.0 / 3.0 * std::sqrt(radius) /
        (softness(*contact.striker_modulus, *contact.striker_poisson) +
         softness(beam.youngs_modulus, *contact.beam_poisson));
  }
  // All of the energy in the contact: 0.4 k d^2.5 = m v^2/2.
  double depth = std::pow(1.25 * mass * striker.velocity * striker.velocity / k, 0.4);
  const double yield = beam.yield_stress * beam.thickness / beam.youngs_modulus;
  if (contact.kind == ContactKind::foundation) depth = std::min(depth, 2.0 * yield);
  return 1.5 * k * std::sqrt(depth);
}

double contact_time(const Case& input) {
  const double beam = input.scene.beam.mass();
  const double mass = input.scene.striker.mass * beam / (input.scene.striker.mass + beam);
  return M_PI * std::sqrt(mass / contact_stiffness(input));
}

double highest_frequency(const Case& input) {
  const Beam& beam = input.scene.beam;
  const double c = std::sqrt(beam.youngs_modulus / beam.density);
  const double r = beam.thickness / std::sqrt(12.0);
  const bool rotary = beam.theory == BeamTheory::rayleigh;
  if (input.model.mesh == MeshKind::rigid) return 0.0;
  if (input.model.mesh == MeshKind::cells) {
    const double dx = beam.length / input.model.segments;
    const double x = 2.0 * r / dx;
    return 4.0 * c * r / (dx * dx) / std::sqrt(1.0 + (rotary ? x * x : 0.0));
  }
  const double a = input.scene.beam.length / input.model.elements;
  const double x = 11.8 * r / a;
  return 91.7 * c * r / (a * a) / std::sqrt(1.0 + (rotary ? x * x : 0.0));
}

double contact_frequency(const Case& input) {
  const double beam = input.scene.beam.mass() / unknowns(input);
  const double striker = input.scene.striker.mass;
  return std::sqrt(contact_stiffness(input) * (1.0 / striker + 1.0 / beam));
}

double seconds_a_second(const Case& input) {
  const bool yields = may_yield(input);
  const StepCost step = step_cost(input.solver);
  const double n = unknowns(input);
  double frequency = highest_frequency(input) + contact_frequency(input);
  if (input.solver.method == Method::exponential && !yields) {
    frequency = contact_frequency(input) + 0.03 * highest_frequency(input);
  }
  double steps = frequency / step.angle;
  if (input.solver.step) steps = 1.0 / *input.solver.step;
  const double right_hand_side = 2e-7 + 8e-9 * n * (yields ? 2.5 : 1.0);
  return 2.3 * steps * step.evaluations * right_hand_side;
}

}  // namespace subimpact::scenes
