// The mass matrix of mixed cells: its solvers, and the kinetic energy.

#include <algorithm>

#include "model/mixed_mesh.h"

namespace subimpact {

BandedMatrix MixedMesh::link_matrix(double inertia) const {
  const std::size_t n = n_kept_cells();
  const auto mobility = [&](std::size_t node) {
    const bool held = node < first_unknown_ || node >= first_unknown_ + n_unknowns();
    return held ? 0.0 : inertia / node_masses_[node];
  };
  BandedMatrix links(n, 1);
  for (std::size_t c = 0; c < n; ++c) {
    double own = 4.0;  // and the link's image beyond an end, odd where the end keeps its slope
    if (c == 0) own += ends_[0] == EndSupport::clamped ? -1.0 : 1.0;
    if (c + 1 == n) own += symmetric() || ends_[1] == EndSupport::clamped ? -1.0 : 1.0;
    links.at(c, c) = own / 6.0 * lengths_[c] + mobility(c) + mobility(c + 1);
    if (c + 1 < n) {
      links.at(c + 1, c) = (lengths_[c] + lengths_[c + 1]) / 12.0 - mobility(c + 1);
    }
  }
  return links;
}

// Solves lumped mass w'' + J G^T psi = f, L psi = G w'' for psi first: with w'' eliminated, both
// matrices being tridiagonal, so is that of psi.
class MixedMesh::Solver final : public MassSolver {
 public:
  explicit Solver(const MixedMesh& mesh)
      : first_(mesh.first_unknown_),
        inertia_(mesh.copies() * mesh.rotary_inertia_),
        links_(mesh.link_matrix(inertia_)),
        inverse_masses_(mesh.node_masses_.size(), 0.0),
        motion_(mesh.node_masses_.size(), 0.0),
        // psi, with a zero before the first link and after the last.
        momenta_(mesh.n_kept_cells() + 2, 0.0) {
    for (std::size_t i = 0; i < mesh.n_unknowns(); ++i) {
      inverse_masses_[i + first_] = 1.0 / mesh.node_masses_[i + first_];
    }
  }

  void solve(std::span<double> x) const override {
    const std::size_t n = x.size();
    const std::size_t n_links = motion_.size() - 1;
    double* f = x.data();
    double* a = motion_.data();
    double* psi = momenta_.data() + 1;
    const double* inverse = inverse_masses_.data() + first_;
    assign_by_lines(a + first_, n, [=](auto at) { return at(f) * at(inverse); });
    assign_by_lines(psi, n_links, [=](auto at) { return at(a + 1) - at(a); });
    links_.solve({psi, n_links});
    const double inertia = inertia_;
    const double* after = psi + first_;
    a += first_;
    assign_by_lines(
        f, n, [=](auto at) { return at(a) - inertia * at(inverse) * (at(after - 1) - at(after)); });
  }

 private:
  std::size_t first_;
  double inertia_;
  BandedSolver links_;
  AlignedVector inverse_masses_;            // of all nodes; zero where held
  mutable AlignedVector motion_, momenta_;  // work space
};

// Solves (lumped mass + a J G^T G) w'' + (1 - a) J G^T psi = f, L psi = G w'' for both: the
// unknowns of nodes and links in turn, with a symmetric matrix of half bandwidth 2. It is not
// definite, but has positive pivots at the nodes and negative ones at the links in any order, so
// that L D L^T exists.
class MixedMesh::SolverOfSharedLinks final : public MassSolver {
 public:
  explicit SolverOfSharedLinks(const MixedMesh& mesh)
      : first_(mesh.first_unknown_),
        factor_(2 * mesh.n_kept_cells() + 1, 2),
        both_(factor_.size()) {
    const double shared = mesh.copies() * mesh.rotary_inertia_ * mesh.share_of_links_;
    const double rest = mesh.copies() * mesh.rotary_inertia_ - shared;
    const BandedMatrix links = mesh.link_matrix(0.0);
    const std::size_t n = mesh.n_kept_cells();
    for (std::size_t i = 0; i <= n; ++i) factor_.at(2 * i, 2 * i) = mesh.node_masses_[i];
    for (std::size_t c = 0; c < n; ++c) {
      const std::size_t at = 2 * c + 1;
      factor_.at(at, at) = -rest * links.at(c, c);
      if (c + 1 < n) factor_.at(at + 2, at) = -rest * links.at(c + 1, c);
      for (const std::size_t node : {at - 1, at + 1}) {
        factor_.at(node, node) += shared * mesh.inverse_lengths_[c];
        factor_.at(node, at) = node < at ? -rest : rest;
      }
      factor_.at(at + 1, at - 1) = -shared * mesh.inverse_lengths_[c];
    }
    for (std::size_t i = 0; i <= n; ++i) {
      if (mesh.node(i).is_zero()) hold(2 * i);
    }
    decompose();
  }

  void solve(std::span<double> x) const override {
    std::ranges::fill(both_, 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) both_[2 * (i + first_)] = x[i];
    const std::size_t n = both_.size();
    for (std::size_t i = 1; i < n; ++i) {
      both_[i] -= factor_.at(i, i - 1) * both_[i - 1];
      if (i > 1) both_[i] -= factor_.at(i, i - 2) * both_[i - 2];
    }
    for (std::size_t i = n; i-- > 0;) {
      both_[i] *= factor_.at(i, i);
      if (i + 1 < n) both_[i] -= factor_.at(i + 1, i) * both_[i + 1];
      if (i + 2 < n) both_[i] -= factor_.at(i + 2, i) * both_[i + 2];
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = both_[2 * (i + first_)];
  }

 private:
  void hold(std::size_t i) {
    for (std::size_t k = i < 2 ? 0 : i - 2; k < std::min(i + 3, factor_.size()); ++k) {
      factor_.at(i, k) = k == i ? 1.0 : 0.0;
    }
  }

  // Multipliers below the diagonal, and on it the inverse pivots.
  void decompose() {
    const std::size_t n = factor_.size();
    for (std::size_t k = 0; k < n; ++k) {
      const double pivot = factor_.at(k, k);
      for (std::size_t i = k + 1; i < std::min(k + 3, n); ++i) {
        for (std::size_t j = k + 1; j <= i; ++j) {
          factor_.at(i, j) -= factor_.at(i, k) * factor_.at(j, k) / pivot;
        }
      }
      for (std::size_t i = k + 1; i < std::min(k + 3, n); ++i) factor_.at(i, k) /= pivot;
      factor_.at(k, k) = 1.0 / pivot;
    }
  }

  std::size_t first_;
  BandedMatrix factor_;
  mutable std::vector<double> both_;  // work space
};

std::unique_ptr<MassSolver> MixedMesh::make_mass_solver() const {
  if (share_of_links_ > 0.0) return std::make_unique<SolverOfSharedLinks>(*this);
  return std::make_unique<Solver>(*this);
}

double MixedMesh::kinetic_energy(std::span<const double> velocities,
                                 std::span<double> scratch) const {
  double twice = 0.0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    twice += mass_.at(i, i) * velocities[i] * velocities[i];
  }
  const double* v = velocities.data();
  for (std::size_t c = 0; c < n_kept_cells(); ++c) {
    scratch[c] = displacement(v, c + 1) - displacement(v, c);
  }
  slopes_->solve(scratch);
  double rotary = 0.0;
  for (std::size_t c = 0; c < n_kept_cells(); ++c) {
    const double turn = displacement(v, c + 1) - displacement(v, c);
    const double of_link = turn * inverse_lengths_[c];
    rotary += ((1.0 - share_of_links_) * scratch[c] + share_of_links_ * of_link) * turn;
  }
  return 0.5 * (twice + copies() * rotary_inertia_ * rotary);
}

}  // namespace subimpact
