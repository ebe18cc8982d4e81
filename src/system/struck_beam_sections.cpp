// What sections do within a step of the struck beam beyond the smooth pieces of their laws.

#include <algorithm>
#include <cmath>

#include "system/struck_beam.h"

namespace subimpact {
namespace {

// A step that must be cut ends after the kink that spoils it, by this part of what is estimated to
// be tolerable.
constexpr double cut_safety = 0.8;
// Kinks are followed in what they do to each other to first order. This part of it is taken to be
// left: with it steps of the paper's beam at rtol 1e-11 are off by 0.7 of the tolerance (root mean
// square), without it single ones by 600 times the tolerance.
constexpr double interplay_left = 0.03;
// Steps shorter than this, in radians of the highest frequency, are not cut.
constexpr double shortest_cut = 1e-3;

}  // namespace

double StruckBeam::find_section_kinks(const StepEnds& step) {
  kinks_.clear();
  if (step.event_free || section_evaluation_ != Evaluation::smooth || !sections_.can_yield()) {
    return step.t1;
  }
  read_motion(step.y1, end_);
  if (!kinks_.suspect(sections_, start_, end_, step.length())) return step.t1;
  // In a very short step it is rounding that changes direction.
  const bool may_cut = highest_frequency_ * step.length() > shortest_cut;
  if (kinks_.cut() && may_cut) return step.t0 + *kinks_.cut() * step.length();
  read_moments(step.y0, start_);
  read_moments(step.y1, end_);
  kinks_.find(sections_, start_, end_, step.t0, step.t1);
  if (kinks_.kinks().empty()) return step.t1;

  const SectionKinks::Interplay& interplay = kinks_.interplay();
  if (may_cut && interplay_left * interplay.velocity > kink_tolerance_ &&
      interplay.time > step.t0) {
    return interplay.time;
  }
  std::size_t last = 0;
  while (last + 2 < SectionKink::most_terms && bound_of_term(last + 1) > kink_tolerance_) ++last;
  answer_to_kinks(0, last, velocity_change_);
  answer_to_kinks(1, last, position_change_);
  const double left_out = bound_of_term(last + 1);
  if (left_out <= kink_tolerance_) return step.t1;
  double start = step.t1;
  for (const SectionKink& kink : kinks_.kinks()) start = std::min(start, kink.start);
  // The term grows as this power of the time since the kink, or faster.
  const double power = static_cast<double>(2 * (last + 1) + 3);
  const double tolerable = (step.t1 - start) * std::pow(kink_tolerance_ / left_out, 1.0 / power);
  return std::max(start, step.t0) + cut_safety * tolerable;
}

void StruckBeam::add_kinks(State& y) const {
  if (kinks_.kinks().empty()) return;
  for (std::size_t i = 0; i < n_; ++i) {
    y[i] += position_change_[i];
    y[n_ + 1 + i] += velocity_change_[i];
  }
}

void StruckBeam::put_right(State& y) {
  add_kinks(y);
  for (const SectionKink& kink : kinks_.kinks()) {
    if (kink.turn) sections_.commit_turn(kink.section, kink.turn->curvature);
  }
}

void StruckBeam::read_moments(const State& y, SectionMotion& at) {
  const std::span<const double> weights = mesh_->section_weights();
  const auto weigh = [&](std::vector<double>& moments) {
    for (std::size_t i = 0; i < moments.size(); ++i) moments[i] *= weights[i];
  };
  sections_.smooth_moments(at.curvatures, at.weighted_moments);
  linear_moments(at.rates, at.curvatures, at.weighted_moment_rates);
  weigh(at.weighted_moments);
  weigh(at.weighted_moment_rates);
  at.force = contact_force(y);
  at.force_rate = in_contact() ? force_slope(indentation(y)) * indentation_rate(y) : 0.0;
}

void StruckBeam::linear_moments(std::span<const double> changes, std::span<const double> curvatures,
                                std::span<double> moments) const {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    moments[i] = sections_.stiffness() * changes[i];
  }
  for (const SectionField::Flow& flow : sections_.flowing()) {
    const std::size_t i = flow.section;
    moments[i] = sections_.law().tangent_on(flow.branch, curvatures[i]) * changes[i];
  }
}

void StruckBeam::answer_to_kinks(std::size_t order, std::size_t last, std::vector<double>& answer) {
  std::fill(answer.begin(), answer.end(), 0.0);
  for (std::size_t k = last + 1; k-- > 0;) {
    if (k < last) {
      mesh_->curvatures(answer, curvatures_);
      linear_moments(curvatures_, end_.curvatures, moments_);
      for (const SectionKink& kink : kinks_.kinks()) {
        moments_[kink.section] = kink.tangent * curvatures_[kink.section];
      }
      mesh_->bending_forces(moments_, answer);
      mass_solver_->solve(answer);
      ++n_further_solves_;
    }
    for (const SectionKink& kink : kinks_.kinks()) {
      influence_->add_accelerations(kink.section, kink.amount[2 * k + order], answer);
    }
  }
}

double StruckBeam::bound_of_term(std::size_t k) {
  double sum = 0.0;
  for (const SectionKink& kink : kinks_.kinks()) {
    sum += std::abs(kink.amount[2 * k]) * influence_->strength(kink.section);
  }
  for (std::size_t i = 0; i < k; ++i) sum *= highest_frequency_ * highest_frequency_;
  return sum;
}

}  // namespace subimpact
