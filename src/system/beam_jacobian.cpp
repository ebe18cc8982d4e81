#include "system/beam_jacobian.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

std::size_t bandwidth_of(const BeamMesh& mesh, std::span<const LiftingSupport> supports) {
  std::size_t bandwidth = std::max({mesh.mass().half_bandwidth(), mesh.stiffness_bandwidth(),
                                    mesh.struck_point().terms.size() - 1});
  for (const auto& support : supports) bandwidth = std::max(bandwidth, support.half_bandwidth());
  return bandwidth;
}

}  // namespace

BeamJacobian::BeamJacobian(const BeamMesh& mesh, double striker_mass,
                           std::span<const LiftingSupport> supports)
    : mesh_(mesh),
      striker_mass_(striker_mass),
      n_(mesh.n_unknowns()),
      bending_(n_, bandwidth_of(mesh, supports)),
      contact_entries_(1 + supports.size()) {
  std::vector<double> gradient(n_ + 1, 0.0);
  for (const SparseFunctional::Term& term : mesh.struck_point().terms) {
    gradient[term.unknown] = -term.coefficient;
  }
  gradient[n_] = 1.0;
  const auto add = [&](std::size_t i, std::size_t j) {
    const bool of_stop = i == n_ && std::isinf(striker_mass_);
    const double coefficient = of_stop ? 0.0 : gradient[i] * gradient[j];
    if (coefficient != 0.0) contact_entries_[0].push_back({pattern_.n_entries(), coefficient});
    pattern_.rows.push_back(i);
  };
  const auto end_column = [&] { pattern_.column_starts.push_back(pattern_.n_entries()); };
  const std::size_t bandwidth = bending_.half_bandwidth();
  for (std::size_t j = 0; j < n_; ++j) {
    const std::size_t last = std::min(n_ - 1, j + bandwidth);
    for (std::size_t i = j > bandwidth ? j - bandwidth : 0; i <= last; ++i) add(i, j);
    if (gradient[j] != 0.0) add(n_, j);
    end_column();
  }
  for (std::size_t i = 0; i <= n_; ++i) {
    if (gradient[i] != 0.0) add(i, n_);
  }
  end_column();
  for (std::size_t s = 0; s < supports.size(); ++s) {
    for (const auto& a : supports[s].approach.terms) {
      const auto column =
          std::span(pattern_.rows)
              .subspan(pattern_.column_starts[a.unknown],
                       pattern_.column_starts[a.unknown + 1] - pattern_.column_starts[a.unknown]);
      for (const auto& b : supports[s].approach.terms) {
        const auto row = std::ranges::find(column, b.unknown) - column.begin();
        contact_entries_[s + 1].push_back(
            {pattern_.column_starts[a.unknown] + static_cast<std::size_t>(row),
             supports[s].copies * a.coefficient * b.coefficient});
      }
    }
  }
}

// The striker's row and column become zero.
void BeamJacobian::copy_band(const BandedMatrix& band, std::span<double> values) const {
  for (std::size_t j = 0; j <= n_; ++j) {
    for (std::size_t k = pattern_.column_starts[j]; k < pattern_.column_starts[j + 1]; ++k) {
      const std::size_t i = pattern_.rows[k];
      values[k] = i < n_ && j < n_ ? band(i, j) : 0.0;
    }
  }
}

void BeamJacobian::mass_entries(std::span<double> values) const {
  copy_band(mesh_.mass(), values);
  values[pattern_.n_entries() - 1] = std::isinf(striker_mass_) ? 1.0 : striker_mass_;
}

void BeamJacobian::stiffness_entries(std::span<const double> tangents, std::span<double> values,
                                     double tension, const BandedMatrix* form) {
  bending_.set_zero();
  mesh_.add_stiffness(tangents, bending_);
  if (form != nullptr) bending_.add(tension, *form);
  copy_band(bending_, values);
}

void BeamJacobian::add_contact(std::size_t contact, double slope, std::span<double> values) const {
  for (const ContactEntry& entry : contact_entries_[contact]) {
    values[entry.position] += slope * entry.coefficient;
  }
}

}  // namespace subimpact
