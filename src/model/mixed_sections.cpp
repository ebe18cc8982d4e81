#include "model/mixed_sections.h"

#include <algorithm>
#include <utility>

namespace subimpact {
namespace {

constexpr int most_rounds = 40;  // in which flow in some cells brings others to flow

void add(const AlignedVector& terms, double* sum) {
  const double* each = terms.data();
  assign_by_lines(sum, terms.size(), [=](auto at) { return at(sum) + at(each); });
}

}  // namespace

MixedSections::MixedSections(const MixedMesh& mesh, double stiffness, std::optional<SectionLaw> law)
    : mesh_(mesh),
      stiffness_(stiffness),
      yield_curvature_(law ? law->window({}).high : 1.0),
      flow_(law ? std::make_unique<Flow>(mesh, *law) : nullptr),
      elastic_(mesh.n_sections(), 0.0),
      before_(elastic_),
      earlier_(elastic_),
      low_(mesh.n_sections(), -yield_curvature_),
      high_(mesh.n_sections(), yield_curvature_),
      p_(mesh.n_sections(), 0.0),
      shift_(mesh.n_unknowns(), 0.0),
      forces_(shift_),
      scratch_(mesh.n_kept_cells()) {}

bool MixedSections::solve(const double* unknowns, double* moved) {
  mesh_.jumps(unknowns, p_.data(), elastic_.data());
  mesh_.solve_hats(elastic_);
  flowed_ = false;
  if (!flow_) return true;
  flow_->equations.forget();
  is_active_.resize(std::max(is_active_.size(), flow_->cells.n_made()));
  for (const std::size_t index : active_) is_active_[index] = 0;
  active_.clear();
  if (!find_active()) return true;
  for (const std::size_t index : flowing_) activate(index);
  flowed_ = true;
  FlowEquations& equations = flow_->equations;
  for (int round = 0; round < most_rounds; ++round) {
    std::ranges::sort(active_);
    if (!equations.solve(active_, moved != nullptr, {elastic_, before_, earlier_})) return false;
    equations.add_to_moments(1.0, elastic_);
    if (!find_active()) {
      equations.read_moments(elastic_);
      std::ranges::fill(shift_, 0.0);
      equations.add_to_unknowns(shift_.data());
      if (moved != nullptr) add(shift_, moved);
      return true;
    }
    equations.add_to_moments(-1.0, elastic_);  // once more, with the cells that flow too
  }
  return false;
}

// Adds the cells that would flow at the present moments to active_. Returns whether there are any.
bool MixedSections::find_active() {
  const std::size_t n_before = active_.size();
  const double* now = elastic_.data();
  const double* low = low_.data();
  const double* high = high_.data();
  const auto are_outside = [=](std::size_t i) {
    const Lanes here = lanes_at(now + i);
    return (here > lanes_at(high + i)) | (here < lanes_at(low + i));
  };
  const auto is_outside = [=](std::size_t i) { return now[i] > high[i] || now[i] < low[i]; };
  for_each_found(elastic_.size(), are_outside, is_outside, [&](std::size_t i) {
    const std::size_t node = i + mesh_.first_moment();
    for (const std::size_t cell : {node - 1, node}) {
      if (cell >= mesh_.n_kept_cells()) continue;
      const std::size_t index = flow_->cells.make(cell);
      is_active_.resize(std::max(is_active_.size(), index + 1));
      if (is_active_[index] == 0 && flow_->cells.flows(index, moments_at(cell))) activate(index);
    }
  });
  return active_.size() > n_before;
}

void MixedSections::activate(std::size_t index) {
  if (std::exchange(is_active_[index], 1) == 0) active_.push_back(index);
}

// In M_y; zero at an end without a moment.
SubCellSections::Ends MixedSections::moments_at(std::size_t cell) const {
  const auto at = [&](std::size_t node) {
    const std::size_t section = node - mesh_.first_moment();
    return section < elastic_.size() ? elastic_[section] / yield_curvature_ : 0.0;
  };
  return {at(cell), at(cell + 1)};
}

// By the mean of the forces at both ends of the step.
void MixedSections::add_work_on_shift(double contact_force) {
  const double* now = elastic_.data();
  const double* before = before_.data();
  assign_by_lines(earlier_.data(), earlier_.size(),
                  [=](auto at) { return 0.5 * (at(before) + at(now)); });
  mesh_.forces_of(earlier_.data(), stiffness_, forces_.data());
  forces_[mesh_.struck_node() - mesh_.first_unknown()] += 0.5 * (force_before_ + contact_force);
  work_on_shift_ += dot(forces_.data(), shift_.data(), shift_.size());
}

bool MixedSections::commit(double contact_force) {
  if (flowed_) add_work_on_shift(contact_force);
  force_before_ = contact_force;
  earlier_.swap(before_);
  std::ranges::copy(elastic_, before_.begin());
  flowing_.clear();
  if (!flow_) return false;
  if (!flowed_) {
    flow_->equations.commit_rest();
    return false;
  }
  flow_->equations.add_to_p(p_);
  flow_->equations.commit(flowing_);
  for (const std::size_t index : flowing_) narrow_windows(flow_->cells.cell_of(index));
  flow_->equations.forget();
  flowed_ = false;
  return true;
}

void MixedSections::exchange(Snapshot& snapshot) {
  for (AlignedVector* list : {&before_, &earlier_, &low_, &high_, &p_}) {
    snapshot(*list);
    snapshot.require(list->size() == mesh_.n_sections());
  }
  snapshot(force_before_, work_on_shift_, flowing_);
  if (snapshot.reads()) elastic_ = before_;
  if (flow_) snapshot(flow_->cells, flow_->equations);
  snapshot.require(std::ranges::all_of(
      flowing_, [&](std::size_t index) { return index < flow_->cells.n_made(); }));
}

void MixedSections::resting_forces(std::span<const double> unknowns, std::span<double> forces) {
  mesh_.jumps(unknowns.data(), p_.data(), elastic_.data());
  mesh_.solve_hats(elastic_);
  mesh_.forces_of(elastic_.data(), stiffness_, forces.data());
}

std::size_t MixedSections::rest_at(std::span<const double> unknowns) {
  resting_forces(unknowns, forces_);
  std::size_t i = 0;
  while (i < elastic_.size() && elastic_[i] >= low_[i] && elastic_[i] <= high_[i]) ++i;
  work_on_shift_ = 0.0;
  flowed_ = false;
  commit(0.0);
  before_ = earlier_ = elastic_;
  return i;
}

// Narrows the windows at the nodes of a cell whose sections have flowed: nothing flows next to a
// node while its moment lies within the windows of both neighbouring cells.
void MixedSections::narrow_windows(std::size_t cell) {
  for (const std::size_t node : {cell, cell + 1}) {
    const std::size_t section = node - mesh_.first_moment();
    if (section >= elastic_.size()) continue;
    SubCellSections::Window both{-MomentLaw::limit, MomentLaw::limit};
    for (const std::size_t beside : {node - 1, node}) {
      if (beside >= mesh_.n_kept_cells()) continue;
      const std::size_t index = flow_->cells.find(beside);
      SubCellSections::Window window;
      if (index != SubCellSections::none) window = flow_->cells.window(index);
      both = {std::max(both.low, window.low), std::min(both.high, window.high)};
    }
    low_[section] = both.low * yield_curvature_;
    high_[section] = both.high * yield_curvature_;
  }
}

BendingEnergies MixedSections::energies() const {
  BendingEnergies sum, all;
  const std::size_t n = elastic_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t node = i + mesh_.first_moment();
    const double before = node > 0 ? mesh_.cell_length(node - 1) : 0.0;
    const double after = node < mesh_.n_kept_cells() ? mesh_.cell_length(node) : 0.0;
    const double next = i + 1 < n ? elastic_[i + 1] : 0.0;
    sum.elastic += elastic_[i] * (elastic_[i] * (before + after) + next * after) / 3.0;
  }
  sum.elastic *= 0.5 * stiffness_;
  if (flow_) {
    for (std::size_t index = 0; index < flow_->cells.n_made(); ++index) {
      sum.add(1.0, flow_->cells.energies_at_rest(index));
    }
    for (std::size_t k = 0; flowed_ && k < active_.size(); ++k) {
      BendingEnergies more =
          flow_->cells.energies(active_[k], moments_at(flow_->cells.cell_of(active_[k])));
      more.add(-1.0, flow_->cells.energies_at_rest(active_[k]));
      sum.add(1.0, more);
    }
    const double unit = stiffness_ * yield_curvature_ * yield_curvature_;
    sum.plastic += unit * flow_->equations.hinge_work();
  }
  all.add(mesh_.copies_of_part(), sum);
  return all;
}

void MixedSections::read_bending(std::span<double> curvatures, std::span<double> moments) const {
  std::ranges::copy(p_, curvatures.begin());
  if (flowed_) flow_->equations.add_to_p(curvatures);
  for (std::size_t i = 0; i < elastic_.size(); ++i) {
    curvatures[i] =
        elastic_[i] + mesh_.copies_of_part() * curvatures[i] / mesh_.section_weights()[i];
    moments[i] = stiffness_ * elastic_[i];
  }
}

double MixedSections::outer_stress_at_strike(double outer_stiffness) const {
  const std::size_t cell = mesh_.struck_node() - 1;
  const std::size_t index = flow_ ? flow_->cells.find(cell) : SubCellSections::none;
  if (index == SubCellSections::none) return -outer_stiffness * elastic_[mesh_.struck_section()];
  return flow_->cells.outer_stress(index, moments_at(cell));
}

std::size_t MixedSections::n_yielded() const {
  return static_cast<std::size_t>(std::ranges::count_if(p_, [](double p) { return p != 0.0; }));
}

}  // namespace subimpact
