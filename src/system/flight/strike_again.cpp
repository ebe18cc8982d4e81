#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/mesh/modes.h"
#include "numerics/bracketed_root.h"
#include "numerics/lanes.h"
#include "system/readings/accounts.h"
#include "system/struck_beam.h"

namespace subimpact {
namespace {

// Added restoring force as a share of the beam's own in its first mode; it also holds a free beam.
constexpr double share_of_mass = 1e-2;
constexpr int most_iterations = 120;
constexpr int until_residual = 15;     // iterations until the residual is computed anew
constexpr double least_power = 1e-22;  // of the residual forces, relative to those at first
constexpr double rounding = 1e-9;      // of the curvatures between which a section stays elastic
// What K loses to rounding as a matrix is regained from the forces of the sections.
constexpr int n_refinements = 3;
constexpr int most_sets = 100;  // of supports on which a beam lies

}  // namespace

std::shared_ptr<const EndState> StruckBeam::end_state(const State& y) const {
  EndState end{y, contact_.history(), sections_, tension_};
  if (const auto* modes = dynamic_cast<const ModalMesh*>(mesh_.get())) {
    for (const std::size_t first : {std::size_t{0}, n_ + 1}) {
      modes->to_physical(std::span(y).subspan(first, n_), std::span(end.motion).subspan(first, n_));
    }
  }
  return std::make_shared<const EndState>(std::move(end));
}

void StruckBeam::begin_strike(const EndState& end, bool at_rest, double first_frequency) {
  if (end.motion.size() != 2 * n_positions() || end.sections.size() != sections_.size()) {
    throw std::invalid_argument("is not that of the strike before");
  }
  State y = end.motion;
  if (const auto* modes = dynamic_cast<const ModalMesh*>(mesh_.get())) {
    for (const std::size_t first : {std::size_t{0}, n_ + 1}) {
      modes->to_modal(std::span(end.motion).subspan(first, n_), std::span(y).subspan(first, n_));
    }
  }
  sections_ = end.sections;
  tension_ = end.tension;
  contact_.set(ContactBranch::separated, end.contact);
  if (at_rest) {
    std::ranges::fill(y, 0.0);
    come_to_rest(std::span(y).first(n_), first_frequency);
  }
  y[n_] = mesh_->struck_point()(beam_positions(y)) + contact_.residual_indentation();
  while (indentation(y) < contact_.residual_indentation()) y[n_] = std::nextafter(y[n_], HUGE_VAL);
  y.back() = striker_velocity_;
  if (!(indentation_rate(y) > 0.0)) {
    throw std::domain_error(
        fmt::format("the struck point moves at {:.6g} m/s, which the striker does not reach at "
                    "{:.6g} m/s",
                    y.back() - indentation_rate(y), y.back()));
  }
  start_ = y;
  losses_ = {};
  spent_ = {};
  const Energies before = Accounts(*this).energies(y);
  spent_ = {before.bending_plastic, before.contact_plastic};
}

std::optional<std::vector<double>> StruckBeam::equilibrium() const {
  if (!modal_stiffness_.empty()) {
    std::vector<double> q(n_, 0.0);
    if (std::ranges::count(modal_stiffness_, 0.0) > 0) return std::nullopt;
    loads_.add_to(q, loads_.start());
    for (std::size_t k = 0; k < n_; ++k) q[k] /= modal_stiffness_[k];
    return q;
  }
  if (!tension_) return equilibrium(0.0);
  const auto straight = equilibrium(0.0);
  if (!straight) return std::nullopt;
  // The larger the tension, the less of it the deflection makes.
  const auto excess = [&](double tension) { return tension_->at(*equilibrium(tension)) - tension; };
  const double most = tension_->at(*straight);
  return equilibrium(most > 0.0 ? root_in(excess, 0.0, most) : 0.0);
}

// From the supports that a straight beam touches, else from all: sets that follow from each other
// end at the one that holds.
std::optional<std::vector<double>> StruckBeam::equilibrium(double tension) const {
  const std::vector<double> straight(n_, 0.0);
  for (const bool from_all : {false, true}) {
    std::vector<bool> lies_on;
    for (const LiftingSupport& support : supports_) {
      lies_on.push_back(from_all || support.indentation(straight) >= 0.0);
    }
    for (int i = 0; i < most_sets; ++i) {
      auto q = equilibrium(tension, lies_on);
      if (!q) break;
      std::vector<bool> next;
      for (const LiftingSupport& support : supports_) next.push_back(support.indentation(*q) > 0.0);
      if (next == lies_on) return q;
      lies_on = std::move(next);
    }
  }
  return std::nullopt;
}

std::optional<std::vector<double>> StruckBeam::equilibrium(double tension,
                                                           const std::vector<bool>& lies_on) const {
  std::vector<double> q(n_, 0.0), rest(n_), kappa(mesh_->n_sections());
  const double stiffness = sections_.stiffness();
  std::size_t bandwidth = mesh_->stiffness_bandwidth();
  for (const auto& support : supports_) bandwidth = std::max(bandwidth, support.half_bandwidth());
  BandedMatrix matrix(n_, bandwidth), pull = matrix;
  if (tension > 0.0) pull.add(tension, tension_->form());
  for (std::size_t k = 0; k < supports_.size(); ++k) {
    const double of_support = supports_[k].copies * supports_[k].stiffness();
    if (lies_on[k]) supports_[k].approach.add_square(of_support, pull);
  }
  mesh_->add_stiffness(std::vector<double>(mesh_->n_sections(), stiffness), matrix);
  matrix.add(1.0, pull);
  const auto factor = matrix.cholesky_factor();
  if (!factor) return std::nullopt;
  for (int i = 0; i <= n_refinements; ++i) {
    mesh_->curvatures(q, kappa);
    for (double& k : kappa) k *= stiffness;
    mesh_->internal_forces(q, kappa, rest);
    pull.subtract_product(q, rest);
    for (std::size_t k = 0; k < supports_.size(); ++k) {
      const LiftingSupport& support = supports_[k];
      const double reach = support.copies * support.stiffness() * support.gap;
      if (lies_on[k]) support.approach.add_to(rest, reach);
    }
    loads_.add_to(rest, loads_.start());
    factor->solve_as_factor(rest);
    for (std::size_t k = 0; k < n_; ++k) q[k] += rest[k];
  }
  return q;
}

// Forces that nothing but flow would change, f - A w: at rest they vanish, and the elastic energy
// is the least. By conjugate gradients with the stiffness of the beam while nothing flows and some
// mass, which holds a free beam where its mean displacement and rotation are zero.
void StruckBeam::come_to_rest(std::span<double> w, double first_frequency) {
  if (!sections_.can_yield()) return;
  if (tension_) {
    throw std::domain_error(
        "beam.axial = \"held\": the shape in which a beam with a tension rests is not computed");
  }
  const Evaluation as_set = section_evaluation_;
  section_evaluation_ = Evaluation::smooth;
  sections_.stop_flow();
  BandedMatrix near = elastic_stiffness(*mesh_, sections_.stiffness());
  near.add(share_of_mass * first_frequency * first_frequency, mesh_->mass());
  const std::optional<BandedMatrix> factor = near.cholesky_factor();
  std::vector<double> constant(n_), residual(n_), solved, direction(n_, 0.0), change(n_);
  std::ranges::fill(w, 0.0);
  bend(w, constant);
  double before = 0.0, first = 0.0;
  for (int k = 0; factor && k < most_iterations; ++k) {
    const bool anew = k % until_residual == 0;
    if (anew) bend(w, residual);
    solved = residual;
    factor->solve_as_factor(solved);
    const double power = dot(residual.data(), solved.data(), n_);
    first = std::max(first, power);
    if (!(power > least_power * first)) break;
    const double part = anew ? 0.0 : power / before;
    before = power;
    for (std::size_t i = 0; i < n_; ++i) direction[i] = solved[i] + part * direction[i];
    bend(direction, change);
    for (std::size_t i = 0; i < n_; ++i) change[i] -= constant[i];
    const double length = -power / dot(direction.data(), change.data(), n_);
    for (std::size_t i = 0; i < n_; ++i) {
      w[i] += length * direction[i];
      residual[i] += length * change[i];
    }
  }
  section_evaluation_ = as_set;
  mesh_->curvatures(w, curvatures_);
  const auto low = sections_.window_low(), high = sections_.window_high();
  const auto holds = [&](std::size_t k) {
    const double margin = rounding * (high[k] - low[k]);
    return curvatures_[k] > low[k] - margin && curvatures_[k] < high[k] + margin;
  };
  std::size_t i = 0;
  while (i < sections_.size() && holds(i)) ++i;
  if (i == sections_.size()) return;
  throw std::domain_error(
      fmt::format("at rest the moment left at x = {:.6g} m would make the section yield again",
                  mesh_->section_positions()[i]));
}

}  // namespace subimpact
