#include "model/mixed_mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace subimpact {
namespace {

// Gregory's weights at an end: the trapezoid's with corrections up to the third difference.
constexpr std::array gregory{251.0 / 720.0, 299.0 / 240.0, 211.0 / 240.0, 739.0 / 720.0};

Eigen::Index as_index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

std::size_t MixedMesh::cells_before(double position, std::size_t n_cells) {
  return static_cast<std::size_t>(std::lround(position * static_cast<double>(n_cells)));
}

double MixedMesh::natural_step_of(const Beam& beam, double position, std::size_t n_cells) {
  const std::size_t before = cells_before(position, n_cells);
  const double shortest = std::min(position / static_cast<double>(before),
                                   (1.0 - position) / static_cast<double>(n_cells - before));
  return beam.length * shortest / std::sqrt(beam.youngs_modulus / beam.density);
}

MixedMesh::MixedMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent,
                     double step_ratio)
    : BeamMesh((extent == Extent::half ? n_cells / 2 : n_cells) + 1 -
                   (beam.ends[0] != EndSupport::free ? 1 : 0) -
                   (extent == Extent::whole && beam.ends[1] != EndSupport::free ? 1 : 0),
               1, extent == Extent::half),
      n_cells_(n_cells),
      ends_(beam.ends),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()),
      share_of_links_(0.5 * (1.0 - step_ratio * step_ratio)),
      step_(natural_step_of(beam, position, n_cells)),
      struck_node_(cells_before(position, n_cells)),
      first_unknown_(ends_[0] != EndSupport::free ? 1 : 0),
      first_moment_(ends_[0] != EndSupport::clamped ? 1 : 0) {
  if (n_cells < fewest_cells || struck_node_ < fewest_beside ||
      n_cells - struck_node_ < fewest_beside) {
    throw std::invalid_argument("mixed mesh: at least 8 cells are needed on each side of a strike");
  }
  if (symmetric() && (n_cells % 2 != 0 || position != 0.5 || ends_[0] != ends_[1])) {
    throw std::invalid_argument(
        "mixed mesh: a half model needs an even number of cells, struck at 0.5, and ends alike");
  }
  if (!(rotary_inertia_ > 0.0)) {
    throw std::invalid_argument("mixed mesh: the beam must have rotary inertia");
  }
  if (!(step_ratio >= 0.0 && step_ratio <= 1.0)) {
    throw std::invalid_argument("mixed mesh: steps must not be longer than the natural step");
  }
  place_nodes(beam.length, position);
  struck_point_.terms = {{struck_node_ - first_unknown_, 1.0}};
  if (ends_[0] == EndSupport::free) first_end_.terms = {{0, 1.0}};
  if (beam.is_free()) translation_.assign(n_unknowns(), 1.0);
  beam_mass_ = beam.mass();
  weigh_nodes();
  assemble_hats();
  slopes_ = std::make_unique<const BandedSolver>(link_matrix(0.0));
  assemble_functionals();
}

bool MixedMesh::is_clamped(std::size_t node) const {
  if (node == 0) return ends_[0] == EndSupport::clamped;
  return !symmetric() && node == n_kept_cells() && ends_[1] == EndSupport::clamped;
}

void MixedMesh::place_nodes(double length, double position) {
  const std::size_t kept = symmetric() ? n_cells_ / 2 : n_cells_;
  const double struck = position * length;
  const double before = struck / static_cast<double>(struck_node_);
  const double after = (length - struck) / static_cast<double>(n_cells_ - struck_node_);
  for (std::size_t i = 0; i <= kept; ++i) {
    const bool is_before = i < struck_node_;
    node_positions_.push_back(is_before ? static_cast<double>(i) * before
                                        : length - static_cast<double>(n_cells_ - i) * after);
    if (i == kept) break;
    lengths_.push_back(is_before ? before : after);
    inverse_lengths_.push_back(1.0 / lengths_.back());
  }
}

void MixedMesh::weigh_nodes() {
  const std::size_t last = n_kept_cells();
  std::vector<double> factors(last + 1, 1.0);
  for (std::size_t k = 0; k < gregory.size(); ++k) {
    if (ends_[0] == EndSupport::free) factors[k] = gregory[k];
    if (!symmetric() && ends_[1] == EndSupport::free) factors[last - k] = gregory[k];
  }
  node_masses_.resize(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const double before = i > 0 ? lengths_[i - 1] : 0.0;
    const double after = i < last ? lengths_[i] : 0.0;
    // At an end the weights are those of a whole cell; the mirrored half doubles that of mid-span.
    const bool at_free_end = (i == 0 && ends_[0] == EndSupport::free) ||
                             (i == last && !symmetric() && ends_[1] == EndSupport::free);
    const double width = at_free_end ? before + after : 0.5 * (before + after);
    node_masses_[i] = copies() * mass_per_length_ * factors[i] * width;
  }
  for (std::size_t i = 0; i < n_unknowns(); ++i) {
    mass_.at(i, i) = node_masses_[i + first_unknown_];
  }
}

void MixedMesh::assemble_hats() {
  const std::size_t last = n_kept_cells();
  const bool last_has_moment = symmetric() || ends_[1] == EndSupport::clamped;
  const std::size_t n = last + (last_has_moment ? 1 : 0) - first_moment_;
  BandedMatrix hats(n, 1);
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t i = j + first_moment_;
    const double before = i > 0 ? lengths_[i - 1] : 0.0;
    const double after = i < last ? lengths_[i] : 0.0;
    hats.at(j, j) = (before + after) / 3.0;
    if (j + 1 < n) hats.at(j + 1, j) = after / 6.0;
    positions_.push_back(node_positions_[i]);
    weights_.push_back(copies() * 0.5 * (before + after));
  }
  hats_ = std::make_unique<const BandedSolver>(hats);
  struck_section_ = struck_node_ - first_moment_;
}

SparseFunctional MixedMesh::node(std::size_t i) const {
  if (i < first_unknown_ || i >= first_unknown_ + n_unknowns()) return {};
  return {{{i - first_unknown_, 1.0}}, {}};
}

void MixedMesh::assemble_functionals() {
  momentum_functional_.resize(n_unknowns());
  for (std::size_t i = 0; i < n_unknowns(); ++i) momentum_functional_[i] = mass_.at(i, i);
  if (symmetric()) return;
  std::vector<double> momenta(lengths_.begin(), lengths_.end());  // psi of a slope of 1
  slopes_->solve(momenta);
  for (double& each : momenta) each = (1.0 - share_of_links_) * each + share_of_links_;
  moment_functional_.resize(n_unknowns());
  for (std::size_t i = 0; i < n_unknowns(); ++i) {
    const std::size_t at = i + first_unknown_;
    const double before = at > 0 ? momenta[at - 1] : 0.0;
    const double after = at < n_kept_cells() ? momenta[at] : 0.0;
    moment_functional_[i] =
        node_masses_[at] * node_positions_[at] + rotary_inertia_ * (before - after);
  }
}

double MixedMesh::displacement(const double* unknowns, std::size_t node) const {
  const bool held = node < first_unknown_ || node >= first_unknown_ + n_unknowns();
  return held ? 0.0 : unknowns[node - first_unknown_];
}

std::vector<MixedMesh::RigidMotion> MixedMesh::rigid_motions() const {
  std::vector<RigidMotion> motions;
  const bool turns_about_first = ends_[0] == EndSupport::pinned && ends_[1] == EndSupport::free;
  const bool turns_about_last = ends_[0] == EndSupport::free && ends_[1] == EndSupport::pinned;
  const bool is_free = ends_[0] == EndSupport::free && ends_[1] == EndSupport::free;
  const auto include = [&](double about, double slope) {
    RigidMotion motion{std::vector<double>(n_unknowns()), std::vector<double>(n_unknowns())};
    for (std::size_t i = 0; i < n_unknowns(); ++i) {
      motion.shape[i] = slope * node_positions_[i + first_unknown_] - about;
      motion.inertia[i] = -about * momentum_functional_[i];
      if (slope != 0.0) motion.inertia[i] += slope * moment_functional_[i];
    }
    const double square = dot(motion.shape.data(), motion.inertia.data(), n_unknowns());
    for (auto* each : {&motion.shape, &motion.inertia}) {
      for (double& value : *each) value /= std::sqrt(square);
    }
    motions.push_back(std::move(motion));
  };
  if (is_free) include(-1.0, 0.0);
  if (symmetric()) return motions;
  if (is_free) {
    // About the middle of the beam's mass, where translation does not turn it.
    const double moment =
        std::accumulate(moment_functional_.begin(), moment_functional_.end(), 0.0);
    include(moment / std::accumulate(momentum_functional_.begin(), momentum_functional_.end(), 0.0),
            1.0);
  }
  if (turns_about_first) include(0.0, 1.0);
  if (turns_about_last) include(node_positions_.back(), 1.0);
  return motions;
}

double MixedMesh::product(std::span<const double> a, std::span<const double> b) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < n_kept_cells(); ++c) {
    sum +=
        lengths_[c] / 6.0 * (a[c] * (2.0 * b[c] + b[c + 1]) + a[c + 1] * (b[c] + 2.0 * b[c + 1]));
  }
  return copies() * sum;
}

double MixedMesh::square_of(std::span<const double> moments) const {
  std::vector<double> all(node_positions_.size(), 0.0);
  std::ranges::copy(moments, all.begin() + static_cast<std::ptrdiff_t>(first_moment_));
  return product(all, all);
}

// From node to node by equilibrium; the supports then fix what is linear in x, or leave it free.
std::vector<double> MixedMesh::moments_under(std::span<const double> forces) const {
  const std::size_t last = n_kept_cells();
  const double length = node_positions_.back();
  const EndSupport end = symmetric() ? EndSupport::free : ends_[1];  // as mid-span has no shear
  const auto force = [&](std::size_t i) {
    return node(i).is_zero() ? 0.0 : forces[i - first_unknown_] / copies();
  };
  std::vector<double> m(last + 1, 0.0), line(last + 1);
  double shear = 0.0;
  for (std::size_t c = 0; c < last; ++c) {
    shear += force(c);
    m[c + 1] = m[c] + shear * lengths_[c];
  }
  shear += force(last);
  const auto add = [&](double amount, double at_start, double slope) {
    for (std::size_t i = 0; i <= last; ++i)
      m[i] += amount * (at_start + slope * node_positions_[i]);
  };
  const auto relax = [&](double at_start, double slope) {
    for (std::size_t i = 0; i <= last; ++i) line[i] = at_start + slope * node_positions_[i];
    add(-product(m, line) / product(line, line), at_start, slope);
  };
  const bool clamped = ends_[0] == EndSupport::clamped;
  if (ends_[0] != EndSupport::free) {
    if (end == EndSupport::free) add(-shear, 0.0, 1.0);
    if (end == EndSupport::pinned) add(-m[last] / length, 0.0, 1.0);
    if (end == EndSupport::free && clamped && !symmetric()) add(-m[last], 1.0, 0.0);
    if (end == EndSupport::free && clamped && symmetric()) relax(1.0, 0.0);
    if (end == EndSupport::pinned && clamped) relax(-length, 1.0);
    if (end == EndSupport::clamped && clamped) relax(1.0, 0.0);
    if (end == EndSupport::clamped) relax(clamped ? -0.5 * length : 0.0, 1.0);
  }
  const auto first = m.begin() + static_cast<std::ptrdiff_t>(first_moment_);
  return {first, first + static_cast<std::ptrdiff_t>(n_sections())};
}

void MixedMesh::jumps(const double* unknowns, const double* p, double* result) const {
  const std::size_t last = n_kept_cells();
  const auto at_edge = [&](std::size_t node) {
    double jump = 0.0;
    const double here = displacement(unknowns, node);
    if (node < last) jump += (displacement(unknowns, node + 1) - here) * inverse_lengths_[node];
    if (node > 0) jump -= (here - displacement(unknowns, node - 1)) * inverse_lengths_[node - 1];
    return jump - p[node - first_moment_];
  };
  // Nodes with unknowns on both sides.
  const std::size_t first = first_unknown_ + 1;
  const std::size_t end = first_unknown_ + n_unknowns() - 1;
  const double* w = unknowns + 1;
  const double* of_flow = p + (first - first_moment_);
  const double* inverse = inverse_lengths_.data() + first;
  assign_by_lines(result + (first - first_moment_), end - first, [=](auto at) {
    return (at(w + 1) - at(w)) * at(inverse) - (at(w) - at(w - 1)) * at(inverse - 1) - at(of_flow);
  });
  for (std::size_t i = first_moment_; i < first; ++i) result[i - first_moment_] = at_edge(i);
  for (std::size_t i = end; i < first_moment_ + n_sections(); ++i) {
    result[i - first_moment_] = at_edge(i);
  }
}

void MixedMesh::forces_of(const double* moments, double factor, double* forces) const {
  const std::size_t last = n_kept_cells();
  const double scale = copies() * factor;
  const auto moment = [&](std::size_t node) {
    const bool none = node < first_moment_ || node >= first_moment_ + n_sections();
    return none ? 0.0 : moments[node - first_moment_];
  };
  const auto shear = [&](std::size_t cell) {
    return (moment(cell + 1) - moment(cell)) * inverse_lengths_[cell];
  };
  const auto at_edge = [&](std::size_t node) {
    return scale * ((node > 0 ? shear(node - 1) : 0.0) - (node < last ? shear(node) : 0.0));
  };
  // Nodes with moments on both sides.
  const std::size_t first = first_moment_ + 1;
  const std::size_t end = first_moment_ + n_sections() - 1;
  const double* m = moments + 1;
  const double* inverse = inverse_lengths_.data() + first;
  assign_by_lines(forces + (first - first_unknown_), end - first, [=](auto at) {
    return scale * ((at(m) - at(m - 1)) * at(inverse - 1) - (at(m + 1) - at(m)) * at(inverse));
  });
  for (std::size_t i = first_unknown_; i < first; ++i) forces[i - first_unknown_] = at_edge(i);
  for (std::size_t i = end; i < first_unknown_ + n_unknowns(); ++i) {
    forces[i - first_unknown_] = at_edge(i);
  }
}

void MixedMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  std::ranges::fill(kappa, 0.0);
  jumps(unknowns.data(), kappa.data(), kappa.data());
  hats_->solve(kappa);
}

void MixedMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  forces_of(moments.data(), 1.0, forces.data());
}

void MixedMesh::moment_weights(std::span<const double> unknowns, std::span<double> weights) const {
  std::ranges::fill(weights, 0.0);
  jumps(unknowns.data(), weights.data(), weights.data());
  for (double& weight : weights) weight *= -copies();
}

double MixedMesh::curvature(std::size_t section, std::span<const double> unknowns) const {
  return curvature_functional(section)(unknowns);
}

SparseFunctional MixedMesh::curvature_functional(std::size_t section) const {
  std::vector<double> row(n_sections(), 0.0);
  row[section] = -1.0 / copies();
  hats_->solve(row);
  SparseFunctional result;
  result.dense.resize(n_unknowns());
  forces_of(row.data(), 1.0, result.dense.data());
  return result;
}

// The cell that holds x, and the share of the cell before x, without rounding at a node.
std::pair<std::size_t, double> MixedMesh::place_of(double x) const {
  const auto after = std::ranges::upper_bound(node_positions_, x);
  const auto past = static_cast<std::size_t>(after - node_positions_.begin());
  const std::size_t cell = std::clamp<std::size_t>(past, 1, n_kept_cells()) - 1;
  const double share = (x - node_positions_[cell]) * inverse_lengths_[cell];
  const double nearest = std::round(share);
  return {cell, std::abs(share - nearest) < 1e-10 ? nearest : std::clamp(share, 0.0, 1.0)};
}

std::optional<SparseFunctional> MixedMesh::displacement_at(double x) const {
  const auto [cell, share] = place_of(x);
  SparseFunctional displacement;
  displacement.add(1.0 - share, node(cell));
  displacement.add(share, node(cell + 1));
  return displacement;
}

std::optional<SparseFunctional> MixedMesh::rotation_at(double x) const {
  const auto slope_at = [&](std::size_t i) {  // at a node: the mean of the links beside it
    SparseFunctional slope;
    if ((symmetric() && i == n_kept_cells()) || is_clamped(i)) return slope;
    const std::size_t a = i > 0 ? i - 1 : i;
    const std::size_t b = i < n_kept_cells() ? i : i - 1;
    for (const std::size_t cell : {a, b}) {
      slope.add(0.5 * inverse_lengths_[cell], node(cell + 1));
      slope.add(-0.5 * inverse_lengths_[cell], node(cell));
    }
    return slope;
  };
  const auto [cell, share] = place_of(x);
  SparseFunctional rotation;
  rotation.add(1.0 - share, slope_at(cell));
  rotation.add(share, slope_at(cell + 1));
  return rotation;
}

// Frequency of (-1, 1, -1, ..) on the infinite grid, where T is h/3 and the slopes' L is 1/3.
double MixedMesh::highest_frequency(double bending_stiffness) const {
  const double square = 4.0 / std::pow(std::ranges::min(lengths_), 2);
  const double rotary = rotary_inertia_ * (3.0 - 2.0 * share_of_links_);
  return std::sqrt(3.0 * bending_stiffness * square * square /
                   (mass_per_length_ + rotary * square));
}

NaturalModes MixedMesh::natural_modes(double bending_stiffness) const {
  const std::size_t n = n_unknowns();
  // Mass^-1 K, symmetric with Mass: by the inverse of the mass, from its solver.
  Eigen::MatrixXd flexibility(as_index(n), as_index(n)), stiffness(as_index(n), as_index(n));
  const std::unique_ptr<MassSolver> solver = make_mass_solver();
  std::vector<double> unit(n), kappa(n_sections());
  for (std::size_t i = 0; i < n; ++i) {
    std::ranges::fill(unit, 0.0);
    unit[i] = 1.0;
    curvatures(unit, kappa);
    for (double& k : kappa) k *= -bending_stiffness;
    const std::span<double> column(stiffness.col(as_index(i)).data(), n);
    bending_forces(kappa, column);
    solver->solve(unit);
    std::ranges::copy(unit, flexibility.col(as_index(i)).begin());
  }
  const Eigen::MatrixXd mass = flexibility.inverse();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(
      0.5 * (stiffness + stiffness.transpose()), 0.5 * (mass + mass.transpose()));
  NaturalModes modes;
  const double highest = std::sqrt(solved.eigenvalues().maxCoeff());
  for (const double squared : solved.eigenvalues()) {
    const double frequency = std::sqrt(std::max(squared, 0.0));
    modes.frequencies.push_back(frequency < 1e-7 * highest ? 0.0 : frequency);
  }
  const Eigen::MatrixXd& shapes = solved.eigenvectors();
  modes.shapes.assign(shapes.data(), shapes.data() + shapes.size());
  return modes;
}

std::string MixedMesh::description() const {
  return std::to_string(n_cells_) + " mixed cells" + (symmetric() ? ", one half by symmetry" : "");
}

}  // namespace subimpact
