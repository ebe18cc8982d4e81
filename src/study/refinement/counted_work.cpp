#include <algorithm>

#include "case/problem.h"
#include "subimpact/study/refinement/within.h"

namespace subimpact {
namespace {

// A step that moves every mode in closed form takes as long as these evaluations.
constexpr double evaluations_per_step_in_modes = 3.0;
// K_s w of springs and beddings, a product with a matrix, takes as long as these.
constexpr double evaluations_of_springs = 1.5;
// A section that flows takes as long as these evaluations of the others.
constexpr double evaluations_per_flow = 10.0;

}  // namespace

double evaluation_cost(const Case& input) {
  const bool central = input.solver.method == Method::central_difference;
  const bool yields = may_yield(input);
  if (input.solver.method == Method::exponential && !yields) return 1.0;
  const bool in_elements = input.model.mesh != MeshKind::cells;
  double cost = central ? 1.0 : 2.0;
  if (input.scene.beam.is_sprung()) cost += evaluations_of_springs;
  if (!input.scene.beam.damping.is_none()) cost *= 2.0;
  const auto varies = [](const PointForce& force) { return force.table.size() > 1; };
  if (std::ranges::any_of(input.scene.beam.forces, varies)) cost *= 4.0;
  if (yields && input.scene.beam.is_round()) cost *= 2.0;
  if (yields && in_elements) cost *= 2.0;
  return cost;
}

double counted_work(const Case& input, const Result& result) {
  const Work& work = result.work;
  auto evaluations = evaluation_cost(input) * static_cast<double>(work.right_hand_sides);
  if (input.solver.method == Method::exponential) {
    evaluations +=
        evaluations_per_step_in_modes * static_cast<double>(work.steps + work.rejected_steps);
  }
  const double per_step = std::max(1.0, static_cast<double>(work.right_hand_sides) /
                                            static_cast<double>(std::max(work.steps, 1L)));
  return evaluations * static_cast<double>(std::max<std::size_t>(result.used.n_unknowns, 1)) +
         evaluations_per_flow * per_step * static_cast<double>(work.section_flows) +
         result.used.decomposition;
}

}  // namespace subimpact
