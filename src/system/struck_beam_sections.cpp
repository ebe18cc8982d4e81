// What sections do within a step of the struck beam beyond the smooth pieces of their laws.

#include <algorithm>
#include <cmath>

#include "system/struck_beam.h"

namespace subimpact {
namespace {

// A step that must be cut ends after the kink that spoils it, by this part of what is estimated to
// be tolerable. The estimate grows as the sixth to seventh power of the time since the kink.
constexpr double cut_safety = 0.8;
constexpr double cut_exponent = 0.15;

}  // namespace

double StruckBeam::find_section_kinks(const StepEnds& step, double tolerance) {
  kinks_.clear();
  if (step.eventless || section_evaluation_ != Evaluation::smooth || !sections_.can_yield()) {
    return step.t1;
  }
  read_motion(step.y1, end_);
  if (!kinks_.suspect(sections_, start_, end_, step.length())) return step.t1;
  if (kinks_.cut()) return step.t0 + *kinks_.cut() * step.length();
  read_higher_rates(step.y0, start_);
  read_higher_rates(step.y1, end_);
  kinks_.find(sections_, start_, end_, step.t0, step.t1);
  if (kinks_.kinks().empty()) return step.t1;

  answer_to_kinks(0, velocity_change_);
  answer_to_kinks(1, position_change_);
  const double last_term = add_stiffness_term(2, velocity_change_);
  add_stiffness_term(3, position_change_);
  const auto worst = std::max_element(kinks_.kinks().begin(), kinks_.kinks().end(),
                                      [](const SectionKink& a, const SectionKink& b) {
                                        return std::abs(a.amount[2]) < std::abs(b.amount[2]);
                                      });
  const double since = step.t1 - worst->start;
  const double angle = highest_frequency_ * since;
  const double next_term = last_term * angle * angle / 30.0;
  if (next_term <= tolerance) return step.t1;
  const double tolerable = since * std::pow(tolerance / next_term, cut_exponent);
  return std::max(worst->start, step.t0) + cut_safety * tolerable;
}

void StruckBeam::put_right(State& y) {
  if (kinks_.kinks().empty()) return;
  for (std::size_t i = 0; i < n_; ++i) {
    y[i] += position_change_[i];
    y[n_ + 1 + i] += velocity_change_[i];
  }
  for (const SectionKink& kink : kinks_.kinks()) {
    if (kink.turn) sections_.commit_turn(kink.section, kink.turn->curvature);
  }
}

void StruckBeam::read_higher_rates(const State& y, SectionMotion& at) {
  acceleration({y.data(), n_ + 1}, trial_);
  const std::span<double> rates{trial_.data(), n_};
  mesh_->curvatures(rates, at.second);
  linear_moments(at.rates, at.curvatures);
  mesh_->bending_forces(moments_, rates);
  if (in_contact()) {
    mesh_->struck_point().add_to(rates, force_slope(indentation(y)) * indentation_rate(y));
  }
  mass_solver_->solve(rates);
  ++n_further_solves_;
  mesh_->curvatures(rates, at.third);
}

void StruckBeam::linear_moments(std::span<const double> changes,
                                std::span<const double> curvatures) {
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    moments_[i] = sections_.stiffness() * changes[i];
  }
  for (const SectionField::Flow& flow : sections_.flowing()) {
    const std::size_t i = flow.section;
    moments_[i] = sections_.law().tangent_on(flow.branch, curvatures[i]) * changes[i];
  }
}

void StruckBeam::answer_to_kinks(std::size_t order, std::vector<double>& answer) {
  std::fill(moments_.begin(), moments_.end(), 0.0);
  for (const SectionKink& kink : kinks_.kinks()) moments_[kink.section] = kink.amount[order];
  mesh_->bending_forces(moments_, answer);
  mass_solver_->solve(answer);
  ++n_further_solves_;
}

double StruckBeam::add_stiffness_term(std::size_t order, std::vector<double>& change) {
  answer_to_kinks(order, answer_);
  mesh_->curvatures(answer_, curvatures_);
  linear_moments(curvatures_, end_.curvatures);
  for (const SectionKink& kink : kinks_.kinks()) {
    moments_[kink.section] = kink.tangent * curvatures_[kink.section];
  }
  mesh_->bending_forces(moments_, answer_);
  mass_solver_->solve(answer_);
  ++n_further_solves_;
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    change[i] += answer_[i];
    sum += answer_[i] * answer_[i];
  }
  return std::sqrt(sum / static_cast<double>(n_));
}

}  // namespace subimpact
