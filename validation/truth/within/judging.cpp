#include "within/judging.h"

#include <algorithm>
#include <cmath>

#include "numerics/estimates.h"
#include "study/refinement/refinement.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::wishes {
namespace {

// v(0) from v(h) = v(0) + c h^order = coarse and v(h/ratio) = fine, by Richardson.
double richardson_limit(double coarse, double fine, double ratio, double order) {
  return fine + (fine - coarse) / (std::pow(ratio, order) - 1.0);
}

// Errors of the reference itself, over the tolerance, up to which it can judge.
constexpr double reference_share = 0.3;
constexpr int coarsest = 24;

double larger_difference(const SubImpact& a, const SubImpact& b) {
  const double start = std::abs(a.start - b.start);
  return a.end && b.end ? std::max(start, std::abs(*a.end - *b.end)) : start;
}

}  // namespace

Case open_scene(std::uint64_t seed, int number, const strikes::Budget& budget, double work_limit) {
  Case input = strikes::draw(seed, number, budget).input;
  const ModelOptions drawn = input.model;
  input.model = {};
  input.model.section = drawn.section;
  input.model.layers = drawn.layers;
  input.solver = {};
  input.accuracy.work_limit = work_limit;
  return input;
}

Reference reference_of(const Case& finest, double factor) {
  Reference reference;
  try {
    const Case fine = *on_other_mesh(finest, factor);
    const std::vector<CaseBeside> cases = cases_beside(fine);
    Result best;
    const std::vector<RunBeside> beside = simulate_beside(fine, cases, 1, {}, nullptr, best);
    judge(fine, best, beside);
    const Case& coarser = cases.back().input;
    const double ratio = static_cast<double>(mesh_count(fine)) / mesh_count(coarser);
    if (ratio <= 1.0) return reference;
    const Result& below = beside.back().result;
    reference.sub_impacts = best.sub_impacts;
    const std::size_t n =
        std::min(best.error_estimate->first_unresolved.value_or(best.sub_impacts.size()),
                 n_leading_matches(match_sub_impacts(best.sub_impacts, below.sub_impacts)));
    const double order = best.n_yielded_sections > 0 ? 2.0 : *mesh_order(fine);
    for (std::size_t i = 0; i < n; ++i) {
      SubImpact& s = reference.sub_impacts[i];
      const SubImpact& coarse = below.sub_impacts[i];
      reference.uncertainty.push_back(larger_difference(s, coarse) /
                                      (std::pow(ratio, order) - 1.0));
      if (i > 0) s.start = richardson_limit(coarse.start, s.start, ratio, order);
      if (s.end && coarse.end) {
        s.end = richardson_limit(*coarse.end, *s.end, ratio, order);
      }
    }
  } catch (const InvalidCase&) {  // finer than is allowed
  }
  return reference;
}

std::size_t n_judged(const Reference& reference, double wish) {
  const auto& all = reference.uncertainty;
  const auto is_too_large = [&](double uncertainty) {
    return uncertainty > reference_share * wish;
  };
  return static_cast<std::size_t>(std::ranges::find_if(all, is_too_large) - all.begin());
}

double error_of(const std::vector<SubImpact>& run, const Reference& reference, std::size_t n) {
  if (n_leading_matches(match_sub_impacts(reference.sub_impacts, run)) < n) return INFINITY;
  double error = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    error = std::max(error, larger_difference(run[i], reference.sub_impacts[i]));
  }
  return error;
}

std::vector<SequenceRun> sequence_of(const Case& finest, double end_time) {
  const Refinement refinement(finest, {});
  std::vector<SequenceRun> runs;
  for (double factor = 1.5; mesh_count(finest) * factor > coarsest; factor /= std::sqrt(2.0)) {
    try {
      std::optional<Case> sized = refinement.resized(finest, factor);
      if (!sized) continue;  // finer than is allowed
      sized->end_time = end_time;
      const Result result = simulate(*sized);
      runs.push_back({counted_work(*sized, result), result.sub_impacts});
    } catch (const InvalidCase&) {  // a strike too close to an end for the mesh
    }
  }
  return runs;  // fine to coarse
}

double cheapest_work(const std::vector<SequenceRun>& runs, const Reference& reference,
                     std::size_t n, double wish) {
  double work = 0.0;
  for (const SequenceRun& run : runs) {
    if (!(error_of(run.sub_impacts, reference, n) <= wish)) break;
    work = run.work;
  }
  return work;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace subimpact::wishes
