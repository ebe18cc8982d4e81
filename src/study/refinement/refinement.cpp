#include "study/refinement/refinement.h"

#include <algorithm>
#include <cmath>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "study/judgement/mesh_resolution.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

constexpr double first_tolerance = 1e-6;
constexpr double first_tolerance_in_modes = 1e-8;
constexpr double tightest_tolerance = 1e-12;
constexpr double digits_per_doubling = 1.0;
constexpr double least_step_ratio = 1.4;  // of a step that the mesh limits, per doubling
// A step that moves every mode in closed form takes as long as these evaluations.
constexpr double evaluations_per_step_in_modes = 3.0;
// K_s w of springs and beddings, a product with a matrix, takes as long as these.
constexpr double evaluations_of_springs = 1.5;
// A section that flows takes as long as these evaluations of the others.
constexpr double evaluations_per_flow = 10.0;

Case with_count(const Case& input, double count) {
  const std::optional<Case> sized = on_other_mesh(input, count / mesh_count(input));
  Case other = input;
  if (sized) other.model = sized->model;
  return other;
}

bool is_fixed_step(const Case& input) {
  return descriptor_of(input.solver.method).has_fixed_steps();
}

double step_by_default(Case input) {
  input.solver.step.reset();
  return *resolve(input).settings().step;
}

}  // namespace

Refinement::Refinement(const Case& input, const OpenChoices& open) : first_(input), open_(open) {
  order_ = mesh_order(input).value_or(1);
  const bool chooses = open_.size && mesh_order(input);
  if (chooses) first_ = with_count(input, parts_that_take_strike(input));
  const ResolvedSettings used = resolve(first_).settings();
  contact_time_ = used.contact_time;
  if (chooses) choose_count(used);
  if (!open_.tolerance) return;
  if (!is_fixed_step(input)) {
    const bool modes = input.solver.method == Method::exponential;
    first_.solver.rtol = modes ? first_tolerance_in_modes : first_tolerance;
    return;
  }
  const double step = step_by_default(first_);
  if (step < least_step_ratio * step_by_default(with_count(first_, 2.0 * mesh_count(first_)))) {
    first_step_ = step;
  }
}

// A striker between two cells meets up to twice the mass of one that meets a cell's middle, which
// may be one or the other on the mesh of `used`.
void Refinement::choose_count(const ResolvedSettings& used) {
  const int waves = parts_that_resolve(first_, used.contact_time, most_cells_at_first);
  const int parts = parts_at_first(first_, used);
  const int twice = std::min(2 * parts, most_parts_at_first(first_));
  first_ = with_count(first_, parts);
  if (parts == waves || !mesh_doubt(first_, resolve(first_).settings())) return;
  first_ = with_count(first_, twice);
}

std::optional<Case> Refinement::finer(const Case& from, double ratio) const {
  std::optional<Case> next = resized(from, ratio);
  if (next && mesh_count(*next) <= mesh_count(from)) next.reset();
  return next;
}

std::optional<Case> Refinement::resized(const Case& from, double ratio) const {
  Case next = with_count(from, ratio * mesh_count(from));
  const int count = mesh_count(next);
  const CaseKey& key = *find_case_key(size_key());
  if (key.limits.maximum && count > *key.limits.maximum) return std::nullopt;
  const double size = static_cast<double>(count) / mesh_count(first_);
  if (open_.tolerance && !is_fixed_step(next)) {
    next.solver.rtol =
        std::max(tightest_tolerance,
                 first_.solver.rtol * std::pow(10.0, -digits_per_doubling * std::log2(size)));
  } else if (first_step_) {
    const double step = *first_step_ / size;
    next.solver.step.reset();
    if (step < step_by_default(next)) next.solver.step = step;
  }
  return next;
}

const char* Refinement::size_key() const {
  const auto& refinement = descriptor_of(first_.model.mesh).refinement;
  return refinement && !first_.parts.mesh ? refinement->key : "model.mesh";
}

const char* Refinement::fixed_key() const {
  return !open_.size || !mesh_order(first_) ? size_key() : nullptr;
}

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
