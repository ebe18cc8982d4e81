#include "subimpact/study/event_errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

double median_of(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

EventErrors event_errors(const std::vector<SubImpact>& run,
                         const std::vector<SubImpact>& reference) {
  EventErrors errors;
  errors.n_reference = reference.size();
  errors.n_found = run.size();
  const std::vector<MatchedPair> pairs = match_sub_impacts(reference, run);
  errors.n_corresponding = n_leading_matches(pairs);
  errors.unmatched = first_unmatched(pairs, reference, run);
  std::vector<double> times;
  for (std::size_t i = 0; i < errors.n_corresponding; ++i) {
    const SubImpact& there = reference[i];
    const SubImpact& here = run[i];
    if (there.end && !here.end) {
      errors.n_corresponding = i;
      errors.unmatched = {here.start, *there.end - there.start,
                          fmt::format("at {:.3f} us the contact of the reference ends, and it is "
                                      "still open here",
                                      1e6 * *there.end)};
      break;
    }
    if (i > 0) times.push_back(std::abs(here.start - there.start));
    if (here.end && there.end) times.push_back(std::abs(*here.end - *there.end));
    errors.peak_force =
        std::max(errors.peak_force, std::abs(here.peak_force / there.peak_force - 1.0));
  }
  if (!times.empty()) {
    errors.maximum = *std::max_element(times.begin(), times.end());
    errors.first = times.front();
    errors.last = times.back();
  }
  errors.median = median_of(times);
  return errors;
}

EventErrors event_errors(const Result& run, const Reference& reference) {
  EventErrors errors = event_errors(run.sub_impacts, reference.sub_impacts);
  const double unit = reference.input.scene.striker.velocity;
  errors.striker_velocity =
      std::abs(run.striker_velocity - reference.result.striker_velocity) / unit;
  errors.beam_velocity =
      std::abs(run.beam_mean_velocity - reference.result.beam_mean_velocity) / unit;
  return errors;
}

std::string_view to_string(Verdict verdict) {
  constexpr std::string_view names[] = {"right",  "wrong count", "inaccurate", "unstable",
                                        "failed", "refused",     "not run"};
  return names[static_cast<std::size_t>(verdict)];
}

Verdict judge(const Result& run, const EventErrors& errors) {
  switch (run.outcome.kind) {
    case OutcomeKind::completed:
      return errors.all_correspond() ? Verdict::right : Verdict::wrong_count;
    case OutcomeKind::inaccurate:
    case OutcomeKind::chattering:
      return Verdict::inaccurate;
    case OutcomeKind::unstable:
    case OutcomeKind::left_validity:  // of a scene whose reference stays within it
      return Verdict::unstable;
    case OutcomeKind::solver_failed:
    case OutcomeKind::stopped:
      return Verdict::failed;
  }
  return Verdict::failed;
}

}  // namespace subimpact
