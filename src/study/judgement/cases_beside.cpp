#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <utility>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "study/judgement/mesh_resolution.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

// Sizes of the meshes beside, over that of the case. Near ones have the same sub-impacts; the far
// one shows errors that near meshes share, but it may lack some of them.
constexpr double near_size = 0.85;
constexpr double next_size = 0.7;
constexpr double far_size = 0.5;
// Used where coarser ones are refused, for strikes too close to an end.
constexpr double finer_sizes[] = {1.2, 1.45};
constexpr double most_gain = 2.0;  // of differences
constexpr double looser = 10.0;    // rtol, for a mesh of 0.7 and in time alone
constexpr double loosest = 1e-1;
constexpr double gain_of_tolerance = 1.0 / 3.0;  // a ninth, and room for errors that fall unevenly
// Of interpolated events: a square or a cube of the step, which falls as slowly as rtol^(1/5).
constexpr double gain_of_interpolation = 1.0;
constexpr double shorter = 0.7;  // step

// Output of a run beside: no rows, and extremes at the instants of the run itself.
OutputOptions output_beside(const Case& input) {
  OutputOptions output = input.output;
  const bool has_shapes = output.shape_interval(input.end_time) > 0.0;
  const double instants = output.extremes_interval(input.end_time);
  output.keep_no_rows();
  output.shapes = has_shapes ? instants : 0.0;
  return output;
}

bool has_fixed_step(const Case& input) {
  return descriptor_of(input.solver.method).has_fixed_steps() || input.solver.step;
}

std::optional<CaseBeside> on_mesh_of(double size, const Case& input) {
  try {
    const std::optional<Case> other = on_other_mesh(input, size);
    if (!other || (mesh_count(*other) < mesh_count(input)) != (size < 1.0)) return std::nullopt;
    CaseBeside beside{*other, ErrorSource::mesh_and_time, mesh_words(*other)};
    if (other->solver.step < input.solver.step) {
      beside.description += fmt::format(" and a step of {:.6g} us", 1e6 * *other->solver.step);
    }
    const double ratio = static_cast<double>(mesh_count(input)) / mesh_count(beside.input);
    // The difference of runs on nearly equal meshes would be taken many times. At the order 1 a
    // part of the difference is chance.
    const double order = std::max(mesh_order(input).value_or(2), 2);
    beside.gain = std::min(most_gain, 1.0 / std::abs(std::pow(ratio, order) - 1.0));
    beside.of_existence = size > far_size;
    beside.input.output = output_beside(input);
    beside.input.accuracy.energy = 1.0;  // what it loses shows in the difference
    // For a run in natural modes only the case can be refused, and resolving it would take most of
    // the time of a short run.
    if (beside.input.solver.method == Method::exponential) {
      check(beside.input);
    } else {
      resolve(beside.input);
    }
    return beside;
  } catch (const InvalidCase&) {  // of the other mesh
    return std::nullopt;
  }
}

// The case on another mesh, with a matching accuracy in time.
std::optional<CaseBeside> in_mesh_and_time(double size, const Case& input) {
  std::optional<CaseBeside> beside = on_mesh_of(size, input);
  if (!beside) return std::nullopt;
  SolverOptions& solver = beside->input.solver;
  if (input.solver.step) {
    solver.step = *input.solver.step / size;
  } else if (!has_fixed_step(input)) {
    const double exponent = std::log(size) / std::log(next_size);
    solver.rtol = std::min(std::pow(looser, exponent) * solver.rtol, loosest);
  }
  return beside;
}

// Natural modes, which are of high order, are not resolved for this.
bool is_ample(const Case& input) {
  return input.solver.method != Method::exponential &&
         resolves_amply(input, resolve(input).settings().contact_time);
}

// Where central differences on twice as many cells take less time than other methods on these.
std::optional<CaseBeside> on_finer_cells(const Case& input) {
  const bool is_cheaper =
      input.model.mesh == MeshKind::cells && input.solver.method != Method::central_difference;
  if (!is_cheaper) return std::nullopt;
  Case by_differences = input;
  by_differences.solver = {};
  by_differences.solver.method = Method::central_difference;
  return central_differences_suit(by_differences) ? on_mesh_of(2.0, by_differences) : std::nullopt;
}

}  // namespace

std::vector<CaseBeside> cases_beside_in_time(const Case& input) {
  CaseBeside beside{input, ErrorSource::time, {}};
  beside.input.output = output_beside(input);
  beside.input.accuracy.energy = 1.0;
  SolverOptions& solver = beside.input.solver;
  if (has_fixed_step(input)) {
    solver.step = shorter * *resolve(input).settings().step;
    beside.description = fmt::format("a step of {:.4g} us", 1e6 * *solver.step);
    beside.gain = 1.0 / (1.0 - shorter * shorter);
  } else {
    solver.rtol = std::min(looser * solver.rtol, loosest);
    beside.description = fmt::format("rtol = {:.3g}", solver.rtol);
    const bool interpolates = events_of(input) == EventHandling::interpolated;
    beside.gain = interpolates ? gain_of_interpolation : gain_of_tolerance;
  }
  return {beside};
}

std::vector<CaseBeside> cases_beside(const Case& input) {
  std::vector<CaseBeside> all;
  const auto include = [&](double size) {
    if (auto beside = in_mesh_and_time(size, input)) all.push_back(std::move(*beside));
  };
  std::optional<CaseBeside> far = in_mesh_and_time(far_size, input);
  include(near_size);
  if (!far || !is_ample(input)) include(next_size);
  if (far) all.push_back(std::move(*far));
  if (all.size() < 2) std::ranges::for_each(finer_sizes, include);
  if (!all.empty()) return all;
  all = cases_beside_in_time(input);
  // If no other mesh allows the strike, effects that the mesh does not show still count as
  // uncertain.
  if (mesh_order(input)) all.front().source = ErrorSource::mesh_and_time;
  return all;
}

std::vector<CaseBeside> cases_beside_on_given_mesh(const Case& input) {
  std::vector<CaseBeside> all = cases_beside_in_time(input);
  std::optional<CaseBeside> mesh = on_finer_cells(input);
  if (!mesh) mesh = in_mesh_and_time(next_size, input);
  if (mesh) {
    mesh->source = ErrorSource::mesh;
    mesh->of_rows = false;
    all.push_back(std::move(*mesh));
  }
  return all;
}

std::vector<RunBeside> simulate_beside(const Case& input, const std::vector<CaseBeside>& cases,
                                       Jobs jobs, const Progress& progress, RowSink* rows,
                                       Result& run) {
  std::atomic<bool> stop = false, lacks_memory = false;
  std::vector<std::optional<Result>> others(cases.size());
  in_parallel(cases.size() + 1, std::max(jobs, 1u), [&](std::size_t k) {
    if (k == 0) {
      run = simulate(input, progress, nullptr, rows);
      if (run.outcome.kind == OutcomeKind::stopped) stop = true;
      return;
    }
    NoRows none;
    try {
      others[k - 1] = simulate(
          cases[k - 1].input, [&](double) { return !stop; }, nullptr, &none);
    } catch (const std::bad_alloc&) {
      lacks_memory = true;
    }
  });
  if (stop) return {};
  if (lacks_memory) {
    run.warnings.push_back(
        "the memory does not suffice for the run to compare with: errors are not known");
    return {};
  }
  std::vector<RunBeside> beside;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    beside.push_back({cases[k], std::move(*others[k])});
  }
  return beside;
}

Result simulate_judged(const Case& input, const std::vector<CaseBeside>& cases, Jobs jobs,
                       const Progress& progress, RowSink* rows) {
  Result run;
  const std::vector<RunBeside> beside = simulate_beside(input, cases, jobs, progress, rows, run);
  judge(input, run, beside);
  return run;
}

}  // namespace subimpact
