#include "subimpact/study/error_bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "subimpact/study/match.h"

namespace subimpact {
namespace {

constexpr double tighter = 1e-2;
constexpr double tightest = 1e-14;
constexpr double safety = 3.0;
constexpr double undecided_share = 0.25;

// Differences of one event's start and end; an end is missing where contact lasts to the end.
struct Difference {
  double start = 0.0;
  double end = 0.0;
  double larger() const { return std::max(start, end); }
};

std::string undecided_reason(const SubImpact& here, const SubImpact* before,
                             const SubImpact* after) {
  const double start_error = here.start_error.value_or(0.0);
  const double end_error = here.end_error.value_or(0.0);
  if (here.end && std::max(start_error, end_error) > undecided_share * (*here.end - here.start)) {
    return "its estimated error is not small beside its duration";
  }
  if (before && before->end && start_error > undecided_share * (here.start - *before->end)) {
    return "its estimated error is not small beside the separation before it";
  }
  if (after && here.end && end_error > undecided_share * (after->start - *here.end)) {
    return "its estimated error is not small beside the separation after it";
  }
  return {};
}

}  // namespace

Companion companion_of(const Case& input) {
  Companion companion{input, {}};
  companion.input.output.interval = 0.0;
  companion.input.output.sections.clear();
  SolverOptions& solver = companion.input.solver;
  const Used used = explain(input);
  if (used.step) {
    solver.step = 0.5 * *used.step;
    companion.description =
        fmt::format("the same with half the step, {:.6g} us", 1e6 * *solver.step);
  } else if (tighter * solver.rtol >= tightest) {
    solver.rtol *= tighter;
    companion.description = fmt::format("the same with rtol = {:.3g}", solver.rtol);
  } else {
    solver.rtol /= tighter;
    companion.description =
        fmt::format("the same with rtol = {:.3g}, whose errors these are", solver.rtol);
  }
  return companion;
}

void add_error_bars(Result& result, const Result& companion, const std::string& description) {
  std::vector<SubImpact>& here = result.sub_impacts;
  const std::vector<SubImpact>& there = companion.sub_impacts;
  const std::size_t n = n_leading_matches(match_sub_impacts(here, there));
  std::vector<Difference> differences(n);
  for (std::size_t i = 0; i < n; ++i) {
    differences[i].start = std::abs(here[i].start - there[i].start);
    if (here[i].end && there[i].end) differences[i].end = std::abs(*here[i].end - *there[i].end);
  }
  Trust trust;
  trust.companion = description;
  constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < n; ++i) {
    double around = differences[i].larger();
    if (i > 0) around = std::max(around, differences[i - 1].larger());
    if (i + 1 < n) around = std::max(around, differences[i + 1].larger());
    // The first start is where time begins.
    here[i].start_error = i == 0 ? 0.0 : safety * around + rounding * here[i].start;
    if (here[i].end) here[i].end_error = safety * around + rounding * *here[i].end;
  }
  for (std::size_t i = 0; i < n; ++i) {
    trust.reason = undecided_reason(here[i], i > 0 ? &here[i - 1] : nullptr,
                                    i + 1 < here.size() ? &here[i + 1] : nullptr);
    if (!trust.reason.empty()) {
      trust.first_undecided = i;
      break;
    }
    trust.largest_error = std::max(
        {trust.largest_error, here[i].start_error.value_or(0.0), here[i].end_error.value_or(0.0)});
  }
  if (!trust.first_undecided && (n < here.size() || n < there.size())) {
    trust.first_undecided = n;
    trust.reason = fmt::format(
        "the companion run has {} sub-impacts in all, this one {}; from here on "
        "they do not correspond",
        there.size(), here.size());
  }
  if (!companion.outcome.completed() && !trust.first_undecided) {
    trust.first_undecided = n;
    trust.reason = "the companion run did not complete: " + companion.outcome.message;
  }
  result.trust = trust;
}

Result simulate_with_error_bars(const Case& input, const Progress& progress) {
  // Each run shows half of the progress.
  const auto half = [&](double offset) -> Progress {
    if (!progress) return {};
    return [&progress, offset, end = input.end_time](double t) {
      return progress(0.5 * (offset * end + t));
    };
  };
  Result result = simulate(input, half(0.0));
  if (result.outcome.kind == OutcomeKind::stopped) return result;
  const Companion companion = companion_of(input);
  const Result second = simulate(companion.input, half(1.0));
  add_error_bars(result, second, companion.description);
  return result;
}

}  // namespace subimpact
