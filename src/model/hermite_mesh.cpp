#include "model/hermite_mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/hermite_modes.h"

namespace subimpact {
namespace {

// Gauss points in [-1, 1] and their weights as shares of the interval.
struct Quadrature {
  std::vector<double> points, weights;
};

Quadrature gauss(std::size_t n) {
  switch (n) {
    case 2: {
      const double x = std::sqrt(1.0 / 3.0);
      return {{-x, x}, {0.5, 0.5}};
    }
    case 3: {
      const double x = std::sqrt(0.6);
      return {{-x, 0.0, x}, {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}};
    }
    case 4: {
      const double root = std::sqrt(1.2);
      const double inner = std::sqrt((3.0 - 2.0 * root) / 7.0);
      const double outer = std::sqrt((3.0 + 2.0 * root) / 7.0);
      const double part = std::sqrt(30.0) / 72.0;
      return {{-outer, -inner, inner, outer}, {0.25 - part, 0.25 + part, 0.25 + part, 0.25 - part}};
    }
    default:
      throw std::invalid_argument("hermite mesh: 2, 3 or 4 sections an element");
  }
}

constexpr std::size_t most_in_modes = 2000;  // shapes take n^2 numbers

constexpr double bound_tolerance = 1e-5;  // of the highest squared frequency

std::size_t count_unknowns(const Beam& beam, std::size_t n_elements, bool half) {
  if (n_elements < HermiteMesh::fewest_elements) {
    throw std::invalid_argument("hermite mesh: at least 4 elements are needed");
  }
  const auto held = [](EndSupport end) -> std::size_t {
    return end == EndSupport::free ? 0 : end == EndSupport::pinned ? 1 : 2;
  };
  const std::size_t n_nodes = (half ? n_elements / 2 : n_elements) + 1;
  return 2 * n_nodes - held(beam.ends[0]) - (half ? 1 : held(beam.ends[1]));
}

// integral of rho A N^T N + J N'^T N' over an element, for w_0, h t_0, w_1, h t_1.
Eigen::Matrix4d element_mass(double a, double h, double mass_per_length, double rotary_inertia) {
  const double s = a / h;  // unknown h t contributes t = (h t)/h
  Eigen::Matrix4d translation;
  translation << 156.0, 22.0, 54.0, -13.0,  //
      22.0, 4.0, 13.0, -3.0,                //
      54.0, 13.0, 156.0, -22.0,             //
      -13.0, -3.0, -22.0, 4.0;
  Eigen::Matrix4d rotation;
  rotation << 36.0, 3.0, -36.0, 3.0,  //
      3.0, 4.0, -3.0, -1.0,           //
      -36.0, -3.0, 36.0, -3.0,        //
      3.0, -1.0, -3.0, 4.0;
  const Eigen::Vector4d unit(1.0, s, 1.0, s);
  return unit.asDiagonal() *
         (mass_per_length * a / 420.0 * translation + rotary_inertia / (30.0 * a) * rotation) *
         unit.asDiagonal();
}

}  // namespace

HermiteMesh::HermiteMesh(const Beam& beam, double position, std::size_t n_elements,
                         std::size_t sections_per_element, Extent extent)
    : BeamMesh(count_unknowns(beam, n_elements, extent == Extent::half), 3, extent == Extent::half),
      n_elements_whole_(n_elements),
      n_elements_(symmetric() ? n_elements / 2 : n_elements),
      slope_unit_(beam.length / static_cast<double>(n_elements)),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()),
      ends_(beam.ends) {
  if (symmetric() && (n_elements % 2 != 0 || position != 0.5 || ends_[0] != ends_[1])) {
    throw std::invalid_argument(
        "hermite mesh: a half model needs an even number of elements, struck at 0.5, and ends "
        "alike");
  }
  const Quadrature quadrature = gauss(sections_per_element);
  points_ = quadrature.points;
  point_weights_ = quadrature.weights;

  const auto add_run = [&](std::size_t first, std::size_t end, double length) {
    if (first == end) return;
    const double a = length / static_cast<double>(end - first);
    runs_.push_back(
        {first, end, a, 1.0 / (a * slope_unit_), 6.0 / (a * a), 3.0 / (a * slope_unit_)});
  };
  std::size_t struck_node = n_elements_;
  if (symmetric()) {
    add_run(0, n_elements_, 0.5 * beam.length);
  } else {
    const auto n = static_cast<double>(n_elements);
    struck_node = static_cast<std::size_t>(std::lround(position * n));
    if (position > 0.0) struck_node = std::max<std::size_t>(struck_node, 1);
    if (position < 1.0) struck_node = std::min(struck_node, n_elements - 1);
    add_run(0, struck_node, position * beam.length);
    add_run(struck_node, n_elements, (1.0 - position) * beam.length);
  }
  const std::size_t struck = unknown(struck_node, false);
  if (struck == none) throw std::invalid_argument("hermite mesh: the strike is on a support");
  struck_point_.terms = {{struck, 1.0}};
  if (ends_[0] == EndSupport::free) first_end_.terms = {{0, 1.0}};
  beam_mass_ = beam.mass();
  if (beam.is_free()) {
    translation_.assign(n_unknowns(), 0.0);
    for (std::size_t node = 0; node <= n_elements_; ++node)
      translation_[unknown(node, false)] = 1.0;
  }
  assemble_mass();
  place_sections();
  const double struck_at = position * beam.length;
  const auto nearer = [&](double x, double y) {
    return std::abs(x - struck_at) < std::abs(y - struck_at);
  };
  struck_section_ = static_cast<std::size_t>(
      std::min_element(positions_.begin(), positions_.end(), nearer) - positions_.begin());
}

HermiteMesh::Held HermiteMesh::held(std::size_t node) const {
  if (node == n_elements_ && symmetric()) return {false, true};
  if (node > 0 && node < n_elements_) return {false, false};
  const EndSupport end = ends_[node == 0 ? 0 : 1];
  return {end != EndSupport::free, end == EndSupport::clamped};
}

std::size_t HermiteMesh::unknown(std::size_t node, bool slope) const {
  const Held here = held(node);
  if (slope ? here.slope : here.displacement) return none;
  std::size_t index = 2 * node;
  if (slope && !here.displacement) ++index;
  if (node > 0) {
    const Held first = held(0);
    index -= (first.displacement ? 1u : 0u) + (first.slope ? 1u : 0u);
  }
  return index;
}

std::array<std::size_t, 4> HermiteMesh::unknowns_of(std::size_t element) const {
  return {unknown(element, false), unknown(element, true), unknown(element + 1, false),
          unknown(element + 1, true)};
}

const HermiteMesh::Run& HermiteMesh::run_of(std::size_t element) const {
  return element < runs_.front().end ? runs_.front() : runs_.back();
}

void HermiteMesh::assemble_mass() {
  const double copies = symmetric() ? 2.0 : 1.0;  // the mirrored half is folded in
  momentum_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t e = 0; e < n_elements_; ++e) {
    const double a = run_of(e).length;
    const auto unknowns = unknowns_of(e);
    const Eigen::Matrix4d mass =
        copies * element_mass(a, slope_unit_, mass_per_length_, rotary_inertia_);
    const double share = copies * mass_per_length_ * a;
    const double lever = a / (12.0 * slope_unit_);
    add_local(e, {0.5 * share, lever * share, 0.5 * share, -lever * share}, momentum_functional_);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) {
        if (unknowns[i] == none || unknowns[j] == none) continue;
        mass_.at(unknowns[i], unknowns[j]) +=
            mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
}

void HermiteMesh::place_sections() {
  const double copies = symmetric() ? 2.0 : 1.0;
  double left = 0.0;
  for (std::size_t e = 0; e < n_elements_; ++e) {
    const Run& run = run_of(e);
    const auto unknowns = unknowns_of(e);
    for (std::size_t g = 0; g < points_.size(); ++g) {
      const double eta = points_[g];
      positions_.push_back(left + 0.5 * (1.0 + eta) * run.length);
      weights_.push_back(copies * point_weights_[g] * run.length);
      const Local all{eta * run.of_displacements, -run.mean + eta * run.of_slopes,
                      -eta * run.of_displacements, run.mean + eta * run.of_slopes};
      Row row{none, 0, {}};
      for (std::size_t i = 0; i < 4; ++i) {
        if (unknowns[i] == none) continue;
        if (row.first == none) row.first = unknowns[i];
        row.coefficients[row.size++] = all[i];
      }
      rows_.push_back(row);
    }
    left += run.length;
  }
}

HermiteMesh::Local HermiteMesh::local_values(std::size_t element,
                                             std::span<const double> unknowns) const {
  Local values{};
  const auto indices = unknowns_of(element);
  for (std::size_t i = 0; i < 4; ++i) {
    if (indices[i] != none) values[i] = unknowns[indices[i]];
  }
  return values;
}

void HermiteMesh::add_local(std::size_t element, const Local& values,
                            std::span<double> result) const {
  const auto indices = unknowns_of(element);
  for (std::size_t i = 0; i < 4; ++i) {
    if (indices[i] != none) result[indices[i]] += values[i];
  }
}

// The outermost elements may have unknowns held; between them every element has four.
template <std::size_t points>
void HermiteMesh::curvatures_with(const double* unknowns, double* kappa) const {
  double eta[points];
  std::copy_n(points_.data(), points, eta);
  const auto emit = [&](const Run& run, const double* q, double* k) {
    const double mean = run.mean * (q[3] - q[1]);
    const double half = run.of_displacements * (q[0] - q[2]) + run.of_slopes * (q[1] + q[3]);
    for (std::size_t g = 0; g < points; ++g) k[g] = mean + eta[g] * half;
  };
  const std::size_t last = n_elements_ - 1;
  const Local first_values = local_values(0, {unknowns, n_unknowns()});
  const Local last_values = local_values(last, {unknowns, n_unknowns()});
  emit(runs_.front(), first_values.data(), kappa);
  const double* base = unknowns + unknown(1, false) - 2;
  for (const Run& run : runs_) {
    const std::size_t end = std::min(run.end, last);
    for (std::size_t e = std::max<std::size_t>(run.first, 1); e < end; ++e) {
      emit(run, base + 2 * e, kappa + points * e);
    }
  }
  emit(runs_.back(), last_values.data(), kappa + points * last);
}

template <std::size_t points>
void HermiteMesh::bending_forces_with(const double* moments, std::span<double> forces) const {
  double eta[points];
  double weight[points];
  std::copy_n(points_.data(), points, eta);
  std::copy_n(point_weights_.data(), points, weight);
  const double copies = symmetric() ? 2.0 : 1.0;
  // -B^T W moments of one element.
  const auto element = [&](const Run& run, const double* m) {
    double sum = 0.0;
    double first_moment = 0.0;
    for (std::size_t g = 0; g < points; ++g) {
      sum += weight[g] * m[g];
      first_moment += weight[g] * eta[g] * m[g];
    }
    const double scale = copies * run.length;
    const double mean = scale * run.mean * sum;
    const double shear = scale * run.of_displacements * first_moment;
    const double slopes = scale * run.of_slopes * first_moment;
    return Local{-shear, mean - slopes, shear, -mean - slopes};
  };
  const std::size_t last = n_elements_ - 1;
  const std::size_t inner = unknown(1, false);
  std::fill_n(forces.begin(), inner, 0.0);
  std::fill(forces.begin() + static_cast<std::ptrdiff_t>(unknown(last, false)), forces.end(), 0.0);
  double* base = forces.data() + inner - 2;
  double left_force = 0.0;  // on an element's first node, by the element before
  double left_couple = 0.0;
  for (const Run& run : runs_) {
    const std::size_t end = std::min(run.end, last);
    for (std::size_t e = std::max<std::size_t>(run.first, 1); e < end; ++e) {
      const Local f = element(run, moments + points * e);
      base[2 * e] = left_force + f[0];
      base[2 * e + 1] = left_couple + f[1];
      left_force = f[2];
      left_couple = f[3];
    }
  }
  base[2 * last] = left_force;
  base[2 * last + 1] = left_couple;
  add_local(0, element(runs_.front(), moments), forces);
  add_local(last, element(runs_.back(), moments + points * last), forces);
}

void HermiteMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  switch (points_.size()) {
    case 2:
      return curvatures_with<2>(unknowns.data(), kappa.data());
    case 3:
      return curvatures_with<3>(unknowns.data(), kappa.data());
    default:
      return curvatures_with<4>(unknowns.data(), kappa.data());
  }
}

void HermiteMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  switch (points_.size()) {
    case 2:
      return bending_forces_with<2>(moments.data(), forces);
    case 3:
      return bending_forces_with<3>(moments.data(), forces);
    default:
      return bending_forces_with<4>(moments.data(), forces);
  }
}

BeamMesh::SectionStencil HermiteMesh::section_stencil(std::size_t section) const {
  const Row& row = rows_[section];
  return {row.first, std::span(row.coefficients).first(row.size)};
}

double HermiteMesh::highest_element_frequency_squared(double bending_stiffness) const {
  double highest = 0.0;
  for (const Run& run : runs_) {
    Eigen::Matrix4d stiffness = Eigen::Matrix4d::Zero();
    for (std::size_t g = 0; g < points_.size(); ++g) {
      const double eta = points_[g];
      const Eigen::Vector4d row(eta * run.of_displacements, -run.mean + eta * run.of_slopes,
                                -eta * run.of_displacements, run.mean + eta * run.of_slopes);
      stiffness += bending_stiffness * point_weights_[g] * run.length * row * row.transpose();
    }
    const Eigen::Matrix4d mass =
        element_mass(run.length, slope_unit_, mass_per_length_, rotary_inertia_);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> solver(stiffness, mass,
                                                                           Eigen::EigenvaluesOnly);
    highest = std::max(highest, solver.eigenvalues()(3));
  }
  return highest;
}

double HermiteMesh::highest_frequency(double bending_stiffness) const {
  BandedMatrix stiffness(n_unknowns(), 3);
  add_stiffness(std::vector<double>(n_sections(), bending_stiffness), stiffness);
  // s lies above the spectrum if s Mass - K is positive definite. No assembly exceeds the highest
  // frequency of its elements by themselves (Irons and Treharne).
  double above = highest_element_frequency_squared(bending_stiffness);
  double below = 0.0;
  BandedMatrix shifted(n_unknowns(), 3);
  while (above - below > bound_tolerance * above) {
    const double s = 0.5 * (below + above);
    for (std::size_t i = 0; i < n_unknowns(); ++i) {
      for (std::size_t j = i; j < std::min(i + 4, n_unknowns()); ++j) {
        shifted.at(i, j) = s * mass_.at(i, j) - stiffness.at(i, j);
      }
    }
    (shifted.is_positive_definite() ? above : below) = s;
  }
  return std::sqrt(above);
}

bool HermiteMesh::has_equal_elements() const {
  return std::abs(runs_.back().length / runs_.front().length - 1.0) < 1e-14;
}

bool HermiteMesh::prefers_modes() const {
  return has_equal_elements() && has_closed_modes(ends_) && n_unknowns() <= most_in_modes;
}

NaturalModes HermiteMesh::natural_modes(double bending_stiffness) const {
  std::optional<NaturalModes> modes;
  if (has_equal_elements()) {
    modes = hermite_chain_modes({n_elements_whole_, slope_unit_, mass_per_length_, rotary_inertia_,
                                 bending_stiffness, ends_, symmetric()});
  }
  if (!modes) return dense_natural_modes(*this, bending_stiffness);
  const std::size_t n = n_unknowns();
  for (std::size_t k = 0; k < n; ++k) {
    const std::span<double> shape(modes->shapes.data() + k * n, n);
    const double scale = 1.0 / std::sqrt(mass_.quadratic_form(shape));
    for (double& entry : shape) entry *= scale;
  }
  return *std::move(modes);
}

std::string HermiteMesh::description() const {
  return std::to_string(n_elements_whole_) + " Hermite elements of " +
         std::to_string(points_.size()) + " sections" +
         (symmetric() ? ", one half by symmetry" : "");
}

}  // namespace subimpact
