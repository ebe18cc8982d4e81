#include "subimpact/case/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulate/methods.h"
#include "simulate/run_parts.h"
#include "subimpact/simulate/options.h"

namespace subimpact {
namespace {

constexpr double timing_budget = 5e-3;  // s
constexpr int batch = 64;

// Fits to the paper's example, 501 cells, over rtol 1e-6 to 1e-10 and all explicit tables (see the
// header for what they are worth): the angle omega_max h of a step at rtol 1e-8 is proportional to
// what the step evaluates, and a Nystroem evaluation takes it twice as far.
constexpr double reference_tolerance = 1e-8;
// Largest decay of the highest mode, due to damping of the beam, beyond which explicit Runge-Kutta
// steps are unstable at any tolerance (dop853: 6.4 with 12 evaluations).
constexpr double stable_decay_per_evaluation = 0.5;
// The steps of a beam that yields are cut, corrected and restarted at section events.
constexpr double share_of_yielding = 2.1;
// Vector work, event search and recording, in right-hand sides.
constexpr double overhead = 2.3;

double measure_right_hand_side(StruckBeam& beam) {
  const State y = beam.initial_state();
  std::vector<double> result(beam.n_positions());
  using Clock = std::chrono::steady_clock;
  double best = 1.0;
  const auto start = Clock::now();
  // The fastest batch is the one that nothing else on the machine disturbed.
  do {
    const auto batch_start = Clock::now();
    for (int i = 0; i < batch; ++i) beam.acceleration_at(y, result);
    const std::chrono::duration<double> taken = Clock::now() - batch_start;
    best = std::min(best, taken.count() / batch);
  } while (std::chrono::duration<double>(Clock::now() - start).count() < timing_budget);
  return best;
}

// For explicit methods only: the cost of an implicit or multistep method depends on its iterations.
const MethodTable* table_of(Method method, const ResolvedSettings& used) {
  if (!(descriptor_of(method).radians_per_evaluation > 0.0)) return nullptr;
  for (const MethodTable& table : method_tables()) {
    if (table.method == method && used.table && table.name == *used.table) return &table;
  }
  return nullptr;
}

// Rate of decay (1/s) of a mode of frequency omega.
double fastest_decay(const BeamDamping& damping, double omega) {
  return damping.mass + damping.stiffness * omega * omega + 2.0 * damping.ratio * omega;
}

}  // namespace

std::optional<CostEstimate> estimate_cost(ResolvedRun& run) {
  const Options& input = run.parts().given;
  StruckBeam& beam = run.parts().beam;
  const ResolvedSettings& used = run.settings();
  const MethodTable* table = table_of(input.solver.method, used);
  const MethodDescriptor& method = descriptor_of(input.solver.method);
  const bool fitted = method.radians_per_evaluation > 0.0;
  if (!fitted && method.steps != MethodDescriptor::Steps::fixed) return std::nullopt;
  if (used.highest_frequency == 0.0) return std::nullopt;  // a rigid beam: no mesh, no fit
  CostEstimate cost;
  cost.seconds_per_right_hand_side = measure_right_hand_side(beam);
  const int evaluations = table != nullptr ? table->evaluations : 1;
  double step = used.step.value_or(0.0);
  if (!used.step) {
    const double radians =
        method.radians_per_evaluation * evaluations *
        std::pow(input.solver.rtol / reference_tolerance, 1.0 / (table->embedded_order + 1.0));
    step = std::min({radians / used.highest_frequency,
                     stable_decay_per_evaluation * evaluations /
                         fastest_decay(beam.damping(), used.highest_frequency),
                     input.solver.max_step.value_or(input.end_time)});
  }
  const bool retaken = beam.sections().can_yield() && used.events != EventHandling::interpolated;
  cost.steps = input.end_time / step;
  cost.right_hand_sides = (retaken ? share_of_yielding : 1.0) * evaluations * cost.steps;
  cost.seconds = overhead * cost.right_hand_sides * cost.seconds_per_right_hand_side;
  return cost;
}

}  // namespace subimpact
