#include "model/section/section_field.h"

#include <algorithm>
#include <limits>

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const SectionHistory virgin{};

}  // namespace

SectionField::SectionField(std::size_t n_sections, double stiffness)
    : stiffness_(stiffness),
      low_(n_sections, -infinity),
      high_(n_sections, infinity),
      offset_(n_sections, 0.0) {}

SectionField::SectionField(std::size_t n_sections, const SectionLaw& law)
    : law_(law), stiffness_(law.stiffness()), slot_(n_sections, -1) {
  const auto [low, high, offset] = law.window(virgin);
  low_.assign(n_sections, low);
  high_.assign(n_sections, high);
  offset_.assign(n_sections, offset);
}

const SectionHistory& SectionField::history(std::size_t section) const {
  const int slot = slot_[section];
  return slot < 0 ? virgin : memory_[static_cast<std::size_t>(slot)];
}

void SectionField::moments(std::span<const double> curvatures, std::span<double> moments,
                           std::vector<Outside>* outside) const {
  if (outside != nullptr) outside->clear();
  if (!law_) return smooth_moments(curvatures, moments);
  const std::size_t n = curvatures.size();
  const double* k = curvatures.data();
  const double* low = low_.data();
  const double* high = high_.data();
  const double* offset = offset_.data();
  double* m = moments.data();
  const double stiffness = stiffness_;  // out of reach of the stores
  const auto correct_outside = [&](std::size_t i, std::size_t end) {
    for (; i < end; ++i) {
      if (!(k[i] > high[i] || k[i] < low[i])) continue;
      m[i] = law_->flowing_moment(history(i), k[i]);
      if (outside != nullptr) outside->push_back({i, k[i]});
    }
  };
  const auto linear = [=](std::size_t i) {
    const Lanes here = lanes_at(k + i);
    store(stiffness * here - lanes_at(offset + i), m + i);
    // Negative outside the window.
    return reinterpret_cast<LaneMask>(here - lanes_at(low + i)) |
           reinterpret_cast<LaneMask>(lanes_at(high + i) - here);
  };
  std::size_t i = 0;
  for (; i + 4 * n_lanes <= n; i += 4 * n_lanes) {
    const LaneMask signs =
        linear(i) | linear(i + n_lanes) | linear(i + 2 * n_lanes) | linear(i + 3 * n_lanes);
    if (any(signs < 0)) correct_outside(i, i + 4 * n_lanes);
  }
  for (; i + n_lanes <= n; i += n_lanes) {
    if (any(linear(i) < 0)) correct_outside(i, i + n_lanes);
  }
  for (std::size_t j = i; j < n; ++j) m[j] = stiffness * k[j] - offset[j];
  correct_outside(i, n);
}

std::size_t SectionField::commit(const std::vector<Outside>& outside) {
  flowing_.clear();
  for (const auto& [section, curvature] : outside) commit_reversal(section, curvature);
  return outside.size();
}

double SectionField::tangent(std::size_t section, double curvature) const {
  if (curvature >= low_[section] && curvature <= high_[section]) return stiffness_;
  return law_->tangent(history(section), curvature);
}

void SectionField::smooth_moments(std::span<const double> curvatures,
                                  std::span<double> moments) const {
  const std::size_t n = curvatures.size();
  const double* k = curvatures.data();
  const double* offset = offset_.data();
  double* m = moments.data();
  const double stiffness = stiffness_;  // out of reach of the stores
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) m[i] = stiffness * k[i] - offset[i];
  for (const Flow& flow : flowing_) {
    m[flow.section] = law_->moment_on(flow.branch, k[flow.section]);
  }
}

const SectionBranch* SectionField::flowing_branch(std::size_t section) const {
  const auto flow = std::ranges::find(flowing_, section, &Flow::section);
  return flow == flowing_.end() ? nullptr : &flow->branch;
}

double SectionField::smooth_tangent(std::size_t section, double curvature) const {
  const SectionBranch* branch = flowing_branch(section);
  return branch != nullptr ? law_->tangent_on(*branch, curvature) : stiffness_;
}

void SectionField::commit_reversal(std::size_t section, double curvature) {
  if (slot_[section] < 0) {
    slot_[section] = static_cast<int>(memory_.size());
    memory_.emplace_back().reversals.reserve(8);
    at_rest_.emplace_back();
  }
  const auto slot = static_cast<std::size_t>(slot_[section]);
  if (memory_[slot].direction == 0) ++n_yielded_;
  law_->commit(memory_[slot], curvature);
  at_rest_[slot].reset();
  const ElasticWindow window = law_->window(memory_[slot]);
  low_[section] = window.low;
  high_[section] = window.high;
  offset_[section] = window.offset;
}

template <class Visit>
void SectionField::for_each_outside(std::span<const double> curvatures, Visit visit) const {
  const double* k = curvatures.data();
  const double* low = low_.data();
  const double* high = high_.data();
  const auto are_outside = [=](std::size_t i) {
    const Lanes here = lanes_at(k + i);
    return (here > lanes_at(high + i)) | (here < lanes_at(low + i));
  };
  const auto is_outside = [=](std::size_t i) { return k[i] > high[i] || k[i] < low[i]; };
  for_each_found(curvatures.size(), are_outside, is_outside, visit);
}

bool SectionField::any_outside(std::span<const double> curvatures) const {
  bool any = false;
  for_each_outside(curvatures, [&](std::size_t) { any = true; });
  return any;
}

std::size_t SectionField::commit(std::span<const double> curvatures,
                                 std::span<const double> rates) {
  flowing_.clear();
  if (!law_) return 0;
  std::size_t n_flowed = 0;
  for_each_outside(curvatures, [&](std::size_t i) {
    commit_reversal(i, curvatures[i]);
    ++n_flowed;
    const SectionHistory& now = history(i);
    const bool flows_on = !rates.empty() && now.direction * rates[i] > 0.0;
    if (flows_on) flowing_.push_back({i, law_->branch_from_edge(now)});
  });
  return n_flowed;
}

const BendingEnergies& SectionField::at_rest(std::size_t section) const {
  std::optional<BendingEnergies>& rest = at_rest_[static_cast<std::size_t>(slot_[section])];
  if (rest) return *rest;
  const SectionHistory& now = history(section);
  const double inside = 0.5 * (low_[section] + high_[section]);
  const double moment = stiffness_ * inside - offset_[section];
  const double elastic = law_->elastic_energy(now, inside);
  rest = {elastic - 0.5 * moment * moment / stiffness_, law_->work(now, inside) - elastic};
  return *rest;
}

BendingEnergies SectionField::energies(std::span<const double> curvatures,
                                       std::span<const double> weights) const {
  const double half_compliance = stiffness_ > 0.0 ? 0.5 / stiffness_ : 0.0;
  BendingEnergies sum;
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    const double k = curvatures[i];
    if (!law_ || (k >= low_[i] && k <= high_[i])) {  // k may be NaN
      const double moment = stiffness_ * k - offset_[i];
      sum.elastic += weights[i] * half_compliance * moment * moment;
      if (has_yielded(i)) sum.add(weights[i], at_rest(i));
      continue;
    }
    const double elastic = law_->elastic_energy(history(i), k);
    sum.add(weights[i], {elastic, law_->work(history(i), k) - elastic});
  }
  return sum;
}

double SectionField::outer_stress(std::size_t section, double curvature,
                                  double outer_stiffness) const {
  if (!law_) return -outer_stiffness * curvature;
  return law_->outer_stress(history(section), curvature);
}

}  // namespace subimpact
