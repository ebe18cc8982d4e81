#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <new>
#include <utility>

#include "case/problem.h"
#include "simulate/methods.h"
#include "study/parallel.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

constexpr double sizes[] = {0.85, 0.7};  // of the meshes beside, over that of the case
constexpr double size_for_limit = 0.5;
constexpr double looser = 10.0;  // rtol, for a mesh of 0.7 and in time alone
constexpr double loosest = 1e-1;
constexpr double gain_of_tolerance = 1.0 / 3.0;  // a ninth, and room for errors that fall unevenly
constexpr double shorter = 0.7;                  // step
// Instants at which the extremes along the beam are taken, at most.
constexpr double most_rows = 4000.0;

// The rows that the extremes need, and no others.
OutputOptions output_beside(const Case& input) {
  OutputOptions output = input.output;
  const double shapes = output.shape_interval(input.end_time);
  output.keep_no_rows();
  if (shapes > 0.0) {
    output.shapes = shapes;
    output.interval = std::max(input.output.interval, input.end_time / most_rows);
  }
  return output;
}

bool has_fixed_step(const Case& input) {
  return descriptor_of(input.solver.method).steps == MethodDescriptor::Steps::fixed ||
         input.solver.step;
}

// At orders 1 and 2 the difference of runs of nearly equal meshes would be taken many times.
double gain_of_mesh(double ratio, double order) {
  return std::min(1.0, 1.0 / (std::pow(ratio, order) - 1.0));
}

// Hinges and kinks make times converge unevenly.
double order_expected(const Case& input) {
  const bool uneven = may_yield(input) && input.model.mesh == MeshKind::hermite;
  return uneven ? 1.0 : static_cast<double>(mesh_order(input).value_or(1));
}

std::optional<CaseBeside> on_coarser_mesh(const Case& input, double size) {
  try {
    const std::optional<RefinedRun> coarser = on_other_mesh(input, size);
    if (!coarser || mesh_count(coarser->input) >= mesh_count(input)) return std::nullopt;
    CaseBeside beside{coarser->input, "mesh and time", coarser->description};
    const double ratio = static_cast<double>(mesh_count(input)) / mesh_count(beside.input);
    beside.gain = gain_of_mesh(ratio, order_expected(input));
    beside.input.output = output_beside(input);
    resolve(beside.input);
    return beside;
  } catch (const InvalidCase&) {  // of the coarser mesh
    return std::nullopt;
  }
}

// Takes no rows into memory.
class NoRows final : public RowSink {
 public:
  void add(const HistoryRow&) override {}
  void add(const SectionRow&) override {}
};

}  // namespace

std::vector<CaseBeside> cases_beside_in_time(const Case& input) {
  CaseBeside beside{input, "time", {}};
  beside.input.output = output_beside(input);
  SolverOptions& solver = beside.input.solver;
  if (has_fixed_step(input)) {
    solver.step = shorter * *resolve(input).settings().step;
    beside.description = fmt::format("a step of {:.4g} us", 1e6 * *solver.step);
    beside.gain = 1.0 / (1.0 - shorter * shorter);
  } else {
    solver.rtol = std::min(looser * solver.rtol, loosest);
    beside.description = fmt::format("rtol = {:.3g}", solver.rtol);
    beside.gain = gain_of_tolerance;
  }
  return {beside};
}

std::vector<CaseBeside> cases_beside(const Case& input) {
  std::vector<CaseBeside> all;
  for (const double size : sizes) {
    std::optional<CaseBeside> beside = on_coarser_mesh(input, size);
    if (!beside) continue;
    SolverOptions& solver = beside->input.solver;
    if (input.solver.step) {
      solver.step = *input.solver.step / size;
    } else if (!has_fixed_step(input)) {
      solver.rtol =
          std::min(std::pow(looser, std::log(size) / std::log(sizes[1])) * solver.rtol, loosest);
    }
    all.push_back(std::move(*beside));
  }
  if (!all.empty()) return all;
  all = cases_beside_in_time(input);
  // Where no coarser mesh takes the strike, what the mesh does not show is doubted all the same.
  if (mesh_order(input)) all.front().part = "mesh and time";
  return all;
}

std::vector<CaseBeside> cases_beside_by_part(const Case& input) {
  std::vector<CaseBeside> all = cases_beside_in_time(input);
  for (const double size : {sizes[0], sizes[1], size_for_limit}) {
    std::optional<CaseBeside> beside = on_coarser_mesh(input, size);
    if (!beside) continue;
    beside->part = "mesh";
    all.push_back(std::move(*beside));
  }
  const bool has_layers = descriptor_of(input.model.section).has_layers && !input.parts.section;
  if (has_layers && may_yield(input)) {
    CaseBeside exact{input, "layers", "the exact section"};
    exact.input.output = output_beside(input);
    exact.input.model.section = SectionKind::exact;
    all.push_back(std::move(exact));
  }
  return all;
}

std::vector<RunBeside> simulate_beside(const Case& input, const std::vector<CaseBeside>& cases,
                                       Jobs jobs, const Progress& progress, RowSink* rows,
                                       Result& run) {
  std::atomic<bool> stop = false, lacks_memory = false;
  std::vector<std::optional<Result>> others(cases.size());
  in_parallel(
      cases.size() + 1,
      [&](std::size_t k) {
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
      },
      std::max(jobs, 1u));
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

double memory_beside(const Case& input) {
  double sum = 0.0;
  for (const CaseBeside& beside : cases_beside(input)) {
    sum += resolve(beside.input).settings().memory;
  }
  return sum;
}

}  // namespace subimpact
