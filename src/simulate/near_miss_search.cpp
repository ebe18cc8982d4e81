#include "simulate/near_miss_search.h"

#include "numerics/hermite.h"

namespace subimpact {
namespace {

// Near: a margin below this part of the largest gap of the contact or separation.
constexpr double near_share = 0.5;

// The cubic is assumed to have the height of a minimum below the ends of the step right to this
// part of the height; margins are refined to this part of themselves.
constexpr double uncertain_share = 0.5;
constexpr double margin_accuracy = 1e-5;
constexpr int most_refinements = 6;

// The gap at the ends of a step, of its cubic at s.
struct GapStep {
  double t0, t1, g0, rate0, g1, rate1;

  double time(double s) const { return t0 + s * (t1 - t0); }
  double value(double s) const { return HermiteCubic(g0, rate0, g1, rate1, t1 - t0)(s); }

  // Where the cubic has its local minimum, if it has one.
  std::optional<double> minimum() const {
    const HermiteCubic upside_down(-g0, -rate0, -g1, -rate1, t1 - t0);
    if (rate0 < 0.0 && rate1 >= 0.0) return upside_down.peak();
    if (!upside_down.reversed_at()) return std::nullopt;
    return rate0 < 0.0 ? upside_down.extrema().first : upside_down.extrema().second;
  }
};

}  // namespace

std::optional<IndentationStep> part_around(const ObservedStep& step, const StruckBeam& beam,
                                           const std::optional<std::pair<double, double>>& times,
                                           State& state) {
  if (!times) return std::nullopt;
  const auto [t0, t1] = *times;
  step.state_at(t0, state);
  const double lambda0 = beam.indentation(state), rate0 = beam.indentation_rate(state);
  step.state_at(t1, state);
  return IndentationStep{
      t0, t1, lambda0, rate0, beam.indentation(state), beam.indentation_rate(state)};
}

void NearMissSearch::look_into(const ObservedStep& step, const StruckBeam& beam,
                               const IndentationStep& ends, bool refine) {
  const double residual = beam.contact().residual_indentation();
  const auto gap = [&](double lambda) { return sense_ * (lambda - residual); };
  GapStep part{ends.t0,           ends.t1,
               gap(ends.lambda0), sense_ * ends.rate0,
               gap(ends.lambda1), sense_ * ends.rate1};
  for (int n = 0;; ++n) {
    const std::optional<double> s = part.minimum();
    if (!s) return;
    // The step has no event here, so the margin is at least the rounding.
    const double margin = std::max(part.value(*s), beam.displacement_rounding(step.y1()));
    if (kept_.size() == most_kept && !(margin < kept_.back().margin)) return;
    const double depth = std::min(part.g0, part.g1) - part.value(*s);
    const bool certain = uncertain_share * depth <= margin_accuracy * margin;
    if (certain || !refine || n == most_refinements) return keep({part.time(*s), margin, kind_});
    const double middle = part.time(*s);
    step.state_at(middle, state_);
    const double g = gap(beam.indentation(state_));
    const double rate = sense_ * beam.indentation_rate(state_);
    if (rate < 0.0) {
      part = {middle, part.t1, g, rate, part.g1, part.rate1};
    } else {
      part = {part.t0, middle, part.g0, part.rate0, g, rate};
    }
  }
}

void NearMissSearch::keep(const NearMiss& near_miss) {
  const auto farther = std::ranges::upper_bound(kept_, near_miss.margin, {}, &NearMiss::margin);
  kept_.insert(farther, near_miss);
  if (kept_.size() > most_kept) kept_.pop_back();
}

std::optional<ClosestApproach> NearMissSearch::closest(double end, const State& y,
                                                       const StruckBeam& beam) const {
  std::optional<ClosestApproach> found;
  if (!kept_.empty()) found = {kept_[0].time, kept_[0].margin, {}};
  const double gap = beam.contact().residual_indentation() - beam.indentation(y);
  const bool is_closing = beam.indentation_rate(y) > 0.0;
  if (is_closing && !(found && found->gap <= gap)) found = {end, gap, {}};
  return found;
}

void NearMissSearch::finish(double residual, std::vector<NearMiss>& near_misses) {
  const double largest = farthest_ - sense_ * residual;
  const auto before = static_cast<std::ptrdiff_t>(near_misses.size());
  for (const NearMiss& kept : kept_) {
    if (kept.margin < near_share * largest) near_misses.push_back(kept);
  }
  std::ranges::sort(near_misses.begin() + before, near_misses.end(), {}, &NearMiss::time);
  kept_.clear();
}

namespace {

// Steps are halved until the gap at the middle is that of the cubic, to this part of the largest
// gap.
constexpr double accuracy = 1e-5;
constexpr int most_halvings = 6;

}  // namespace

void LargestGap::follow(const ObservedStep& step, const StruckBeam& beam, double& largest) {
  const IndentationStep& ends = step.indentation();
  const double residual = beam.contact().residual_indentation();
  largest = std::max(largest, residual - ends.lambda1);
  if (step.ends().event_free) {
    const auto part = part_around(step, beam, step.integrator().around_smallest(), state_);
    if (!part) return;
    largest = std::max({largest, residual - part->lambda0, residual - part->lambda1});
    look_into(step, beam, *part, largest);
  } else if (may_turn(ends, 1.0)) {
    look_into(step, beam, ends, largest);
  }
}

void LargestGap::look_into(const ObservedStep& step, const StruckBeam& beam, IndentationStep part,
                           double& largest) {
  const double residual = beam.contact().residual_indentation();
  for (int n = 0;; ++n) {
    const HermiteCubic gap(residual - part.lambda0, -part.rate0, residual - part.lambda1,
                           -part.rate1, part.length());
    const std::optional<double> top = gap.maximum();
    if (!top || !(gap(*top) > largest)) return;
    if (!of_trajectory_ || n == most_halvings) {
      largest = gap(*top);
      return;
    }
    const double t = part.t0 + *top * part.length();
    step.state_at(t, state_);
    const double lambda = beam.indentation(state_), rate = beam.indentation_rate(state_);
    largest = std::max(largest, residual - lambda);
    if (std::abs(residual - lambda - gap(*top)) <= accuracy * largest) return;
    part = rate < 0.0 ? IndentationStep{t, part.t1, lambda, rate, part.lambda1, part.rate1}
                      : IndentationStep{part.t0, t, part.lambda0, part.rate0, lambda, rate};
  }
}

}  // namespace subimpact
