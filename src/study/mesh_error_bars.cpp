#include "subimpact/study/mesh_error_bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <vector>

#include "case/meshes.h"
#include "case/problem.h"
#include "numerics/richardson.h"
#include "simulate/methods.h"
#include "study/error_part.h"
#include "study/mesh_resolution.h"
#include "study/method_choice.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

constexpr double safety = 3.0;              // of differences in time
constexpr double mesh_safety = 1.5;         // times the difference from the finer mesh
constexpr double layers_safety = 1.5;       // of one that is the error but for the mesh
constexpr double order_uncertainty = 0.35;  // of the ratio of differences for an order

// The whole number nearest to x that is odd (or even), or just the nearest.
int nearest(double x, bool any, bool odd) {
  const int n = static_cast<int>(std::lround(x));
  if (any || (n % 2 != 0) == odd) return n;
  return x >= n ? n + 1 : n - 1;
}

// Starts and ends extrapolated from three meshes, h the size of their parts.
struct MeshSequence {
  double order;
  double coarse_h, h, fine_h;

  std::optional<double> limit(double coarse, double here, double fine) const {
    const double expected = ratio_of_differences(coarse_h, h, fine_h, order);
    const double found = (coarse - here) / (here - fine);
    if (!(std::abs(found / expected - 1.0) <= order_uncertainty)) return std::nullopt;
    return richardson_limit(here, fine, h / fine_h, order);
  }
};

void extrapolate(Result& result, const Result& coarse, const Result& fine,
                 const MeshSequence& meshes) {
  auto& here = result.sub_impacts;
  const std::size_t n = std::min(n_leading_matches(match_sub_impacts(here, coarse.sub_impacts)),
                                 n_leading_matches(match_sub_impacts(here, fine.sub_impacts)));
  for (std::size_t i = 0; i < n; ++i) {
    const SubImpact& below = coarse.sub_impacts[i];
    const SubImpact& above = fine.sub_impacts[i];
    double error = here[i].error_time.value_or(0.0);
    if (i > 0) here[i].start_mesh_limit = meshes.limit(below.start, here[i].start, above.start);
    if (here[i].end && below.end && above.end) {
      here[i].end_mesh_limit = meshes.limit(*below.end, *here[i].end, *above.end);
    }
    if (here[i].start_mesh_limit) {
      error = std::max(error, std::abs(*here[i].start_mesh_limit - above.start));
    }
    if (here[i].end_mesh_limit) {
      error = std::max(error, std::abs(*here[i].end_mesh_limit - *above.end));
    }
    if (here[i].start_mesh_limit || here[i].end_mesh_limit) here[i].mesh_limit_error = error;
  }
}

// A mesh of the caller's own has no finer one.
std::optional<MeshDescriptor::Refinement> refinement_of(const Case& input) {
  if (input.parts.mesh) return std::nullopt;
  return descriptor_of(input.model.mesh).refinement;
}

}  // namespace

std::optional<int> mesh_order(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? std::optional(refinement->order(input)) : std::nullopt;
}

int mesh_count(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? input.model.*(refinement->count) : 1;
}

std::optional<RefinedRun> on_other_mesh(const Case& input, double factor) {
  const auto refinement = refinement_of(input);
  if (!refinement) return {};
  RefinedRun refined_run{input, {}};
  Case& other = refined_run.input;
  other.output.keep_no_rows();
  int& count = other.model.*(refinement->count);
  // An even number of elements has a node at mid-span, where most strikes are: equal elements,
  // whose modes have a closed form.
  const bool any = !uses_symmetry(input) && refinement->odd_in_half;
  count = nearest(factor * mesh_count(input), any, refinement->odd_in_half);
  if (count < refinement->fewest) return {};
  refined_run.description = fmt::format("the same with {} {}", count, refinement->parts);
  const bool fixed = descriptor_of(input.solver.method).steps == MethodDescriptor::Steps::fixed;
  if (fixed && input.solver.step) {
    other.solver.step = std::min(*input.solver.step, largest_stable_step(other));
    if (*other.solver.step < *input.solver.step) {
      refined_run.description += fmt::format(" and a step of {:.6g} us", 1e6 * *other.solver.step);
    }
  }
  return refined_run;
}

Result simulate_with_all_error_bars(const Case& input, const Progress& progress, RowSink* rows) {
  const RefinedRun in_time = refined_run_of(input);
  const std::optional<RefinedRun> fine = on_other_mesh(input, 2.0);
  const std::optional<RefinedRun> coarse = on_other_mesh(input, 0.5);
  std::atomic<bool> stop = false;
  const Progress go_on = [&stop](double) { return !stop; };
  const auto beside = [&](const Case& other) {
    return std::async(std::launch::async, [other, go_on] { return simulate(other, go_on); });
  };
  // Each of the two runs here shows half of the progress.
  const auto half = [&](double offset) -> Progress {
    return [&progress, &stop, offset, end = input.end_time](double t) {
      if (progress && !progress(0.5 * (offset * end + t))) stop = true;
      return !stop;
    };
  };
  std::future<Result> on_fine;
  if (fine) on_fine = beside(fine->input);
  Result result = simulate(input, half(0.0), nullptr, rows);
  std::vector<ErrorPart> parts;
  const auto compare = [&](const Result& other, const char* name, const std::string& description,
                           double factor) {
    parts.push_back(compare_events(result, other, name, description, factor));
  };
  if (result.outcome.kind == OutcomeKind::stopped) stop = true;
  if (!stop) compare(simulate(in_time.input, half(1.0)), "time", in_time.description, safety);
  if (!stop && descriptor_of(input.model.section).has_layers && !input.parts.section &&
      may_yield(input)) {
    Case exact = refined_run_of(input).input;
    exact.solver = input.solver;
    exact.model.section = SectionKind::exact;
    compare(simulate(exact, go_on), "layers", "the same with the exact section", layers_safety);
  }
  if (fine && !stop) {
    const Result below = coarse ? simulate(coarse->input, go_on) : Result{};
    const Result above = on_fine.get();
    const int order = *mesh_order(input);
    const auto h = [](const Case& of) { return refinement_of(of)->size(of); };
    const double told = 1.0 - std::pow(h(fine->input) / h(input), order);  // of the mesh's error
    compare(above, "mesh", fine->description, mesh_safety / told);
    include_free_ends(parts.back(), input, result);
    if (coarse) {
      extrapolate(result, below, above,
                  {static_cast<double>(order), h(coarse->input), h(input), h(fine->input)});
    }
  }
  if (!stop) {
    set_error_bars(result, parts);
    doubt_unresolved_contacts(result, input);
  }
  return result;
}

}  // namespace subimpact
