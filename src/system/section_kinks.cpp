#include "system/section_kinks.h"

#include <algorithm>
#include <cmath>

#include "events/hermite.h"
#include "model/lanes.h"

namespace subimpact {
namespace {

// A cubic exceeds its ends by at most this part of the step times each end's rate.
constexpr double cubic_excess = 4.0 / 27.0;

// Three Gauss points on [0, 1].
constexpr std::array<double, 3> gauss_point{0.1127016653792583, 0.5, 0.8872983346207417};
constexpr std::array<double, 3> gauss_weight{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

const SectionBranch* branch_of(const SectionField& sections, std::size_t section) {
  for (const SectionField::Flow& flow : sections.flowing()) {
    if (flow.section == section) return &flow.branch;
  }
  return nullptr;
}

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
  const double h = t1 - t0;
  const SectionLaw& law = sections.law();
  kinks_.clear();
  for (const std::size_t i : suspects_) {
    const double k0 = start.curvatures[i];
    const double k1 = end.curvatures[i];
    const double r0 = start.rates[i];
    const double r1 = end.rates[i];
    const double low = sections.window_low()[i];
    const double high = sections.window_high()[i];
    const SectionBranch* branch = branch_of(sections, i);
    const HermiteSeptic path({k0, r0, start.second[i], start.third[i]},
                             {k1, r1, end.second[i], end.third[i]}, h);
    double sense = r0 > 0.0 ? 1.0 : -1.0;
    if (branch) {
      sense = branch->sense;
    } else if (k1 > high || k1 < low) {
      sense = k1 > high ? 1.0 : -1.0;
    }
    // Parts of the step after which it turned, if it did, and left its piece.
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

    std::array<double, 4> amount{};
    const auto integrate = [&](double from, double to, const SectionHistory& memory) {
      for (std::size_t g = 0; g < gauss_point.size(); ++g) {
        const double s = from + (to - from) * gauss_point[g];
        const double k = path(s);
        const double piece = branch ? law.moment_on(*branch, k) : sections.resting_moment(i, k);
        double defect = gauss_weight[g] * (to - from) * h * (law.moment(memory, k) - piece);
        for (std::size_t m = 0; m < amount.size(); ++m) {
          amount[m] += defect;
          defect *= (1.0 - s) * h / static_cast<double>(m + 1);
        }
      }
    };
    const SectionHistory* memory = &sections.history(i);
    integrate(left, turn.value_or(1.0), *memory);
    SectionKink kink{i, t0 + left * h, {}, {}, 0.0};
    if (turn) {
      turned_ = *memory;
      memory = &turned_;
      law.commit(turned_, farthest);
      integrate(*turn, 1.0, turned_);
      kink.turn = {t0 + *turn * h, farthest};
    }
    kink.amount = amount;
    kink.tangent = law.tangent(*memory, k1);
    kinks_.push_back(kink);
  }
}

}  // namespace subimpact
