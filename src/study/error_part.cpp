#include "study/error_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "case/counted.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

// The share of a duration or separation at which an error makes it uncertain. Two errors of half a
// separation may close it; small differences in time may grow faster than one refined run shows, so
// the share for time is half as large.
constexpr double unresolved_share = 0.5;
constexpr double unresolved_share_in_time = 0.25;
constexpr double us = 1e6;  // per second
constexpr double um = 1e6;  // per metre
constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();

// The larger of the differences of start and end; both ends are missing where contact lasts to the
// end.
double difference(const SubImpact& here, const SubImpact& there) {
  const double start = std::abs(here.start - there.start);
  return here.end && there.end ? std::max(start, std::abs(*here.end - *there.end)) : start;
}

// Why a sub-impact with this error in its times is not certain; empty if it is.
std::string unresolved_reason(const std::vector<SubImpact>& all, std::size_t i, double error,
                              double share) {
  for (const LengthBeside& beside : lengths_beside(all, i)) {
    if (!(error > share * beside.length)) continue;
    return fmt::format(
        "the estimated error of sub-impact {}, {:.2g} us, is not small beside {}, {:.2g} us", i + 1,
        us * error, beside.words, us * beside.length);
  }
  return {};
}

struct Doubt {
  std::size_t first_unresolved;
  std::string reason;
};

// "90" for 86, "0.4" for 0.43.
std::string one_digit(double value) {
  const std::string text = fmt::format("{:.1g}", value);
  return value >= 9.5 && value < 1e6 ? fmt::format("{:.0f}", std::stod(text)) : text;
}

// The first sub-impact that a near miss leaves in doubt.
std::optional<Doubt> doubt_by_near_miss(const Result& result, const ErrorPart& part) {
  for (std::size_t i = 0; i < part.gap_errors.size(); ++i) {
    const NearMiss& here = result.near_misses[i];
    if (here.margin > part.gap_errors[i]) continue;
    const bool opens = here.kind == NearMissKind::opening;
    return Doubt{first_in_doubt(result, here),
                 fmt::format("at {:.6g} us the {}: the indentation stays {:.2g} um {} the residual "
                             "one, and its estimated error is {} um",
                             us * here.time, opens ? "contact nearly opens" : "gap nearly closes",
                             um * here.margin, opens ? "above" : "below",
                             one_digit(um * part.gap_errors[i]))};
  }
  return std::nullopt;
}

// The first sub-impact whose times are too uncertain, or that only one of the runs has.
std::optional<Doubt> doubt_by_times(const std::vector<SubImpact>& all, const ErrorPart& part) {
  const std::size_t n = part.errors.size();
  const double share = part.name == "time" ? unresolved_share_in_time : unresolved_share;
  for (std::size_t i = 0; i < n; ++i) {
    std::string reason = unresolved_reason(all, i, part.errors[i], share);
    if (!reason.empty()) return Doubt{i, std::move(reason)};
  }
  if (!part.open_contact.empty()) return Doubt{n, part.open_contact};
  if (n < all.size() || n < part.n_refined) {
    return Doubt{n,
                 fmt::format("the run compared with has {} in all, this run {}; from here on they "
                             "do not correspond",
                             counted(part.n_refined, "sub-impact"), all.size())};
  }
  if (!part.failure.empty()) {
    return Doubt{n, "the run compared with did not complete: " + part.failure};
  }
  return std::nullopt;
}

// The error estimate from one refined run, which has `n_refined` sub-impacts.
ErrorEstimate::Part judge(const Result& result, const ErrorPart& part) {
  ErrorEstimate::Part estimate{part.name, part.refined_run, std::nullopt, {}, 0.0};
  std::size_t n_certain = part.errors.size();
  std::optional<Doubt> doubt = doubt_by_times(result.sub_impacts, part);
  const std::optional<Doubt> graze = doubt_by_near_miss(result, part);
  if (graze && !(doubt && doubt->first_unresolved < graze->first_unresolved)) doubt = graze;
  if (doubt) {
    estimate.first_unresolved = doubt->first_unresolved;
    estimate.reason = doubt->reason;
    n_certain = std::min(n_certain, doubt->first_unresolved);
  }
  for (std::size_t i = 0; i < n_certain; ++i) {
    estimate.largest_error = std::max(estimate.largest_error, part.errors[i]);
  }
  return estimate;
}

// The error of the gap at the event nearest to a near miss, m: the difference in time, times the
// rate of the indentation.
double gap_error_beside(const Result& here, const Result& there, const NearMiss& near_miss) {
  const std::size_t doubted = first_in_doubt(here, near_miss);
  double nearest = std::numeric_limits<double>::infinity();
  double error = 0.0;
  const auto consider = [&](double a, double b, double rate) {
    const double distance = std::abs(a - near_miss.time);
    if (!(distance < nearest)) return;
    nearest = distance;
    error = std::abs(rate * (a - b));
  };
  const auto start = [&](std::size_t i) {
    if (i >= here.sub_impacts.size() || i >= there.sub_impacts.size()) return;
    const SubImpact& s = here.sub_impacts[i];
    consider(s.start, there.sub_impacts[i].start, s.start_rate);
  };
  const auto end = [&](std::size_t i) {
    const SubImpact& s = here.sub_impacts[i];
    const std::optional<double>& other = there.sub_impacts[i].end;
    if (s.end && other) consider(*s.end, *other, s.end_rate);
  };
  start(doubted);
  if (near_miss.kind == NearMissKind::opening) {
    end(doubted);
  } else if (doubted > 0) {
    end(doubted - 1);
  }
  return error;
}

std::vector<double> gap_errors(const Result& here, const Result& there, std::size_t n_matched,
                               double factor) {
  std::vector<double> errors;
  for (const std::optional<std::size_t>& partner : match_near_misses(here, there, n_matched)) {
    const NearMiss& near_miss = here.near_misses[errors.size()];
    errors.push_back(factor * (partner
                                   ? std::abs(near_miss.margin - there.near_misses[*partner].margin)
                                   : gap_error_beside(here, there, near_miss)));
  }
  return errors;
}

// Adds what is known of both to `total`.
void add_leading(const std::vector<double>& errors, std::vector<double>& total) {
  total.resize(std::min(total.size(), errors.size()));
  for (std::size_t i = 0; i < total.size(); ++i) total[i] += errors[i];
}

// Of a contact that only one of two runs ends.
std::string open_contact_reason(std::size_t i, const std::optional<double>& here,
                                const std::optional<double>& there) {
  return fmt::format("sub-impact {} ends at {:.6g} us in {} and lasts to the end in {}", i + 1,
                     us * (here ? *here : *there), here ? "this run" : "the run compared with",
                     here ? "the run compared with" : "this run");
}

// Nothing for a part that stands for several.
std::optional<double>* member_of(SubImpact& s, const std::string& part) {
  if (part == "mesh") return &s.error_mesh;
  if (part == "layers") return &s.error_layers;
  return part == "time" ? &s.error_time : nullptr;
}

// Of the strike, m; infinite without a free end.
double distance_to_free_end(const Scene& scene) {
  double nearest = std::numeric_limits<double>::infinity();
  const double at = scene.striker.position;
  if (scene.beam.ends[0] == EndSupport::free) nearest = at * scene.beam.length;
  if (scene.beam.ends[1] == EndSupport::free) {
    nearest = std::min(nearest, (1.0 - at) * scene.beam.length);
  }
  return nearest;
}

}  // namespace

ErrorPart compare_events(const Result& result, const Result& refined_run, std::string name,
                         std::string description, double factor) {
  const std::vector<SubImpact>& here = result.sub_impacts;
  const std::vector<SubImpact>& there = refined_run.sub_impacts;
  ErrorPart part{std::move(name), std::move(description), {}, {}, there.size(), {}, {}};
  if (!refined_run.outcome.completed()) part.failure = refined_run.outcome.message;
  std::size_t n = n_leading_matches(match_sub_impacts(here, there));
  for (std::size_t i = 0; i < n; ++i) {
    if (here[i].end.has_value() == there[i].end.has_value()) continue;
    part.open_contact = open_contact_reason(i, here[i].end, there[i].end);
    n = i;
  }
  std::vector<double> differences(n);
  for (std::size_t i = 0; i < n; ++i) differences[i] = difference(here[i], there[i]);
  for (std::size_t i = 0; i < n; ++i) {
    const auto first = differences.begin() + static_cast<std::ptrdiff_t>(i > 0 ? i - 1 : 0);
    const auto last = differences.begin() + static_cast<std::ptrdiff_t>(std::min(i + 2, n));
    part.errors.push_back(factor * *std::max_element(first, last));
  }
  part.gap_errors = gap_errors(result, refined_run, n, factor);
  return part;
}

void set_error_bars(Result& result, const std::vector<ErrorPart>& parts) {
  std::vector<SubImpact>& all = result.sub_impacts;
  ErrorEstimate estimate;
  ErrorPart total;  // only what all refined runs have
  total.errors.assign(all.size(), 0.0);
  total.gap_errors.assign(result.near_misses.size(), 0.0);
  for (const ErrorPart& part : parts) {
    for (std::size_t i = 0; i < part.errors.size(); ++i) {
      if (auto* member = member_of(all[i], part.name)) *member = part.errors[i];
    }
    add_leading(part.errors, total.errors);
    add_leading(part.gap_errors, total.gap_errors);
    estimate.parts.push_back(judge(result, part));
    estimate.refined_run += (estimate.refined_run.empty() ? "" : "; ") + part.refined_run;
  }
  for (std::size_t i = 0; i < total.errors.size(); ++i) {
    SubImpact& s = all[i];
    // The first start is where time begins.
    s.start_error = i == 0 ? 0.0 : total.errors[i] + rounding * s.start;
    if (s.end) s.end_error = total.errors[i] + rounding * *s.end;
  }
  total.n_refined = all.size();
  if (parts.size() == 1) total.name = parts.front().name;
  const ErrorEstimate::Part together = judge(result, total);
  // A single part takes precedence, because it names the cause.
  const auto first = [](const ErrorEstimate::Part& part) {
    return part.first_unresolved.value_or(std::numeric_limits<std::size_t>::max());
  };
  const ErrorEstimate::Part* earliest = &together;
  for (const ErrorEstimate::Part& part : estimate.parts) {
    if (part.first_unresolved && first(part) <= first(*earliest)) earliest = &part;
  }
  estimate.first_unresolved = earliest->first_unresolved;
  estimate.reason = earliest->reason;
  const std::size_t n_certain = std::min(first(*earliest), total.errors.size());
  for (std::size_t i = 0; i < n_certain; ++i) {
    estimate.largest_error =
        std::max({estimate.largest_error, *all[i].start_error, all[i].end_error.value_or(0.0)});
  }
  result.error_estimate = estimate;
}

double free_end_error(const Case& input, double contact_time, double time) {
  const Beam& beam = input.scene.beam;
  const bool cells = input.model.mesh == MeshKind::cells && !input.parts.mesh;
  if (!cells || beam.theory != BeamTheory::rayleigh) return 0.0;
  const auto n_free = std::count(beam.ends.begin(), beam.ends.end(), EndSupport::free);
  if (n_free == 0) return 0.0;
  const double speed = std::sqrt(beam.youngs_modulus / beam.density);
  const double y2 = std::pow(beam.radius_of_gyration() / (speed * contact_time), 2);
  const double x = 0.5 * (y2 + std::sqrt(y2 * (y2 + 4.0)));
  const double stretch = 1.0 + x;
  const double group_velocity = speed * std::sqrt(x) * (2.0 + x) / (stretch * std::sqrt(stretch));
  const double round_trip = 2.0 * beam.length / group_velocity;
  const double nearest = distance_to_free_end(input.scene);
  const double reflected =
      std::min(static_cast<double>(n_free) * time + round_trip, time * beam.length / nearest);
  return reflected / input.model.segments * x / stretch;
}

void include_free_ends(ErrorPart& part, const Case& input, const Result& result) {
  for (std::size_t i = 0; i < part.errors.size(); ++i) {
    const SubImpact& s = result.sub_impacts[i];
    const double since_touch = s.end.value_or(s.start) - input.scene.striker.first_touch();
    const double error = free_end_error(input, result.used.contact_time, since_touch);
    part.errors[i] = std::max(part.errors[i], error);
  }
}

}  // namespace subimpact
