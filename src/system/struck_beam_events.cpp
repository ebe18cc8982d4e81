// What may happen within a step of the struck beam, and when.

#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/hermite.h"
#include "system/struck_beam.h"

namespace subimpact {
namespace {

// A cubic through a step's ends is trusted to know the height of a hump between them to this part
// of it; a hump that comes closer to zero is looked at on the trajectory.
constexpr double doubtful_share = 0.5;

bool contains(const GuardList& guards, EventKind kind) {
  return std::any_of(guards.begin(), guards.end(),
                     [&](const Guard& guard) { return guard.kind == kind; });
}

}  // namespace

GuardValue StruckBeam::contact_guard(EventKind kind, double indentation, double rate) const {
  switch (kind) {
    case EventKind::contact_begins:
      return {indentation - residual_indentation(), rate};
    case EventKind::contact_ends:
      return {residual_indentation() - indentation, -rate};
    case EventKind::contact_yields:
      return {indentation - contact_law_->yield_threshold(contact_history_), rate};
    default:
      return {-rate, 0.0};  // unloads
  }
}

double StruckBeam::negligible_excursion(const State& y) const {
  const double size = std::abs(y[n_]) + std::abs(mesh_->struck_point()(beam_positions(y)));
  return 8.0 * std::numeric_limits<double>::epsilon() * size;
}

GuardValue StruckBeam::evaluate(const Guard& guard, const State& y) {
  if (guard.kind == EventKind::contact_unloads) {
    acceleration({y.data(), n_ + 1}, trial_);
    const double second = trial_[n_] - mesh_->struck_point()({trial_.data(), n_});
    return {-guard.sense * indentation_rate(y), -guard.sense * second};
  }
  return contact_guard(guard.kind, indentation(y), indentation_rate(y));
}

bool StruckBeam::find_crossing(const StepEnds& step, const GuardList& without, Crossing& earliest) {
  earliest.guess = std::numeric_limits<double>::infinity();
  if (step.event_free) return false;
  const double lambda0 = indentation(step.y0);
  const double lambda1 = indentation(step.y1);
  const double rate0 = indentation_rate(step.y0);
  const double rate1 = indentation_rate(step.y1);
  bool found = false;
  const auto consider = [&](EventKind kind) {
    if (contains(without, kind)) return;
    const GuardValue g0 = contact_guard(kind, lambda0, rate0);
    const GuardValue g1 = contact_guard(kind, lambda1, rate1);
    double after = 0.0;
    double guess = 0.0;
    if (kind == EventKind::contact_unloads) {
      if (!(g1.value > 0.0)) return;
      guess = g0.value < 0.0 ? g0.value / (g0.value - g1.value) : 0.0;
    } else {
      const HermiteCubic path(g0.value, g0.rate, g1.value, g1.rate, step.length());
      if (g1.value > 0.0) {
        if (g0.value >= 0.0 && g0.rate > 0.0 && g1.rate > 0.0) {
          // Beyond from the start on: it happened at the start.
          earliest = {{kind}, step.t0, step.t0, step.t0};
          found = true;
          return;
        }
        // A guard still at zero from the event before first falls: look behind its lowest point.
        if (g0.rate < 0.0) {
          const HermiteCubic mirrored(-g0.value, -g0.rate, -g1.value, -g1.rate, step.length());
          if (g1.rate > 0.0) after = mirrored.peak();
        }
      } else {
        // Not beyond at the end; was it in between?
        if (!pair_detection_ || !(g0.rate > 0.0 && g1.rate < 0.0)) return;
        const double peak = path.peak();
        const double height = path(peak) - std::max(g0.value, g1.value);
        if (!(path(peak) > negligible_excursion(step.y1) - doubtful_share * height)) return;
        const double time = step.t0 + peak * step.length();
        if (time < earliest.guess) {
          earliest = {{kind}, step.t0, step.t1, time, true};
          found = true;
        }
        return;
      }
      guess = path.rise(after, 1.0);
    }
    const double t_guess = step.t0 + guess * step.length();
    if (t_guess < earliest.guess) {
      earliest = {{kind}, step.t0 + after * step.length(), step.t1, t_guess};
      found = true;
    }
  };
  switch (contact_branch_) {
    case ContactBranch::separated:
      consider(EventKind::contact_begins);
      break;
    case ContactBranch::elastic:
      consider(EventKind::contact_ends);
      consider(EventKind::contact_yields);
      break;
    case ContactBranch::plastic:
      consider(EventKind::contact_unloads);
      break;
  }
  return found;
}

std::optional<double> StruckBeam::first_flow(const StepEnds& step) {
  if (step.event_free) return std::nullopt;
  read_motion(step.y1, end_);
  const auto flows = [&](std::size_t i) {
    return !(end_.curvatures[i] >= sections_.window_low()[i] &&
             end_.curvatures[i] <= sections_.window_high()[i]);
  };
  std::size_t i = 0;
  while (i < sections_.size() && !flows(i)) ++i;
  if (i == sections_.size()) return std::nullopt;
  SectionMotion start(sections_.size());
  read_motion(step.y0, start);
  std::optional<double> first;
  for (; i < sections_.size(); ++i) {
    if (!flows(i)) continue;
    const double k1 = end_.curvatures[i];
    const double sense = k1 > sections_.window_high()[i] ? 1.0 : -1.0;
    const double edge = sense > 0.0 ? sections_.window_high()[i] : -sections_.window_low()[i];
    const HermiteCubic path(sense * start.curvatures[i] - edge, sense * start.rates[i],
                            sense * k1 - edge, sense * end_.rates[i], step.length());
    const double time = step.t0 + path.rise(0.0, 1.0) * step.length();
    if (!first || time < *first) first = time;
  }
  return first;
}

}  // namespace subimpact
