#include "model/mesh/hermite/hermite_mesh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/mesh/modes.h"
#include "numerics/bracketed_root.h"
#include "numerics/gauss.h"

namespace subimpact {

constexpr std::size_t most_in_modes = 2000;  // shapes take n^2 numbers
constexpr double bound_tolerance = 1e-5;     // of the highest squared frequency

constexpr std::size_t points = 2;  // of an element

HermiteMesh::HermiteMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent,
                         bool hinges)
    : HermiteMesh(beam, position,
                  HermiteNodes(beam, position, n_elements, extent == Extent::half, hinges)) {}

HermiteMesh::HermiteMesh(const Beam& beam, double position, HermiteNodes nodes)
    : BeamMesh(nodes.n_unknowns, 3, nodes.half),
      nodes_(std::move(nodes)),
      slope_unit_(beam.length / static_cast<double>(nodes_.n_elements_whole())),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()) {
  struck_point_.terms = {{nodes_.struck_node().displacement, 1.0}};
  if (nodes_.ends[0] == EndSupport::free) first_end_.terms = {{0, 1.0}};
  beam_mass_ = beam.mass();
  if (beam.is_free()) {
    translation_.assign(n_unknowns(), 0.0);
    for (const HermiteNodes::Node& node : nodes_.nodes) translation_[node.displacement] = 1.0;
  }
  assemble_mass();
  if (!symmetric()) assemble_moment();
  gather_elements();
  struck_section_ = nearest_section(position * beam.length);
}

HermiteElement HermiteMesh::element(std::size_t e) const {
  return {nodes_.lengths[e], slope_unit_};
}

void HermiteMesh::assemble_mass() {
  momentum_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    const auto unknowns = nodes_.unknowns_of(e);
    const HermiteElement::Matrix mass = element(e).mass(mass_per_length_, rotary_inertia_);
    of_element(e, element(e).momentum(copies() * mass_per_length_))
        .add_to(momentum_functional_, 1.0);
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i; j < 4; ++j) {
        if (unknowns[i] == none || unknowns[j] == none) continue;
        mass_.at(unknowns[i], unknowns[j]) += copies() * mass[i][j];
      }
    }
  }
}

void HermiteMesh::assemble_moment() {
  moment_functional_.assign(n_unknowns(), 0.0);
  double left = 0.0;
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    of_element(e, element(e).moment(mass_per_length_, rotary_inertia_, left))
        .add_to(moment_functional_, 1.0);
    left += nodes_.lengths[e];
  }
}

void HermiteMesh::gather_elements() {
  double left = 0.0;
  if (nodes_.is_hinge(0)) place_hinge(0, 0.0);
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    const bool hinge_before = nodes_.is_hinge(e);
    const bool hinge_after = nodes_.is_hinge(e + 1);
    const bool beside_hinge = hinge_before || hinge_after;
    const auto unknowns = nodes_.unknowns_of(e);
    const double length = nodes_.lengths[e];
    const bool complete = std::find(unknowns.begin(), unknowns.end(), none) == unknowns.end();
    const std::size_t section = positions_.size();
    if (beside_hinge || !complete) {
      singles_.push_back({unknowns, section, element(e),
                          beside_hinge ? rule_beside_hinges(hinge_before, hinge_after) : gauss_});
      place_element(e, left, singles_.back().rule);
    } else {
      const bool goes_on =
          !runs_.empty() && runs_.back().element.length == length &&
          runs_.back().first_section + runs_.back().size * gauss_.size() == section;
      if (!goes_on) runs_.push_back({0, unknowns[0], section, element(e)});
      ++runs_.back().size;
      place_element(e, left, gauss_);
    }
    left += length;
    if (hinge_after) place_hinge(e + 1, left);
  }
}

void HermiteMesh::place_element(std::size_t e, double left, const ElementRule& rule) {
  const HermiteElement f = element(e);
  const auto unknowns = nodes_.unknowns_of(e);
  for (std::size_t g = 0; g < rule.size(); ++g) {
    positions_.push_back(left + 0.5 * (1.0 + rule.points[g]) * f.length);
    weights_.push_back(copies() * rule.weights[g] * f.length);
    add_row(unknowns, f.curvature(rule.of_curvature[g]));
  }
}

void HermiteMesh::place_hinge(std::size_t node, double x) {
  const std::span<const double> lengths = nodes_.lengths;
  const double before = node > 0 ? lengths[node - 1] : 0.0;
  const double after = node < lengths.size() ? lengths[node] : 0.0;
  const double length = hinge_share * (before + after);
  const double inverse = 1.0 / (length * slope_unit_);
  const HermiteNodes::Node& here = nodes_.nodes[node];
  hinges_.push_back({positions_.size(), here.slope_before, here.slope_after, inverse});
  positions_.push_back(x);
  weights_.push_back(copies() * length);
  add_row(std::array{here.slope_before, here.displacement, here.slope_after},
          std::array{-inverse, 0.0, inverse});
}

// The unknowns are consecutive but for those held, in whatever order.
void HermiteMesh::add_row(std::span<const std::size_t> unknowns,
                          std::span<const double> coefficients) {
  const std::size_t first = std::ranges::min(unknowns);
  HermiteElement::Coefficients row;
  std::size_t size = 0;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    if (unknowns[i] == none) continue;
    row[unknowns[i] - first] = coefficients[i];
    ++size;
  }
  add_stencil(first, std::span(row).first(size));
}

void HermiteMesh::curvatures_in_runs(const double* unknowns, double* kappa) const {
  double eta[points];
  std::copy_n(gauss_.points.data(), points, eta);
  for (const Run& run : runs_) {
    const HermiteElement f = run.element;
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
    const HermiteElement& f = one.element;
    const HermiteElement::Coefficients q{value(one.unknowns[0]), value(one.unknowns[1]),
                                         value(one.unknowns[2]), value(one.unknowns[3])};
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
  curvatures_in_runs(unknowns.data(), kappa.data());
}

// Adds -B^T W moments; within a run every force is written once.
void HermiteMesh::bending_forces_in_runs(const double* moments, double* forces) const {
  double eta[points];
  double weight[points];
  std::copy_n(gauss_.points.data(), points, eta);
  std::copy_n(gauss_.weights.data(), points, weight);
  for (const Run& run : runs_) {
    const HermiteElement f = run.element;
    const double scale = copies() * f.length;
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
    const HermiteElement& f = one.element;
    double sum = 0.0;
    double first_moment = 0.0;
    for (std::size_t g = 0; g < one.rule.size(); ++g) {
      const double m = one.rule.weights[g] * moments[one.first_section + g];
      sum += one.rule.of_curvature[g][0] * m;
      first_moment += one.rule.of_curvature[g][1] * m;
    }
    const double scale = copies() * f.length;
    const double mean = scale * f.mean * sum;
    const double shear = scale * f.of_displacements * first_moment;
    const double slopes = scale * f.of_slopes * first_moment;
    const HermiteElement::Coefficients own{-shear, mean - slopes, shear, -mean - slopes};
    for (std::size_t i = 0; i < 4; ++i) {
      if (one.unknowns[i] != none) forces[one.unknowns[i]] += own[i];
    }
  }
  for (const Hinge& hinge : hinges_) {
    const double couple = weights_[hinge.section] * hinge.inverse * moments[hinge.section];
    if (hinge.slope_before != none) forces[hinge.slope_before] += couple;
    if (hinge.slope_after != none) forces[hinge.slope_after] -= couple;
  }
  bending_forces_in_runs(moments.data(), forces.data());
}

SparseFunctional HermiteMesh::of_element(std::size_t element,
                                         const HermiteElement::Coefficients& coefficients) const {
  const auto unknowns = nodes_.unknowns_of(element);
  SparseFunctional functional;
  for (std::size_t i = 0; i < 4; ++i) {
    if (unknowns[i] == none || coefficients[i] == 0.0) continue;
    functional.terms.push_back({unknowns[i], coefficients[i]});
  }
  return functional;
}

std::optional<SparseFunctional> HermiteMesh::displacement_at(double x) const {
  const auto [e, z] = nodes_.element_at(x);
  return of_element(e, element(e).displacement(z));
}

std::optional<SparseFunctional> HermiteMesh::rotation_at(double x) const {
  const auto [e, z] = nodes_.element_at(x);
  const auto at_start = nodes_.is_hinge(e) ? nodes_.nodes[e].slope_before : none;
  if (z == 0.0 && e > 0 && at_start != none) {  // the mean of both sides
    const double half = 0.5 / slope_unit_;
    return SparseFunctional{{{at_start, half}, {nodes_.nodes[e].slope_after, half}}, {}};
  }
  if (symmetric() && e + 1 == nodes_.n_elements() && z == 1.0) return SparseFunctional{};
  return of_element(e, element(e).slope(z));
}

std::vector<BeamMesh::Slope> HermiteMesh::slopes() const {
  std::vector<Slope> all;
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    for (std::size_t g = 0; g < 3; ++g) {  // exact for squares of parabolas
      all.push_back({copies() * gauss<3>.weights[g] * nodes_.lengths[e],
                     of_element(e, element(e).slope(gauss<3>.points[g]))});
    }
  }
  return all;
}

// The highest frequency of any single element. A hinge between two lengths has the energy EI/(2 L)
// (t_+ - t_-)^2, at most EI/L (t_+^2 + t_-^2); each of the two elements takes its part.
double HermiteMesh::highest_element_frequency_squared(double bending_stiffness) const {
  double highest = 0.0;
  const auto include = [&](const HermiteElement& element, const ElementRule& rule,
                           std::array<double, 2> springs) {
    const auto mass = element.mass(mass_per_length_, rotary_inertia_);
    highest = std::max(highest,
                       element.highest_frequency_squared(rule, springs, bending_stiffness, mass));
  };
  for (const Run& run : runs_) include(run.element, gauss_, {0.0, 0.0});
  for (const Single& one : singles_) {
    std::array<double, 2> springs{0.0, 0.0};
    for (const Hinge& hinge : hinges_) {
      const double spring = 2.0 * bending_stiffness * hinge.inverse / slope_unit_;
      if (hinge.slope_after != none && hinge.slope_after == one.unknowns[1]) springs[0] = spring;
      if (hinge.slope_before != none && hinge.slope_before == one.unknowns[3]) springs[1] = spring;
    }
    include(one.element, one.rule, springs);
  }
  return highest;
}

double HermiteMesh::highest_frequency(double bending_stiffness) const {
  BandedMatrix stiffness(n_unknowns(), 3), opposite = stiffness;
  add_stiffness(std::vector<double>(n_sections(), bending_stiffness), stiffness);
  opposite.add(-1.0, stiffness);
  // s lies above the spectrum if s Mass - K is positive definite. No assembly exceeds the highest
  // frequency of its elements by themselves (Irons and Treharne).
  const auto within_spectrum = [&](double s) {
    BandedMatrix shifted = opposite;
    shifted.add(s, mass_);
    return !shifted.cholesky_factor();
  };
  const double bound = highest_element_frequency_squared(bending_stiffness);
  return std::sqrt(bisect(within_spectrum, 0.0, bound, bound_tolerance).second);
}

// Whether all elements are equal, without hinges between them.
bool HermiteMesh::is_chain() const {
  const auto [shortest, longest] = std::ranges::minmax(nodes_.lengths);
  return hinges_.empty() && longest / shortest - 1.0 < 1e-14;
}

bool HermiteMesh::has_closed_modes() const {
  return is_chain() && subimpact::has_closed_modes(nodes_.ends);
}

bool HermiteMesh::prefers_modes() const {
  return has_closed_modes() && n_unknowns() <= most_in_modes;
}

NaturalModes HermiteMesh::natural_modes(double bending_stiffness) const {
  std::optional<NaturalModes> modes;
  if (is_chain()) {
    modes = hermite_chain_modes({nodes_.n_elements_whole(), slope_unit_, mass_per_length_,
                                 rotary_inertia_, bending_stiffness, nodes_.ends, symmetric()});
  }
  if (!modes) return dense_natural_modes(*this, bending_stiffness);
  normalise(*modes, mass_);
  return *std::move(modes);
}

std::string HermiteMesh::description() const {
  std::string text = std::to_string(nodes_.n_elements_whole()) + " Hermite elements of 2 sections";
  if (!hinges_.empty()) {
    const std::size_t n = symmetric() ? 2 * hinges_.size() - 1 : hinges_.size();
    text += n == 1 ? ", one hinge" : ", " + std::to_string(n) + " hinges";
  }
  return text + (symmetric() ? ", one half by symmetry" : "");
}

}  // namespace subimpact
