#include "model/hermite_mesh.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include "model/hermite_modes.h"
#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

constexpr std::size_t most_in_modes = 2000;  // shapes take n^2 numbers

constexpr double bound_tolerance = 1e-5;  // of the highest squared frequency

std::size_t count_unknowns(const Beam& beam, double position, std::size_t n_elements, bool half,
                           bool hinges) {
  if (n_elements < HermiteMesh::fewest_elements) {
    throw std::invalid_argument("hermite mesh: at least 4 elements are needed");
  }
  const auto held = [&](EndSupport end) -> std::size_t {
    if (end == EndSupport::clamped) return hinges ? 1 : 2;
    return end == EndSupport::pinned ? 1 : 0;
  };
  const std::size_t n_nodes = (half ? n_elements / 2 : n_elements) + 1;
  const std::size_t slopes_more = hinges && position > 0.0 && position < 1.0 ? 1 : 0;
  return 2 * n_nodes + slopes_more - held(beam.ends[0]) - (half ? 1 : held(beam.ends[1]));
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
                         std::size_t sections_per_element, Extent extent, const Options& options)
    : BeamMesh(count_unknowns(beam, position, n_elements, extent == Extent::half, options.hinges),
               3, extent == Extent::half),
      n_elements_whole_(n_elements),
      n_elements_(symmetric() ? n_elements / 2 : n_elements),
      slope_unit_(beam.length / static_cast<double>(n_elements)),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()),
      ends_(beam.ends),
      options_(options),
      copies_(symmetric() ? 2.0 : 1.0) {
  if (symmetric() && (n_elements % 2 != 0 || position != 0.5 || ends_[0] != ends_[1])) {
    throw std::invalid_argument(
        "hermite mesh: a half model needs an even number of elements, struck at 0.5, and ends "
        "alike");
  }
  place_nodes(position * beam.length, symmetric() ? 0.0 : (1.0 - position) * beam.length);
  number_unknowns();
  const std::size_t struck = nodes_[struck_node_].displacement;
  if (struck == none) throw std::invalid_argument("hermite mesh: the strike is on a support");
  struck_point_.terms = {{struck, 1.0}};
  if (ends_[0] == EndSupport::free) first_end_.terms = {{0, 1.0}};
  beam_mass_ = beam.mass();
  if (beam.is_free()) {
    translation_.assign(n_unknowns(), 0.0);
    for (const Node& node : nodes_) translation_[node.displacement] = 1.0;
  }
  assemble_mass();
  if (!symmetric()) assemble_moment();
  gather_elements(sections_per_element);
  const double struck_at = position * beam.length;
  const auto nearer = [&](double x, double y) {
    return std::abs(x - struck_at) < std::abs(y - struck_at);
  };
  struck_section_ = static_cast<std::size_t>(
      std::min_element(positions_.begin(), positions_.end(), nearer) - positions_.begin());
}

// Left and right of the strike, nodes are equidistant in elements_within.
void HermiteMesh::place_nodes(double left_length, double right_length) {
  const ElementGrading& grading = options_.grading;
  const double left = grading.elements_within(left_length);
  const double right = grading.elements_within(right_length);
  struck_node_ = n_elements_;
  if (!symmetric()) {
    const auto n = static_cast<double>(n_elements_);
    struck_node_ = static_cast<std::size_t>(std::lround(n * left / (left + right)));
    if (left > 0.0) struck_node_ = std::max<std::size_t>(struck_node_, 1);
    if (right > 0.0) struck_node_ = std::min(struck_node_, n_elements_ - 1);
  }
  // Lengths from the strike outwards.
  const auto side = [&](std::size_t count, double length, double within) {
    std::vector<double> lengths(count, length / static_cast<double>(count));
    if (grading.refinement == 1.0) return lengths;
    double before = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(count);
      const double d = i + 1 == count ? length : grading.distance_of(within * share);
      lengths[i] = d - before;
      before = d;
    }
    return lengths;
  };
  if (struck_node_ > 0) {
    lengths_ = side(struck_node_, left_length, left);
    std::reverse(lengths_.begin(), lengths_.end());
  }
  if (struck_node_ < n_elements_) {
    const std::vector<double> after = side(n_elements_ - struck_node_, right_length, right);
    lengths_.insert(lengths_.end(), after.begin(), after.end());
  }
}

bool HermiteMesh::is_hinge(std::size_t node) const {
  if (!options_.hinges) return false;
  const bool mirror = symmetric() && node == n_elements_;
  if (mirror || (node > 0 && node < n_elements_)) return node == struck_node_;
  return ends_[node == 0 ? 0 : 1] == EndSupport::clamped;
}

void HermiteMesh::number_unknowns() {
  std::size_t next = 0;
  for (std::size_t i = 0; i <= n_elements_; ++i) {
    const bool mirror = symmetric() && i == n_elements_;
    EndSupport support = EndSupport::free;
    if (i == 0) support = ends_[0];
    if (i == n_elements_ && !mirror) support = ends_[1];
    Node node{none, none, none};
    const bool hinge = is_hinge(i);
    if (hinge && i > 0) node.slope_before = next++;
    if (support == EndSupport::free) node.displacement = next++;
    if (hinge) {
      if (i < n_elements_) node.slope_after = next++;
    } else if (support != EndSupport::clamped && !mirror) {
      node.slope_before = node.slope_after = next++;
    }
    nodes_.push_back(node);
  }
}

std::array<std::size_t, 4> HermiteMesh::unknowns_of(std::size_t element) const {
  const Node& left = nodes_[element];
  const Node& right = nodes_[element + 1];
  return {left.displacement, left.slope_after, right.displacement, right.slope_before};
}

void HermiteMesh::assemble_mass() {
  momentum_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t e = 0; e < n_elements_; ++e) {
    const double a = lengths_[e];
    const auto unknowns = unknowns_of(e);
    const Eigen::Matrix4d mass =
        copies_ * element_mass(a, slope_unit_, mass_per_length_, rotary_inertia_);
    const double share = copies_ * mass_per_length_ * a;
    const double lever = a / (12.0 * slope_unit_);
    add_local(unknowns, {0.5 * share, lever * share, 0.5 * share, -lever * share},
              momentum_functional_);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) {
        if (unknowns[i] == none || unknowns[j] == none) continue;
        mass_.at(unknowns[i], unknowns[j]) +=
            mass(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      }
    }
  }
}

// integral of rho A N x + J N' over the elements.
void HermiteMesh::assemble_moment() {
  moment_functional_.assign(n_unknowns(), 0.0);
  double left = 0.0;
  for (std::size_t e = 0; e < n_elements_; ++e) {
    const double a = lengths_[e];
    const double s = a / slope_unit_;
    const double share = mass_per_length_ * a;
    add_local(unknowns_of(e),
              {share * (left / 2.0 + 3.0 * a / 20.0) - rotary_inertia_,
               share * s * (left / 12.0 + a / 30.0),
               share * (left / 2.0 + 7.0 * a / 20.0) + rotary_inertia_,
               -share * s * (left / 12.0 + a / 20.0)},
              moment_functional_);
    left += a;
  }
}

HermiteMesh::Local HermiteMesh::Factors::row(const std::array<double, 2>& of_curvature) const {
  const auto [of_mean, of_half] = of_curvature;
  return {of_half * of_displacements, -of_mean * mean + of_half * of_slopes,
          -of_half * of_displacements, of_mean * mean + of_half * of_slopes};
}

HermiteMesh::Factors HermiteMesh::factors_of(double length) const {
  const double mean = 1.0 / (length * slope_unit_);
  return {length, mean, 6.0 / (length * length), 3.0 / (length * slope_unit_)};
}

void HermiteMesh::gather_elements(std::size_t sections_per_element) {
  gauss_ = gauss_rule(sections_per_element);
  double left = 0.0;
  if (is_hinge(0)) place_hinge(0, 0.0);
  for (std::size_t e = 0; e < n_elements_; ++e) {
    const bool hinge_before = is_hinge(e);
    const bool hinge_after = is_hinge(e + 1);
    const bool beside_hinge = hinge_before || hinge_after;
    const auto unknowns = unknowns_of(e);
    const bool complete = std::find(unknowns.begin(), unknowns.end(), none) == unknowns.end();
    const std::size_t section = positions_.size();
    if (beside_hinge || !complete) {
      singles_.push_back({unknowns, section, factors_of(lengths_[e]),
                          beside_hinge ? rule_beside_hinges(hinge_before, hinge_after) : gauss_});
      place_element(e, left, singles_.back().rule);
    } else {
      const bool goes_on =
          !runs_.empty() && runs_.back().factors.length == lengths_[e] &&
          runs_.back().first_section + runs_.back().size * gauss_.size() == section;
      if (!goes_on) runs_.push_back({0, unknowns[0], section, factors_of(lengths_[e])});
      ++runs_.back().size;
      place_element(e, left, gauss_);
    }
    left += lengths_[e];
    if (hinge_after) place_hinge(e + 1, left);
  }
}

void HermiteMesh::place_element(std::size_t element, double left, const ElementRule& rule) {
  const Factors f = factors_of(lengths_[element]);
  const auto unknowns = unknowns_of(element);
  for (std::size_t g = 0; g < rule.size(); ++g) {
    positions_.push_back(left + 0.5 * (1.0 + rule.points[g]) * f.length);
    weights_.push_back(copies_ * rule.weights[g] * f.length);
    add_row(unknowns, f.row(rule.of_curvature[g]));
  }
}

void HermiteMesh::place_hinge(std::size_t node, double x) {
  const double before = node > 0 ? lengths_[node - 1] : 0.0;
  const double after = node < n_elements_ ? lengths_[node] : 0.0;
  const double length = hinge_share * (before + after);
  const double inverse = 1.0 / (length * slope_unit_);
  const Node& here = nodes_[node];
  hinges_.push_back({positions_.size(), here.slope_before, here.slope_after, inverse});
  positions_.push_back(x);
  weights_.push_back(copies_ * length);
  add_row(std::array{here.slope_before, here.displacement, here.slope_after},
          std::array{-inverse, 0.0, inverse});
}

// The unknowns are consecutive but for those held, in whatever order.
void HermiteMesh::add_row(std::span<const std::size_t> unknowns,
                          std::span<const double> coefficients) {
  Row row{none, 0, {}};
  for (const std::size_t unknown : unknowns) row.first = std::min(row.first, unknown);
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (unknowns[i] == none) continue;
    row.coefficients[unknowns[i] - row.first] = coefficients[i];
    ++row.size;
  }
  rows_.push_back(row);
}

void HermiteMesh::add_local(const std::array<std::size_t, 4>& unknowns, const Local& values,
                            std::span<double> result) const {
  for (std::size_t i = 0; i < 4; ++i) {
    if (unknowns[i] != none) result[unknowns[i]] += values[i];
  }
}

template <std::size_t points>
void HermiteMesh::curvatures_in_runs(const double* unknowns, double* kappa) const {
  double eta[points];
  std::copy_n(gauss_.points.data(), points, eta);
  for (const Run& run : runs_) {
    const Factors f = run.factors;
    const double* q = unknowns + run.first_unknown;
    double* k = kappa + run.first_section;
    for (std::size_t e = 0; e < run.size; ++e, q += 2, k += points) {
      const double mean = f.mean * (q[3] - q[1]);
      const double half = f.of_displacements * (q[0] - q[2]) + f.of_slopes * (q[1] + q[3]);
      for (std::size_t g = 0; g < points; ++g) k[g] = mean + eta[g] * half;
    }
  }
}

void HermiteMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  const auto value = [&](std::size_t i) { return i == none ? 0.0 : unknowns[i]; };
  for (const Single& one : singles_) {
    const Factors& f = one.factors;
    const Local q{value(one.unknowns[0]), value(one.unknowns[1]), value(one.unknowns[2]),
                  value(one.unknowns[3])};
    const double mean = f.mean * (q[3] - q[1]);
    const double half = f.of_displacements * (q[0] - q[2]) + f.of_slopes * (q[1] + q[3]);
    for (std::size_t g = 0; g < one.rule.size(); ++g) {
      const auto [of_mean, of_half] = one.rule.of_curvature[g];
      kappa[one.first_section + g] = of_mean * mean + of_half * half;
    }
  }
  for (const Hinge& hinge : hinges_) {
    kappa[hinge.section] = hinge.inverse * (value(hinge.slope_after) - value(hinge.slope_before));
  }
  switch (gauss_.size()) {
    case 2:
      return curvatures_in_runs<2>(unknowns.data(), kappa.data());
    case 3:
      return curvatures_in_runs<3>(unknowns.data(), kappa.data());
    default:
      return curvatures_in_runs<4>(unknowns.data(), kappa.data());
  }
}

// Adds -B^T W moments; within a run every force is written once.
template <std::size_t points>
void HermiteMesh::bending_forces_in_runs(const double* moments, double* forces) const {
  double eta[points];
  double weight[points];
  std::copy_n(gauss_.points.data(), points, eta);
  std::copy_n(gauss_.weights.data(), points, weight);
  for (const Run& run : runs_) {
    const Factors f = run.factors;
    const double scale = copies_ * f.length;
    const double* m = moments + run.first_section;
    double* force = forces + run.first_unknown;
    double left_force = force[0];  // on an element's first node, so far
    double left_couple = force[1];
    for (std::size_t e = 0; e < run.size; ++e, force += 2, m += points) {
      double sum = 0.0;
      double first_moment = 0.0;
      for (std::size_t g = 0; g < points; ++g) {
        sum += weight[g] * m[g];
        first_moment += weight[g] * eta[g] * m[g];
      }
      const double mean = scale * f.mean * sum;
      const double shear = scale * f.of_displacements * first_moment;
      const double slopes = scale * f.of_slopes * first_moment;
      force[0] = left_force - shear;
      force[1] = left_couple + (mean - slopes);
      left_force = shear;
      left_couple = -mean - slopes;
    }
    force[0] += left_force;
    force[1] += left_couple;
  }
}

void HermiteMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
  for (const Single& one : singles_) {
    const Factors& f = one.factors;
    double sum = 0.0;
    double first_moment = 0.0;
    for (std::size_t g = 0; g < one.rule.size(); ++g) {
      const double m = one.rule.weights[g] * moments[one.first_section + g];
      sum += one.rule.of_curvature[g][0] * m;
      first_moment += one.rule.of_curvature[g][1] * m;
    }
    const double scale = copies_ * f.length;
    const double mean = scale * f.mean * sum;
    const double shear = scale * f.of_displacements * first_moment;
    const double slopes = scale * f.of_slopes * first_moment;
    add_local(one.unknowns, {-shear, mean - slopes, shear, -mean - slopes}, forces);
  }
  for (const Hinge& hinge : hinges_) {
    const double couple = weights_[hinge.section] * hinge.inverse * moments[hinge.section];
    if (hinge.slope_before != none) forces[hinge.slope_before] += couple;
    if (hinge.slope_after != none) forces[hinge.slope_after] -= couple;
  }
  switch (gauss_.size()) {
    case 2:
      return bending_forces_in_runs<2>(moments.data(), forces.data());
    case 3:
      return bending_forces_in_runs<3>(moments.data(), forces.data());
    default:
      return bending_forces_in_runs<4>(moments.data(), forces.data());
  }
}

BeamMesh::SectionStencil HermiteMesh::section_stencil(std::size_t section) const {
  const Row& row = rows_[section];
  return {row.first, std::span(row.coefficients).first(row.size)};
}

std::pair<std::size_t, double> HermiteMesh::element_at(double x) const {
  constexpr double at_node = 1e-9;  // distance in units of an element's length
  double left = 0.0;
  std::size_t e = 0;
  for (; e + 1 < n_elements_ && x >= left + (1.0 - at_node) * lengths_[e]; ++e) {
    left += lengths_[e];
  }
  const double z = (x - left) / lengths_[e];
  return {e, z < at_node ? 0.0 : z > 1.0 - at_node ? 1.0 : z};
}

SparseFunctional HermiteMesh::of_element(std::size_t element, const Local& coefficients) const {
  const auto unknowns = unknowns_of(element);
  SparseFunctional functional;
  for (std::size_t i = 0; i < 4; ++i) {
    if (unknowns[i] == none || coefficients[i] == 0.0) continue;
    functional.terms.push_back({unknowns[i], coefficients[i]});
  }
  return functional;
}

std::optional<SparseFunctional> HermiteMesh::displacement_at(double x) const {
  const auto [element, z] = element_at(x);
  const double s = lengths_[element] / slope_unit_;
  return of_element(element,
                    {(1.0 - z) * (1.0 - z) * (1.0 + 2.0 * z), s * z * (1.0 - z) * (1.0 - z),
                     z * z * (3.0 - 2.0 * z), -s * z * z * (1.0 - z)});
}

std::optional<SparseFunctional> HermiteMesh::rotation_at(double x) const {
  const auto [element, z] = element_at(x);
  const double a = lengths_[element];
  const double of_displacements = 6.0 * z * (1.0 - z) / a;
  const auto at_start = is_hinge(element) ? nodes_[element].slope_before : none;
  if (z == 0.0 && element > 0 && at_start != none) {  // the mean of both sides
    SparseFunctional slope;
    for (const std::size_t unknown : {at_start, nodes_[element].slope_after}) {
      slope.terms.push_back({unknown, 0.5 / slope_unit_});
    }
    return slope;
  }
  if (symmetric() && element + 1 == n_elements_ && z == 1.0) return SparseFunctional{};
  return of_element(element, {-of_displacements, (1.0 - z) * (1.0 - 3.0 * z) / slope_unit_,
                              of_displacements, z * (3.0 * z - 2.0) / slope_unit_});
}

// An element by itself, with springs on its slopes, N/m.
double HermiteMesh::frequency_squared(const Factors& f, const ElementRule& rule,
                                      std::array<double, 2> springs,
                                      double bending_stiffness) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  stiffness(1, 1) = springs[0];
  stiffness(3, 3) = springs[1];
  for (std::size_t g = 0; g < rule.size(); ++g) {
    const Eigen::Vector4d row(f.row(rule.of_curvature[g]).data());
    stiffness += bending_stiffness * rule.weights[g] * f.length * row * row.transpose();
  }
  const Eigen::MatrixXd mass =
      element_mass(f.length, slope_unit_, mass_per_length_, rotary_inertia_);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass,
                                                                         Eigen::EigenvaluesOnly);
  return solver.eigenvalues()(3);
}

// Of every kind of element by itself. A hinge between two lengths has the energy EI/(2 L) (t_+ -
// t_-)^2, at most EI/L (t_+^2 + t_-^2), of which either element takes its part.
double HermiteMesh::highest_element_frequency_squared(double bending_stiffness) const {
  double highest = 0.0;
  for (const Run& run : runs_) {
    highest =
        std::max(highest, frequency_squared(run.factors, gauss_, {0.0, 0.0}, bending_stiffness));
  }
  for (const Single& one : singles_) {
    std::array<double, 2> springs{0.0, 0.0};
    for (const Hinge& hinge : hinges_) {
      const double spring = 2.0 * bending_stiffness * hinge.inverse / slope_unit_;
      if (hinge.slope_after != none && hinge.slope_after == one.unknowns[1]) springs[0] = spring;
      if (hinge.slope_before != none && hinge.slope_before == one.unknowns[3]) springs[1] = spring;
    }
    highest =
        std::max(highest, frequency_squared(one.factors, one.rule, springs, bending_stiffness));
  }
  return highest;
}

double HermiteMesh::highest_frequency(double bending_stiffness) const {
  BandedMatrix stiffness(n_unknowns(), 3);
  add_stiffness(std::vector<double>(n_sections(), bending_stiffness), stiffness);
  // s lies above the spectrum if s Mass - K is positive definite. No assembly exceeds the highest
  // frequency of its elements by themselves (Irons and Treharne).
  BandedMatrix shifted(n_unknowns(), 3);
  const auto within_spectrum = [&](double s) {
    for (std::size_t i = 0; i < n_unknowns(); ++i) {
      for (std::size_t j = i; j < std::min(i + 4, n_unknowns()); ++j) {
        shifted.at(i, j) = s * mass_.at(i, j) - stiffness.at(i, j);
      }
    }
    return !shifted.cholesky_factor();
  };
  const double bound = highest_element_frequency_squared(bending_stiffness);
  return std::sqrt(bisect(within_spectrum, 0.0, bound, bound_tolerance).second);
}

// Of equal elements, with nothing between them.
bool HermiteMesh::is_chain() const {
  const auto [shortest, longest] = std::minmax_element(lengths_.begin(), lengths_.end());
  return hinges_.empty() && *longest / *shortest - 1.0 < 1e-14;
}

bool HermiteMesh::has_closed_modes() const {
  return is_chain() && subimpact::has_closed_modes(ends_);
}

bool HermiteMesh::prefers_modes() const {
  return has_closed_modes() && n_unknowns() <= most_in_modes;
}

NaturalModes HermiteMesh::natural_modes(double bending_stiffness) const {
  std::optional<NaturalModes> modes;
  if (is_chain()) {
    modes = hermite_chain_modes({n_elements_whole_, slope_unit_, mass_per_length_, rotary_inertia_,
                                 bending_stiffness, ends_, symmetric()});
  }
  if (!modes) return dense_natural_modes(*this, bending_stiffness);
  normalise(*modes, mass_);
  return *std::move(modes);
}

std::string HermiteMesh::description() const {
  std::string text = std::to_string(n_elements_whole_) + " Hermite elements of " +
                     std::to_string(gauss_.size()) + " sections";
  if (options_.grading.refinement != 1.0) {
    const auto [shortest, longest] = std::minmax_element(lengths_.begin(), lengths_.end());
    char range[64];
    std::snprintf(range, sizeof range, ", from %.4g to %.4g mm long", 1e3 * *shortest,
                  1e3 * *longest);
    text += range;
  }
  if (!hinges_.empty()) {
    const std::size_t n = symmetric() ? 2 * hinges_.size() - 1 : hinges_.size();
    text += n == 1 ? ", one hinge" : ", " + std::to_string(n) + " hinges";
  }
  return text + (symmetric() ? ", one half by symmetry" : "");
}

}  // namespace subimpact
