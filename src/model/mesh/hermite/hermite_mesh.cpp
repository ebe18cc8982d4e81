#include "model/mesh/hermite/hermite_mesh.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "model/mesh/modes.h"
#include "numerics/bracketed_root.h"
#include "numerics/dense.h"

namespace subimpact {

constexpr std::size_t most_in_modes = 2000;  // shapes take n^2 numbers
constexpr double bound_tolerance = 1e-5;     // of the highest squared frequency

using Matrix4 = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

HermiteElement::HermiteElement(double a, double h)
    : length(a),
      slope_unit(h),
      mean(1.0 / (a * h)),
      of_displacements(6.0 / (a * a)),
      of_slopes(3.0 / (a * h)) {}

HermiteElement::Coefficients HermiteElement::curvature(double at) const {
  return {at * of_displacements, -mean + at * of_slopes, -at * of_displacements,
          mean + at * of_slopes};
}

HermiteElement::Coefficients HermiteElement::displacement(double z) const {
  const double s = length / slope_unit;
  return {(1.0 - z) * (1.0 - z) * (1.0 + 2.0 * z), s * z * (1.0 - z) * (1.0 - z),
          z * z * (3.0 - 2.0 * z), -s * z * z * (1.0 - z)};
}

HermiteElement::Coefficients HermiteElement::slope(double z) const {
  const double of_difference = 6.0 * z * (1.0 - z) / length;
  return {-of_difference, (1.0 - z) * (1.0 - 3.0 * z) / slope_unit, of_difference,
          z * (3.0 * z - 2.0) / slope_unit};
}

HermiteElement::Matrix HermiteElement::mass(double mass_per_length, double rotary_inertia) const {
  const double s = length / slope_unit;  // unknown h t contributes t = (h t)/h
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
  Matrix result;
  Eigen::Map<Matrix4>(result[0].data()) = unit.asDiagonal() *
                                          (mass_per_length * length / 420.0 * translation +
                                           rotary_inertia / (30.0 * length) * rotation) *
                                          unit.asDiagonal();
  return result;
}

HermiteElement::Coefficients HermiteElement::momentum(double mass_per_length) const {
  const double share = mass_per_length * length;
  const double lever = length / (12.0 * slope_unit);
  return {0.5 * share, lever * share, 0.5 * share, -lever * share};
}

HermiteElement::Coefficients HermiteElement::moment(double mass_per_length, double rotary_inertia,
                                                    double left) const {
  const double s = length / slope_unit;
  const double share = mass_per_length * length;
  return {share * (left / 2.0 + 3.0 * length / 20.0) - rotary_inertia,
          share * s * (left / 12.0 + length / 30.0),
          share * (left / 2.0 + 7.0 * length / 20.0) + rotary_inertia,
          -share * s * (left / 12.0 + length / 20.0)};
}

double HermiteElement::highest_frequency_squared(double bending_stiffness,
                                                 const Matrix& mass) const {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(4, 4);
  for (const double at : eta) {
    const Eigen::Vector4d row(curvature(at).data());
    stiffness += bending_stiffness * 0.5 * length * row * row.transpose();
  }
  return largest_eigenvalue(stiffness, Eigen::Map<const Matrix4>(mass[0].data()));
}

HermiteMesh::HermiteMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent)
    : ElementMesh(beam, {beam, position, n_elements, fewest_elements, extent == Extent::half, 1}, 1,
                  3),
      slope_unit_(beam.length / static_cast<double>(nodes_.n_elements_whole())),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()) {
  assemble_mass();
  if (!symmetric()) assemble_moment();
  gather_elements();
  struck_section_ = nearest_section(position * beam.length);
}

std::array<std::size_t, 4> HermiteMesh::unknowns_of(std::size_t element) const {
  const ElementNodes::Node& left = nodes_.nodes[element];
  const ElementNodes::Node& right = nodes_.nodes[element + 1];
  return {left.displacement, left.rotation, right.displacement, right.rotation};
}

std::pair<std::size_t, double> HermiteMesh::element_at(double x) const {
  constexpr double at_node = 1e-9;  // distance in units of an element's length
  double left = 0.0;
  std::size_t e = 0;
  for (; e + 1 < nodes_.n_elements() && x >= left + (1.0 - at_node) * nodes_.lengths[e]; ++e) {
    left += nodes_.lengths[e];
  }
  const double z = (x - left) / nodes_.lengths[e];
  return {e, z < at_node ? 0.0 : z > 1.0 - at_node ? 1.0 : z};
}

HermiteElement HermiteMesh::element(std::size_t e) const {
  return {nodes_.lengths[e], slope_unit_};
}

void HermiteMesh::assemble_mass() {
  momentum_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    const auto unknowns = unknowns_of(e);
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
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    const auto unknowns = unknowns_of(e);
    const double length = nodes_.lengths[e];
    if (std::ranges::count(unknowns, none) > 0) {
      singles_.push_back({unknowns, positions_.size(), element(e)});
    } else {
      const bool goes_on = !runs_.empty() && runs_.back().element.length == length;
      if (!goes_on) runs_.push_back({0, unknowns[0], positions_.size(), element(e)});
      ++runs_.back().size;
    }
    place_sections(e, left);
    left += length;
  }
}

void HermiteMesh::place_sections(std::size_t e, double left) {
  const HermiteElement f = element(e);
  const auto unknowns = unknowns_of(e);
  for (const double eta : f.eta) {
    positions_.push_back(left + 0.5 * (1.0 + eta) * f.length);
    weights_.push_back(copies() * 0.5 * f.length);
    HermiteElement::Coefficients row;  // of the unknowns not held, which are consecutive
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      if (unknowns[i] != none) row[size++] = f.curvature(eta)[i];
    }
    add_stencil(std::ranges::min(unknowns), std::span(row).first(size));
  }
}

void HermiteMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  for (const Single& one : singles_) {
    HermiteElement::Coefficients q;
    for (std::size_t i = 0; i < 4; ++i) {
      q[i] = one.unknowns[i] == none ? 0.0 : unknowns[one.unknowns[i]];
    }
    one.element.curvatures(q.data(), kappa.data() + one.first_section);
  }
  for (const Run& run : runs_) {
    const HermiteElement f = run.element;
    const double* q = unknowns.data() + run.first_unknown;
    double* k = kappa.data() + run.first_section;
    for (std::size_t e = 0; e < run.size; ++e, q += 2, k += 2) f.curvatures(q, k);
  }
}

// Within a run every force is written once.
void HermiteMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
  for (const Single& one : singles_) {
    const auto own = one.element.of_moments(moments.data() + one.first_section, copies());
    for (std::size_t i = 0; i < 4; ++i) {
      if (one.unknowns[i] != none) forces[one.unknowns[i]] += own[i];
    }
  }
  for (const Run& run : runs_) {
    const HermiteElement f = run.element;
    const double* m = moments.data() + run.first_section;
    double* force = forces.data() + run.first_unknown;
    double left_force = force[0];  // on an element's first node, so far
    double left_couple = force[1];
    for (std::size_t e = 0; e < run.size; ++e, force += 2, m += 2) {
      const auto own = f.of_moments(m, copies());
      force[0] = left_force + own[0];
      force[1] = left_couple + own[1];
      left_force = own[2];
      left_couple = own[3];
    }
    force[0] += left_force;
    force[1] += left_couple;
  }
}

SparseFunctional HermiteMesh::of_element(std::size_t element,
                                         const HermiteElement::Coefficients& coefficients) const {
  const auto unknowns = unknowns_of(element);
  SparseFunctional functional;
  for (std::size_t i = 0; i < 4; ++i) {
    if (unknowns[i] == none || coefficients[i] == 0.0) continue;
    functional.terms.push_back({unknowns[i], coefficients[i]});
  }
  return functional;
}

std::optional<SparseFunctional> HermiteMesh::displacement_at(double x) const {
  const auto [e, z] = element_at(x);
  return of_element(e, element(e).displacement(z));
}

std::optional<SparseFunctional> HermiteMesh::rotation_at(double x) const {
  const auto [e, z] = element_at(x);
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

double HermiteMesh::highest_frequency(double bending_stiffness) const {
  const auto is_above = above_spectrum(*this, bending_stiffness);
  const auto within_spectrum = [&](double s) { return !is_above(s); };
  // No assembly exceeds the highest frequency of its elements by themselves (Irons and Treharne).
  double bound = 0.0;
  for (const std::size_t e : {std::size_t{0}, nodes_.n_elements() - 1}) {
    const auto mass = element(e).mass(mass_per_length_, rotary_inertia_);
    bound = std::max(bound, element(e).highest_frequency_squared(bending_stiffness, mass));
  }
  return std::sqrt(bisect(within_spectrum, 0.0, bound, bound_tolerance).second);
}

// Whether all elements are equal.
bool HermiteMesh::is_chain() const {
  const auto [shortest, longest] = std::ranges::minmax(nodes_.lengths);
  return longest / shortest - 1.0 < 1e-14;
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

}  // namespace subimpact
