#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/meshes.h"
#include "case/problem.h"
#include "case/sections.h"
#include "numerics/richardson.h"
#include "study/parallel.h"
#include "subimpact/study/mesh_error_bars.h"
#include "subimpact/study/plan.h"

namespace subimpact {
namespace {

constexpr double factors[] = {0.25, 0.5, 1.0, 2.0, 4.0};
constexpr double elastic_tolerance = 1e-11;
constexpr double yielding_tolerance = 1e-9;
constexpr double share_of_extrapolation = 0.5;

Case accurate(Case input) {
  input.solver = {};
  input.study = {};
  input.output.interval = 0.0;
  input.solver.method = may_yield(input) ? Method::nystrom : Method::exponential;
  input.solver.rtol = may_yield(input) ? yielding_tolerance : elastic_tolerance;
  return input;
}

struct Sequence {
  std::vector<MeshRun> runs;
  std::vector<Result> results;
  double order = 0.0;
};

Sequence sequence_of(const Case& input, MeshKind kind) {
  Case base = accurate(input);
  base.model.mesh = kind;
  base.parts.mesh = nullptr;
  if (!mesh_uses(base, "model.strike_refinement")) base.model.strike_refinement = 1.0;
  if (!mesh_uses(base, "model.spacing")) base.model.spacing = CellSpacing::cells;
  if (descriptor_of(base.model.section).has_layers) base.model.section = SectionKind::exact;
  Sequence sequence;
  sequence.order = mesh_order(base).value_or(0);
  for (const double factor : factors) {
    const auto other =
        factor == 1.0 ? std::optional(RefinedRun{base, {}}) : on_other_mesh(base, factor);
    if (!other) continue;
    MeshRun run;
    run.input = accurate(other->input);
    run.count = mesh_count(run.input);
    run.mesh = fmt::format("{} {}", run.count, descriptor_of(kind).refinement->parts);
    sequence.runs.push_back(run);
  }
  sequence.results.resize(sequence.runs.size());
  // The finest first: it takes longest.
  const std::size_t n = sequence.runs.size();
  in_parallel(n, [&](std::size_t i) {
    sequence.results[n - 1 - i] = simulate(sequence.runs[n - 1 - i].input);
  });
  for (std::size_t i = 0; i < n; ++i) {
    const auto& list = sequence.results[i].sub_impacts;
    if (!list.empty() && list.front().end) sequence.runs[i].first_end = *list.front().end;
  }
  return sequence;
}

struct Extrapolated {
  double value = 0.0;
  double uncertainty = std::numeric_limits<double>::infinity();
  double order = 0.0;
};

Extrapolated extrapolate(double t1, double t2, double t3, double ratio, double order) {
  Extrapolated result;
  const double last = t3 - t2;
  result.value = richardson_limit(t2, t3, ratio, order);
  if (last == 0.0) return {t3, 0.0, order};
  result.order = observed_order(t1, t2, t3, ratio);
  if (!((t2 - t1) / last > 0.0) || result.order < 0.5 * order) {
    result.uncertainty = std::abs(last);
    return result;
  }
  const double observed = richardson_limit(t2, t3, ratio, result.order);
  result.uncertainty =
      std::abs(observed - result.value) + share_of_extrapolation * std::abs(result.value - t3);
  return result;
}

MeshLimit limit_of(const Sequence& sequence, double end_time, double largest_error) {
  MeshLimit limit;
  limit.horizon = end_time;
  limit.horizon_reason = "the case's end";
  const std::size_t n = sequence.runs.size();
  if (n < 3) return limit;
  const auto& a = sequence.results[n - 3].sub_impacts;
  const auto& b = sequence.results[n - 2].sub_impacts;
  const auto& c = sequence.results[n - 1].sub_impacts;
  const double ratio = static_cast<double>(sequence.runs[n - 1].count) / sequence.runs[n - 2].count;
  const std::size_t common = std::min(n_leading_matches(match_sub_impacts(c, b)),
                                      n_leading_matches(match_sub_impacts(b, a)));
  limit.description = fmt::format("{}, {} and {}", sequence.runs[n - 3].mesh,
                                  sequence.runs[n - 2].mesh, sequence.runs[n - 1].mesh);
  std::size_t i = 0;
  for (; i < common && c[i].end && b[i].end && a[i].end; ++i) {
    const Extrapolated start =
        i == 0 ? Extrapolated{0.0, 0.0, 0.0}
               : extrapolate(a[i].start, b[i].start, c[i].start, ratio, sequence.order);
    const Extrapolated end = extrapolate(*a[i].end, *b[i].end, *c[i].end, ratio, sequence.order);
    if (i == 0) {
      limit.first_end.push_back({limit.description, end.value, end.uncertainty, end.order});
    }
    const double uncertainty = std::max(start.uncertainty, end.uncertainty);
    if (!(uncertainty <= largest_error)) break;
    limit.sub_impacts.push_back(c[i]);
    limit.sub_impacts.back().start = start.value;
    limit.sub_impacts.back().end = end.value;
    limit.uncertainty.push_back(uncertainty);
  }
  if (i < c.size() && i > 0) {
    limit.horizon = 0.5 * (*limit.sub_impacts.back().end + c[i].start);
    limit.horizon_reason =
        i < common ? fmt::format("the limit of sub-impact {} is not certain to {:.2g} us", i + 1,
                                 1e6 * largest_error)
                   : fmt::format("the finest meshes do not agree on sub-impact {}", i + 1);
  }
  return limit;
}

}  // namespace

MeshLimit mesh_limit(const Case& input, double largest_error) {
  std::vector<Sequence> sequences;
  for (const MeshDescriptor& mesh : meshes()) {
    if (mesh.refinement) sequences.push_back(sequence_of(input, mesh.kind));
  }
  MeshLimit best;
  std::vector<FirstEndLimit> first_end;
  for (const Sequence& sequence : sequences) {
    MeshLimit limit = limit_of(sequence, input.end_time, largest_error);
    first_end.insert(first_end.end(), limit.first_end.begin(), limit.first_end.end());
    const bool better =
        limit.sub_impacts.size() > best.sub_impacts.size() ||
        (limit.sub_impacts.size() == best.sub_impacts.size() && !limit.uncertainty.empty() &&
         limit.uncertainty.back() < best.uncertainty.back());
    if (better) best = limit;
  }
  if (best.sub_impacts.empty()) {
    throw InvalidCase(
        "time.end", fmt::format("is {} s, before which no sub-impact's times are known in the "
                                "limit of fine meshes to {:.2g} us; use a later end, a finer mesh "
                                "(model.segments) or a larger error",
                                input.end_time, 1e6 * largest_error));
  }
  best.first_end = first_end;
  for (Sequence& sequence : sequences) {
    for (std::size_t i = 0; i < sequence.runs.size(); ++i) {
      std::vector<SubImpact> before = sequence.results[i].sub_impacts;
      std::erase_if(before, [&](const SubImpact& s) { return s.start > best.horizon; });
      sequence.runs[i].errors = event_errors(before, best.sub_impacts);
      best.runs.push_back(sequence.runs[i]);
    }
  }
  return best;
}

}  // namespace subimpact
