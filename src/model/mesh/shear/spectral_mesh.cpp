#include "model/mesh/shear/spectral_mesh.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "numerics/dense.h"
#include "numerics/gauss.h"

namespace subimpact {

const std::array<double, SpectralMesh::n_nodes> SpectralMesh::nodes = {
    0.0, 0.5 - 0.5 * std::sqrt(3.0 / 7.0), 0.5, 0.5 + 0.5 * std::sqrt(3.0 / 7.0), 1.0};

namespace {

constexpr std::size_t n_nodes = SpectralMesh::n_nodes;
constexpr std::size_t n_points = SpectralMesh::degree;

constexpr const auto& nodes = SpectralMesh::nodes;

// Lagrange's polynomial of a node, and its derivative.
std::pair<double, double> lagrange(std::size_t a, double x) {
  double value = 1.0, slope = 0.0;
  for (std::size_t b = 0; b < n_nodes; ++b) {
    if (b == a) continue;
    const double gap = nodes[a] - nodes[b];
    slope = slope * (x - nodes[b]) / gap + value / gap;
    value *= (x - nodes[b]) / gap;
  }
  return {value, slope};
}

// Of all nodes, at the Gauss points.
struct Shapes {
  std::array<std::array<double, n_nodes>, n_points> value, slope;
};

const Shapes shapes = [] {
  Shapes at{};
  for (std::size_t q = 0; q < n_points; ++q) {
    for (std::size_t a = 0; a < n_nodes; ++a) {
      std::tie(at.value[q][a], at.slope[q][a]) = lagrange(a, gauss<n_points>.points[q]);
    }
  }
  return at;
}();

}  // namespace

SpectralMesh::Strains::Strains(double length, double gyration, double shear_stiffness,
                               double copies) {
  for (std::size_t q = 0; q < n_points; ++q) {
    weights[of_bending + q] = copies * length * gauss<n_points>.weights[q];
    weights[of_shear + q] = shear_stiffness * weights[of_bending + q];
    for (std::size_t a = 0; a < n_nodes; ++a) {
      const double slope = shapes.slope[q][a] / length;
      rows[of_shear + q][2 * a] = slope;
      rows[of_shear + q][2 * a + 1] = -shapes.value[q][a] / gyration;
      rows[of_bending + q][2 * a] = 0.0;
      rows[of_bending + q][2 * a + 1] = slope / gyration;
    }
  }
  static_assert(2 * n_points == n_lanes);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t q = 0; q < n_lanes; ++q) columns[i][q] = rows[q][i];
  }
}

SpectralMesh::SpectralMesh(const Beam& beam, double position, std::size_t n_elements, Extent extent)
    : ElementMesh(beam,
                  {beam, position, n_elements, fewest_elements, extent == Extent::half, degree},
                  degree, 0),
      gyration_(beam.radius_of_gyration()),
      mass_per_length_(beam.mass_per_length()),
      shear_stiffness_per_length_(beam.shear_stiffness()) {
  if (!beam.shears()) throw std::invalid_argument("spectral mesh: the beam's theory has no shear");
  place_elements();
  assemble_mass(beam);
  assemble_shear();
  place_sections();
}

void SpectralMesh::place_elements() {
  for (const double length : {nodes_.lengths.front(), nodes_.lengths.back()}) {
    strains_.emplace_back(length, gyration_, shear_stiffness_per_length_, copies());
  }
  for (std::size_t e = 0; e < nodes_.n_elements(); ++e) {
    Element element{nodes_.lengths[e], e < nodes_.n_before ? 0u : 1u, {}, true};
    for (std::size_t a = 0; a < n_nodes; ++a) {
      const ElementNodes::Node& node = nodes_.nodes[degree * e + a];
      element.unknowns[2 * a] = node.displacement;
      element.unknowns[2 * a + 1] = node.rotation;
    }
    element.is_contiguous = std::ranges::count(element.unknowns, none) == 0;
    elements_.push_back(element);
  }
}

void SpectralMesh::assemble_mass(const Beam& beam) {
  momentum_functional_.assign(n_unknowns(), 0.0);
  if (!symmetric()) moment_functional_.assign(n_unknowns(), 0.0);
  const double per_length[2] = {beam.mass_per_length(),
                                beam.rotary_inertia() / (gyration_ * gyration_)};
  double start = 0.0;
  for (const Element& element : elements_) {
    for (std::size_t i = 0; i < element.unknowns.size(); ++i) {
      const std::size_t unknown = element.unknowns[i];
      if (unknown == none) continue;
      const double mass = copies() * per_length[i % 2] * element.length * node_weights[i / 2];
      mass_.at(unknown, unknown) += mass;
      if (i % 2 == 0) momentum_functional_[unknown] += mass;
      if (symmetric()) continue;
      const double x = start + nodes[i / 2] * element.length;
      moment_functional_[unknown] += mass * (i % 2 == 0 ? x : gyration_);
    }
    start += element.length;
  }
}

void SpectralMesh::assemble_shear() {
  shear_stiffness_ = BandedMatrix(n_unknowns(), 2 * degree + 1);
  for (const Element& element : elements_) {
    for (std::size_t q = of_shear; q < of_shear + n_points; ++q) {
      const double weight = strains_[element.side].weights[q];
      const auto& row = strains_[element.side].rows[q];
      for (std::size_t i = 0; i < element.unknowns.size(); ++i) {
        for (std::size_t j = i; j < element.unknowns.size(); ++j) {
          const std::size_t from = element.unknowns[i], to = element.unknowns[j];
          if (from != none && to != none) shear_stiffness_.at(from, to) += weight * row[i] * row[j];
        }
      }
    }
  }
}

void SpectralMesh::place_sections() {
  double start = 0.0;
  double struck = 0.0;
  for (std::size_t e = 0; e < nodes_.n_before; ++e) struck += elements_[e].length;
  for (const Element& element : elements_) {
    const auto kept = std::ranges::count_if(element.unknowns, [](auto u) { return u != none; });
    const std::size_t first = *std::ranges::min_element(element.unknowns);
    for (std::size_t q = 0; q < n_points; ++q) {
      positions_.push_back(start + gauss<n_points>.points[q] * element.length);
      weights_.push_back(copies() * gauss<n_points>.weights[q] * element.length);
      std::vector<double> row(static_cast<std::size_t>(kept), 0.0);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        const std::size_t turn = element.unknowns[2 * a + 1];
        if (turn != none) row[turn - first] = shapes.slope[q][a] / (gyration_ * element.length);
      }
      add_stencil(first, row);
    }
    start += element.length;
  }
  struck_section_ = nearest_section(struck);
}

SparseFunctional SpectralMesh::interpolated(double x, std::size_t which) const {
  std::size_t e = 0;
  double start = 0.0;
  for (; e + 1 < elements_.size() && x > start + elements_[e].length; ++e) {
    start += elements_[e].length;
  }
  const Element& element = elements_[e];
  const double place = std::clamp((x - start) / element.length, 0.0, 1.0);
  constexpr double rounding = 1e-12;
  SparseFunctional functional;
  for (std::size_t a = 0; a < n_nodes; ++a) {
    const double value = lagrange(a, place).first;
    const std::size_t unknown = element.unknowns[2 * a + which];
    if (unknown != none && std::abs(value) > rounding) functional.terms.push_back({unknown, value});
  }
  return functional;
}

std::optional<SparseFunctional> SpectralMesh::rotation_at(double x) const {
  SparseFunctional rotation;
  rotation.add(1.0 / gyration_, interpolated(x, 1));
  return rotation;
}

std::vector<BeamMesh::Slope> SpectralMesh::slopes() const {
  std::vector<Slope> all;
  for (const Element& element : elements_) {
    for (std::size_t q = 0; q < n_points; ++q) {
      all.push_back({copies() * gauss<n_points>.weights[q] * element.length, {}});
      for (std::size_t a = 0; a < n_nodes; ++a) {
        const std::size_t unknown = element.unknowns[2 * a];
        if (unknown == none) continue;
        all.back().value.terms.push_back({unknown, shapes.slope[q][a] / element.length});
      }
    }
  }
  return all;
}

const double* SpectralMesh::read(const Element& element, const double* unknowns, Values& values) {
  if (element.is_contiguous) return unknowns + element.unknowns[0];
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = element.unknowns[i] == none ? 0.0 : unknowns[element.unknowns[i]];
  }
  return values.data();
}

// What an element does to the node that it shares with the next one is added there, so that every
// force is stored once.
template <std::size_t first, std::size_t end, class StressesOf>
void SpectralMesh::add_stresses(StressesOf stresses_of, double* forces) const {
  alignas(Strains) std::array<double, n_lanes> stresses{}, before{};  // of this element, the last
  const Strains* strains_before = nullptr;
  double* shared = nullptr;
  const auto add_shared = [&] {
    for (std::size_t i = 0; i < 2 && shared != nullptr; ++i) {
      for (std::size_t q = first; q < end; ++q) {
        shared[i] -= before[q] * strains_before->rows[q][n_lanes + i];
      }
    }
    shared = nullptr;
  };
  for (const Element& element : elements_) {
    const Strains& strains = strains_[element.side];
    stresses_of(element, strains, stresses.data());
    if (!element.is_contiguous) {
      add_shared();
      for (std::size_t i = 0; i < element.unknowns.size(); ++i) {
        if (element.unknowns[i] == none) continue;
        for (std::size_t q = first; q < end; ++q) {
          forces[element.unknowns[i]] -= stresses[q] * strains.rows[q][i];
        }
      }
      continue;
    }
    double* f = forces + element.unknowns[0];
    Lanes even = lanes_at(f), odd{};
    for (std::size_t q = first; q < end; q += 2) {
      even -= stresses[q] * lanes_at(strains.rows[q].data());
      odd -= stresses[q + 1] * lanes_at(strains.rows[q + 1].data());
    }
    for (std::size_t q = first; q < end && shared != nullptr; q += 2) {
      even -= before[q] * lanes_at(strains_before->rows[q].data() + n_lanes);
      odd -= before[q + 1] * lanes_at(strains_before->rows[q + 1].data() + n_lanes);
    }
    store(even + odd, f);
    shared = f + n_lanes;
    before = stresses;
    strains_before = &strains;
  }
  add_shared();
}

void SpectralMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  Values values;
  double* k = kappa.data();
  for (const Element& element : elements_) {
    const double* v = read(element, unknowns.data(), values);
    const auto of = [&](std::size_t i) {
      return lanes_at(strains_[element.side].columns[i].data()) * v[i];
    };
    const Lanes all = (of(1) + of(5) + of(9)) + (of(3) + of(7));
    for (std::size_t q = 0; q < n_points; ++q) *k++ = all[of_bending + q];
  }
}

Lanes SpectralMesh::strains_of(const Element& element, const double* unknowns) const {
  Values values;
  const double* v = read(element, unknowns, values);
  const auto of = [&](std::size_t i) {
    return lanes_at(strains_[element.side].columns[i].data()) * v[i];
  };
  Lanes even = of(0), odd = of(1);
  for (std::size_t i = 2; i < values.size(); i += 2) {
    even += of(i);
    odd += of(i + 1);
  }
  return even + odd;
}

void SpectralMesh::put_bending(const Strains& strains, const double* moments, double* stresses) {
  for (std::size_t q = 0; q < n_points; ++q) {
    stresses[of_bending + q] = strains.weights[of_bending + q] * moments[q];
  }
}

void SpectralMesh::put_shear(const Element& element, const double* unknowns,
                             double* stresses) const {
  const auto& weights = strains_[element.side].weights;
  store(strains_of(element, unknowns) * lanes_at(weights.data()), stresses);
}

void SpectralMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
  const double* m = moments.data();
  const auto of = [&](const Element&, const Strains& strains, double* stresses) {
    put_bending(strains, std::exchange(m, m + n_points), stresses);
  };
  add_stresses<of_bending, of_bending + n_points>(of, forces.data());
}

void SpectralMesh::add_shear_forces(std::span<const double> unknowns,
                                    std::span<double> forces) const {
  const auto of = [&](const Element& element, const Strains&, double* stresses) {
    put_shear(element, unknowns.data(), stresses);
  };
  add_stresses<of_shear, of_shear + n_points>(of, forces.data());
}

void SpectralMesh::internal_forces(std::span<const double> unknowns,
                                   std::span<const double> moments,
                                   std::span<double> forces) const {
  std::fill(forces.begin(), forces.end(), 0.0);
  const double* m = moments.data();
  const auto of = [&](const Element& element, const Strains& strains, double* stresses) {
    put_shear(element, unknowns.data(), stresses);
    put_bending(strains, std::exchange(m, m + n_points), stresses);
  };
  add_stresses<0, 2 * n_points>(of, forces.data());
}

double SpectralMesh::shear_energy(std::span<const double> unknowns) const {
  double sum = 0.0;
  for (const Element& element : elements_) {
    const Lanes strains = strains_of(element, unknowns.data());
    for (std::size_t q = of_shear; q < of_shear + n_points; ++q) {
      sum += strains_[element.side].weights[q] * strains[q] * strains[q];
    }
  }
  return 0.5 * sum;
}

// No assembly of elements, and no support, has a higher frequency than its highest element.
double SpectralMesh::highest_frequency(double bending_stiffness) const {
  double highest = 0.0;
  for (const Element* element : {&elements_.front(), &elements_.back()}) {
    const double length = element->length;
    Eigen::Matrix<double, 2 * n_nodes, 2 * n_nodes> stiffness;
    stiffness.setZero();
    for (std::size_t q = 0; q < n_points; ++q) {
      Eigen::Matrix<double, 2 * n_nodes, 1> bend, shear;
      const auto& rows = strains_[element->side].rows;
      for (std::size_t k = 0; k < 2 * n_nodes; ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        // Scaled by the root of the mass, which w and r phi share.
        const double root = std::sqrt(mass_per_length_ * length * node_weights[k / 2]);
        bend(i) = rows[of_bending + q][k] / root;
        shear(i) = rows[of_shear + q][k] / root;
      }
      const double weight = length * gauss<n_points>.weights[q];
      stiffness += weight * bending_stiffness * bend * bend.transpose() +
                   weight * shear_stiffness_per_length_ * shear * shear.transpose();
    }
    highest = std::max(highest, largest_eigenvalue(stiffness));
  }
  return std::sqrt(highest);
}

}  // namespace subimpact
