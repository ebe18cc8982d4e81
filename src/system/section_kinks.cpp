#include "system/section_kinks.h"

#include <algorithm>
#include <cmath>

#include "numerics/bracketed_root.h"
#include "numerics/hermite.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

// A cubic exceeds its ends by at most this part of the step times each end's rate.
constexpr double cubic_excess = 4.0 / 27.0;

// Five Gauss points on [0, 1].
constexpr std::array<double, 5> gauss_point{0.046910077030668, 0.2307653449471585, 0.5,
                                            0.7692346550528415, 0.953089922969332};
constexpr std::array<double, 5> gauss_weight{0.1184634425280945, 0.239314335249683,
                                             0.2844444444444444, 0.239314335249683,
                                             0.1184634425280945};

const SectionBranch* branch_of(const SectionField& sections, std::size_t section) {
  for (const SectionField::Flow& flow : sections.flowing()) {
    if (flow.section == section) return &flow.branch;
  }
  return nullptr;
}

// The earlier kinks of a step whose disturbance of a section is followed, the strongest: where a
// step has more of them it is far too long to be told apart so finely.
constexpr std::size_t most_disturbances = 12;

}  // namespace

bool SectionKinks::suspect(const SectionField& sections, const SectionMotion& start,
                           const SectionMotion& end, double length) {
  const double* k0 = start.curvatures.data();
  const double* k1 = end.curvatures.data();
  const double* r0 = start.rates.data();
  const double* r1 = end.rates.data();
  const double* low = sections.window_low().data();
  const double* high = sections.window_high().data();
  const double reach = cubic_excess * length;
  suspects_.clear();
  cut_.reset();
  const auto consider = [&](std::size_t i) {
    const HermiteCubic path(k0[i], r0[i], k1[i], r1[i], length);
    const std::optional<double> back = path.reversed_at();
    if (const SectionBranch* branch = branch_of(sections, i)) {
      if (back) {
        cut_ = std::min(cut_.value_or(1.0), *back);
      } else if (branch->sense * r1[i] > 0.0 && branch->sense * (k1[i] - branch->limit) <= 0.0) {
        return;  // it flowed throughout on one branch
      }
    } else if (k1[i] >= low[i] && k1[i] <= high[i]) {
      if (back) {
        const double farthest = path(path.first_turn());
        if (farthest >= low[i] && farthest <= high[i]) return;
        cut_ = std::min(cut_.value_or(1.0), *back);
      } else if (r0[i] * r1[i] >= 0.0) {
        return;  // it stayed between its ends
      }
    }
    suspects_.push_back(i);
  };
  for_each_found(
      sections.size(),
      [=](std::size_t i) {
        const Lanes a = lanes_at(k0 + i);
        const Lanes b = lanes_at(k1 + i);
        const Lanes s = lanes_at(r0 + i);
        const Lanes e = lanes_at(r1 + i);
        const Lanes margin = reach * ((s > 0.0 ? s : -s) + (e > 0.0 ? e : -e));
        const Lanes upper = a > b ? a : b;
        const Lanes lower = a > b ? b : a;
        return (upper + margin > lanes_at(high + i)) | (lower - margin < lanes_at(low + i));
      },
      [=](std::size_t i) {
        const double margin = reach * (std::abs(r0[i]) + std::abs(r1[i]));
        return std::max(k0[i], k1[i]) + margin > high[i] ||
               std::min(k0[i], k1[i]) - margin < low[i];
      },
      consider);
  return !suspects_.empty();
}

void SectionKinks::find(const SectionField& sections, const SectionMotion& start,
                        const SectionMotion& end, double t0, double t1) {
  t0_ = t0;
  length_ = t1 - t0;
  kinks_.clear();
  interplay_ = {};
  trace(sections, start, end);
  for (const Trace& trace : traces_) add_kink(sections, trace);
  if (kinks_.empty()) return;
  // Sections that flowed to the end if undisturbed, but were turned back by these.
  for (const SectionField::Flow& flow : sections.flowing()) {
    const std::size_t i = flow.section;
    const double sense = flow.branch.sense;
    const double slope = length_ * end.rates[i];
    if (sense * slope <= 0.0) continue;
    choose_disturbances(i);
    if (sense * (slope + change_by_kinks(1.0).slope) >= 0.0) continue;
    if (std::find(suspects_.begin(), suspects_.end(), i) != suspects_.end()) continue;
    add_kink(sections, {i, &flow.branch, sense, path_of(i, start, end), 1.0, 1.0});
  }
}

HermiteSeptic SectionKinks::path_of(std::size_t section, const SectionMotion& start,
                                    const SectionMotion& end) const {
  const auto rates_at = [&](const SectionMotion& at) -> HermiteSeptic::End {
    return {at.curvatures[section], at.rates[section],
            influence_.curvature_acceleration(section, at.weighted_moments, at.force),
            influence_.curvature_acceleration(section, at.weighted_moment_rates, at.force_rate)};
  };
  return {rates_at(start), rates_at(end), length_};
}

void SectionKinks::trace(const SectionField& sections, const SectionMotion& start,
                         const SectionMotion& end) {
  const double h = length_;
  traces_.clear();
  for (const std::size_t i : suspects_) {
    const double k0 = start.curvatures[i];
    const double k1 = end.curvatures[i];
    const double r0 = start.rates[i];
    const double r1 = end.rates[i];
    const double low = sections.window_low()[i];
    const double high = sections.window_high()[i];
    const SectionBranch* branch = branch_of(sections, i);
    double sense = r0 > 0.0 ? 1.0 : -1.0;
    if (branch) {
      sense = branch->sense;
    } else if (k1 > high || k1 < low) {
      sense = k1 > high ? 1.0 : -1.0;
    }
    const HermiteSeptic path = path_of(i, start, end);
    std::optional<double> turn;
    double farthest = k1;
    if (sense * r0 > 0.0 && sense * r1 < 0.0) {
      turn = path.turn(HermiteCubic(sense * k0, sense * r0, sense * k1, sense * r1, h).peak());
      farthest = path(*turn);
    }
    double left = turn.value_or(1.0);
    const double edge = branch ? branch->limit : sense > 0.0 ? high : low;
    if (sense * (farthest - edge) > 0.0) {
      const HermiteCubic rise(sense * (k0 - edge), sense * r0, sense * (k1 - edge), sense * r1, h);
      left = sense * (k0 - edge) >= 0.0 ? 0.0 : rise.rise(0.0, left);
    } else if (!branch || !turn) {
      continue;
    }
    traces_.push_back({i, branch, sense, path, left, turn});
  }
  std::sort(traces_.begin(), traces_.end(),
            [](const Trace& a, const Trace& b) { return a.left < b.left; });
}

void SectionKinks::choose_disturbances(std::size_t section) {
  disturbances_.clear();
  for (const SectionKink& kink : kinks_) {
    const double coupling = influence_.curvature_acceleration_at(section, kink.section);
    const double left = (kink.start - t0_) / length_;
    const double strength = std::abs(coupling * kink.amount[1]);
    if (strength == 0.0 || left >= 1.0) continue;
    disturbances_.push_back(
        {left, strength,
         Growth(1.0 - left, length_, coupling * kink.amount[0], coupling * kink.amount[1])});
  }
  if (disturbances_.size() <= most_disturbances) return;
  const auto kept = disturbances_.begin() + most_disturbances;
  std::nth_element(
      disturbances_.begin(), kept, disturbances_.end(),
      [](const Disturbance& a, const Disturbance& b) { return a.strength > b.strength; });
  disturbances_.erase(kept, disturbances_.end());
}

SectionKinks::Change SectionKinks::change_by_kinks(double s) const {
  Change sum;
  for (const Disturbance& by : disturbances_) {
    if (s <= by.left) continue;
    sum.value += by.growth.value(s - by.left);
    sum.slope += by.growth.slope(s - by.left);
  }
  return sum;
}

void SectionKinks::add_kink(const SectionField& sections, const Trace& trace) {
  const SectionLaw& law = sections.law();
  const std::size_t i = trace.section;
  const SectionHistory& before = sections.history(i);

  choose_disturbances(i);
  // Until it turns the section's own flow moves it, too.
  std::optional<Growth> own;
  double own_until = 1.0;
  const double own_coupling = influence_.curvature_acceleration_at(i, i);
  const auto change = [&](double s) {
    Change sum = change_by_kinks(s);
    const double since = std::min(s, own_until) - trace.left;
    if (own && since > 0.0) {
      sum.value += own_coupling * own->value(since);
      if (s <= own_until) sum.slope += own_coupling * own->slope(since);
    }
    return sum;
  };
  SectionKink kink{i, 0.0, {}, 0.0, {}};
  // Calls add(s, defect ds) at the points of a quadrature over a stretch of the step.
  const auto integrate = [&](double from, double to, const SectionHistory& memory, auto add) {
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const double s = from + (to - from) * gauss_point[g];
      const double k = trace.path(s);
      const double moved = change(s).value;
      const double piece =
          trace.branch ? law.moment_on(*trace.branch, k) : sections.resting_moment(i, k);
      // What the tangent makes of `moved` is part of the beam's answer.
      const double defect = law.moment(memory, k + moved) - kink.tangent * moved - piece;
      add(s, gauss_weight[g] * (to - from) * length_ * defect);
    }
  };

  const double flow_ends = trace.turn.value_or(1.0);
  if (trace.left < flow_ends) {
    kink.tangent = law.tangent(before, trace.path(flow_ends));
    double amount = 0.0;
    double next_amount = 0.0;
    integrate(trace.left, flow_ends, before, [&](double s, double part) {
      amount += part;
      next_amount += (flow_ends - s) * length_ * part;
    });
    if (next_amount != 0.0) own.emplace(flow_ends - trace.left, length_, amount, next_amount);
  }

  const auto speed = [&](double s) {
    return trace.sense * (trace.path.slope(s) + change(s).slope);
  };
  std::optional<double> turn;
  if (speed(1.0) < 0.0) {
    const double begin = own ? trace.left : 0.0;
    turn = speed(begin) > 0.0 ? root_in(speed, begin, 1.0) : begin;
  }
  double left = trace.left;
  if (left == flow_ends) {  // it leaves its branch by turning only
    if (!turn) return;
    left = *turn;
  }
  kink.start = t0_ + left * length_;
  const auto add = [&](double s, double part) {
    for (std::size_t m = 0; m < kink.amount.size(); ++m) {
      kink.amount[m] += part;
      part *= (1.0 - s) * length_ / static_cast<double>(m + 1);
    }
  };
  kink.tangent =
      turn ? sections.stiffness() : law.tangent(before, trace.path(1.0) + change(1.0).value);
  // Disturbed by earlier kinks it answered with another tangent until now.
  if (!kinks_.empty()) {
    const double first = (kinks_.front().start - t0_) / length_;
    if (first < left) integrate(first, left, before, add);
  }
  if (!turn) {
    integrate(left, 1.0, before, add);
  } else {
    if (left < *turn) integrate(left, *turn, before, add);
    own_until = *turn;
    const double farthest = trace.path(*turn) + change(*turn).value;
    // Disturbed by earlier kinks it may have stayed in its window.
    if (!trace.branch && farthest >= sections.window_low()[i] &&
        farthest <= sections.window_high()[i]) {
      return;
    }
    turned_ = before;
    law.commit(turned_, farthest);
    integrate(*turn, 1.0, turned_, add);
    kink.turn = {t0_ + *turn * length_, farthest};
  }
  const double disturbed = std::abs(change_by_kinks(turn.value_or(1.0)).value) *
                           sections.stiffness() * (1.0 - left) * length_ * influence_.strength(i);
  if (disturbed > interplay_.velocity) interplay_ = {disturbed, kink.start};
  kinks_.push_back(kink);
}

}  // namespace subimpact
