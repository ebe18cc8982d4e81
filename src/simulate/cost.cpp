#include "subimpact/simulate/cost.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "simulate/model_factory.h"
#include "subimpact/simulate/case_keys.h"
#include "subimpact/simulate/method_tables.h"

namespace subimpact {
namespace {

constexpr double timing_budget = 5e-3;  // s
constexpr int batch = 64;

// Between events the whole step is not always used, and part of the steps is taken twice.
constexpr double share_of_events = 1.3;

double measure_right_hand_side(StruckBeam& beam) {
  const State y = beam.initial_state();
  std::vector<double> result(beam.n_positions());
  const std::span<const double> positions(y.data(), beam.n_positions());
  using Clock = std::chrono::steady_clock;
  double best = 1.0;
  const auto start = Clock::now();
  // The fastest batch is the one that nothing else on the machine disturbed.
  do {
    const auto batch_start = Clock::now();
    for (int i = 0; i < batch; ++i) beam.acceleration(positions, result);
    const std::chrono::duration<double> taken = Clock::now() - batch_start;
    best = std::min(best, taken.count() / batch);
  } while (std::chrono::duration<double>(Clock::now() - start).count() < timing_budget);
  return best;
}

const MethodTable* table_of(const Used& used) {
  for (const MethodTable& table : method_tables()) {
    if (used.table && table.name == *used.table) return &table;
  }
  return nullptr;
}

}  // namespace

std::optional<CostEstimate> estimate_cost(const Case& input) {
  check(input);
  StruckBeam beam = make_struck_beam(input);
  const Used used = describe(input, beam);
  const MethodTable* table = table_of(used);
  if (table == nullptr && input.solver.method != Method::central_difference) return std::nullopt;
  CostEstimate cost;
  cost.seconds_per_right_hand_side = measure_right_hand_side(beam);
  double step = used.step.value_or(0.0);
  if (!used.step) {
    const double order = table->embedded_order + 1.0;
    const double radians = std::pow(input.solver.rtol / 1e-8, 1.0 / order);
    step =
        std::min(radians / used.highest_frequency, input.solver.max_step.value_or(input.end_time));
  }
  cost.steps = input.end_time / step;
  cost.right_hand_sides = share_of_events * (table ? table->evaluations : 1) * cost.steps;
  cost.seconds = cost.right_hand_sides * cost.seconds_per_right_hand_side;
  return cost;
}

}  // namespace subimpact
