#include "model/sub_cell_sections.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/gauss.h"

namespace subimpact {
namespace {

// Mean, over the hat of a node, of the bubble that a curvature at a point leaves, over h^2.
double bubble_at(double hat) { return (hat - hat * hat * hat) / 6.0; }

constexpr double short_step = 0.1;  // of the distance to the full plastic moment

// Rounding may touch the full plastic moment.
double short_of_limit(double moment) {
  constexpr double largest = MomentLaw::limit * (1.0 - 1e-15);
  return std::clamp(moment, -largest, largest);
}

}  // namespace

SubCellSections::SubCellSections(const MixedMesh& mesh, SectionLaw law)
    : mesh_(mesh),
      law_(std::move(law)),
      yield_curvature_(law_.window({}).high),
      index_of_(mesh.n_kept_cells(), none) {}

void SubCellSections::add(double at, double weight, double length) {
  Section section{{}, {1.0 - at, at}, {}, {}};
  for (std::size_t k = 0; k < 2; ++k) {
    section.weight[k] = length * weight * section.hat[k];
    section.bubble[k] = length * weight * bubble_at(section.hat[k]);
  }
  sections_.push_back(section);
}

std::size_t SubCellSections::make(std::size_t cell) {
  if (index_of_[cell] != none) return index_of_[cell];
  const std::size_t first = sections_.size();
  const double length = mesh_.cell_length(cell);
  const bool cusp_before = mesh_.may_hinge(cell);
  if (cusp_before || mesh_.may_hinge(cell + 1)) {
    for (std::size_t k = 0; k < 5; ++k) {
      const double t = gauss<5>.points[k];  // t^2 from the cusp
      add(cusp_before ? t * t : 1.0 - t * t, 2.0 * t * gauss<5>.weights[k], length);
    }
  } else {
    for (std::size_t k = 0; k < 2; ++k) add(gauss<2>.points[k], gauss<2>.weights[k], length);
  }
  index_of_[cell] = cells_.size();
  cells_.push_back({cell, first, sections_.size(), {}, {}});
  return index_of_[cell];
}

bool SubCellSections::flows(std::size_t index, const Ends& moments) const {
  return std::ranges::any_of(sections_of(index), [&](const Section& section) {
    const double m = section.moment(moments);
    return m > section.law.high() || m < section.law.low();
  });
}

bool SubCellSections::is_inside(std::size_t index, const Ends& moments) const {
  return std::ranges::all_of(sections_of(index), [&](const Section& section) {
    return std::abs(section.moment(moments)) < MomentLaw::limit;
  });
}

// The step is taken in the curvature, in which the law is nearly linear: of the virgin curve, which
// has the sharpest bend.
double SubCellSections::part_of_step(double moment, double step) {
  const double left = MomentLaw::limit - std::copysign(moment, moment * step);
  const double size = std::abs(step);
  if (size < short_step * left) return 1.0;
  const bool is_elastic = left > 0.5;
  const double x = is_elastic ? MomentLaw::limit - left : 1.0 / std::sqrt(2.0 * left);
  const double reached = x + size * (is_elastic ? 1.0 : x * x * x);
  const double left_then = reached <= 1.0 ? MomentLaw::limit - reached : 0.5 / (reached * reached);
  return (left - left_then) / size;
}

double SubCellSections::part_of_step(std::size_t index, const Ends& moments,
                                     const Ends& step) const {
  double part = 1.0;
  for (const Section& section : sections_of(index)) {
    part = std::min(part, part_of_step(section.moment(moments), section.moment(step)));
  }
  return part;
}

SubCellSections::Flow SubCellSections::flow(std::size_t index, const Ends& moments) const {
  Flow sum;
  for (const Section& section : sections_of(index)) {
    const MomentLaw::Flow at = section.law.at(section.moment(moments));
    if (at.slope == 0.0) continue;
    const double flowed = at.plastic - section.law.plastic();
    for (std::size_t k = 0; k < 2; ++k) {
      sum.p[k] += section.weight[k] * flowed;
      sum.b[k] += section.bubble[k] * flowed;
      for (std::size_t l = 0; l < 2; ++l) {
        sum.p_slope[k][l] += section.weight[k] * at.slope * section.hat[l];
        sum.b_slope[k][l] += section.bubble[k] * at.slope * section.hat[l];
      }
    }
  }
  return sum;
}

bool SubCellSections::commit(std::size_t index, const Ends& moments) {
  Cell& cell = cells_[index];
  bool flowed = false;
  for (std::size_t i = cell.first; i < cell.end; ++i) {
    Section& section = sections_[i];
    flowed |= section.law.commit(section.moment(moments), law_, yield_curvature_);
  }
  if (!flowed) return false;
  cell.at_rest.reset();
  cell.window = {-MomentLaw::limit, MomentLaw::limit};
  for (const Section& section : sections_of(index)) {
    cell.window.low = std::max(cell.window.low, section.law.low());
    cell.window.high = std::min(cell.window.high, section.law.high());
  }
  return true;
}

void SubCellSections::exchange(Snapshot& snapshot) {
  std::vector<std::size_t> made;
  for (const Cell& cell : cells_) made.push_back(cell.cell);
  snapshot(made);
  snapshot.require(std::ranges::all_of(made, [&](auto i) { return i < index_of_.size(); }));
  for (const std::size_t cell : made) make(cell);
  for (Section& section : sections_) snapshot(section.law);
  for (Cell& cell : cells_) snapshot(cell.window.low, cell.window.high);
}

double SubCellSections::curvature(const Section& section, double moment) const {
  return (moment + section.law.at(moment).plastic) * yield_curvature_;
}

BendingEnergies SubCellSections::energies(const Section& section, double m) const {
  const double kappa = curvature(section, m);
  reached_ = section.law.history(law_, yield_curvature_);
  law_.commit(reached_, kappa);
  const double elastic = law_.elastic_energy(reached_, kappa);
  const double of_moment = 0.5 * law_.stiffness() * yield_curvature_ * yield_curvature_ * m * m;
  const double weight = section.weight[0] + section.weight[1];
  return {weight * (elastic - of_moment), weight * (law_.work(reached_, kappa) - elastic)};
}

BendingEnergies SubCellSections::energies(std::size_t index, const Ends& moments) const {
  BendingEnergies sum;
  for (const Section& section : sections_of(index)) {
    sum.add(1.0, energies(section, short_of_limit(section.moment(moments))));
  }
  return sum;
}

const BendingEnergies& SubCellSections::energies_at_rest(std::size_t index) const {
  const Cell& cell = cells_[index];
  if (cell.at_rest) return *cell.at_rest;
  BendingEnergies& sum = cell.at_rest.emplace();
  for (const Section& section : sections_of(index)) {
    sum.add(1.0, energies(section, 0.5 * (section.law.low() + section.law.high())));
  }
  return sum;
}

double SubCellSections::outer_stress(std::size_t index, const Ends& moments) const {
  const auto sections = sections_of(index);
  const Section& nearest =
      *std::ranges::max_element(sections, {}, [](const Section& at) { return at.hat[1]; });
  const double m = short_of_limit(nearest.moment(moments));
  return law_.outer_stress(nearest.law.history(law_, yield_curvature_), curvature(nearest, m));
}

}  // namespace subimpact
