#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "model/mesh/modes.h"
#include "model/mesh/shear/secular_equation.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "numerics/dense.h"
#include "numerics/gauss.h"

// A chain of equal elements whose ends are pinned, or whose ends move but do not turn, has waves
// for modes: a problem of eight unknowns for each wave number. A free end is one of the latter kind
// with its rotation released. Released together with a rigid rotation about mid-span, or with a
// uniform curvature, it is coupled to the waves by inertia alone: one equation for each parity,
// between whose poles, the frequencies squared of the waves, lies one root each (docs/theory.md).

namespace subimpact {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Array = Eigen::ArrayXd;
constexpr int n_values = 2 * static_cast<int>(SpectralMesh::n_nodes);  // that an element reads
constexpr int n_own = n_values - 2;  // of its first four nodes: the next element has the fifth
using Values = Eigen::Matrix<double, n_values, 1>;
using Strains = Eigen::Matrix<double, n_own, n_values>;
using Own = Eigen::Matrix<double, n_own, 1>;

struct Chain {
  std::size_t n_elements;  // of the whole beam
  double length;           // of an element, m
  double gyration;         // m, the unit of rotations
  bool pinned;
  Strains strains;  // of an element: their product with themselves is its stiffness matrix
  Values masses;    // of an element, kg
  // Of each element kept without its last node, and of the last node of all; -1: held, or the
  // rotation of a free end.
  std::vector<std::array<Eigen::Index, n_own>> unknowns;
  std::vector<Eigen::Index> end_rotations;  // of free ends
  Vector mass, translation;                 // of all unknowns
  Array from_middle;                        // x less that of mid-span, m
};

// Of unit mass in the whole chain. Element e has the values cos(theta e) even - sin(theta e) odd,
// theta = pi k / n; where ends are pinned, sin(theta e) even + cos(theta e) odd.
struct Wave {
  double square;  // omega^2
  std::size_t k;
  Own even, odd;
};

// Values of an element from eight numbers. The real part is symmetric about the first node, with
// rotations antisymmetric, the imaginary part the other way round: there and at mid-element
// displacements are real, rotations imaginary, but for the phase.
Eigen::Matrix<Complex, n_values, n_own> field_of(double theta) {
  constexpr Complex i(0.0, 1.0);
  const double half = std::sqrt(0.5);
  Eigen::Matrix<Complex, n_values, n_own> field;
  field.setZero();
  field(0, 0) = field(4, 6) = 1.0;
  field(1, 1) = field(5, 7) = i;
  field(2, 2) = field(6, 2) = half;
  field(2, 3) = field(3, 4) = field(7, 4) = half * i;
  field(6, 3) = -half * i;
  field(3, 5) = half;
  field(7, 5) = -half;
  field.bottomRows<2>() = field.topRows<2>();
  for (int row = 0; row < n_values; ++row) {
    const int node = row / 2;
    field.row(row) *= std::polar(1.0, theta * node / SpectralMesh::degree);
  }
  return field;
}

void add_waves(const Chain& chain, std::size_t k, std::vector<Wave>& waves) {
  const auto n = static_cast<double>(chain.n_elements);
  const auto field = field_of(pi * static_cast<double>(k) / n);
  const auto& m = chain.masses;
  Own inertia;
  inertia << m(0) + m(8), m(1) + m(9), m(2), m(2), m(3), m(3), m(4), m(5);
  const Own scale = inertia.unaryExpr([](double x) { return 1.0 / std::sqrt(x); });
  const Eigen::Matrix<double, n_values, n_own> even = field.real() * scale.asDiagonal();
  const Eigen::Matrix<double, n_values, n_own> odd = field.imag() * scale.asDiagonal();
  const Eigen::Matrix<double, n_own, n_own> of_even = chain.strains * even;
  const Eigen::Matrix<double, n_own, n_own> of_odd = chain.strains * odd;
  const Matrix shapes =
      eigen_pairs(of_even.transpose() * of_even + of_odd.transpose() * of_odd).vectors;
  for (int j = 0; j < n_own; ++j) {
    const Own y = shapes.col(j);
    const double square = (of_even * y).squaredNorm() + (of_odd * y).squaredNorm();
    // At theta = 0 and pi one half of them is zero in the chain, being of the other ends.
    const bool is_standing = k == 0 || k == chain.n_elements;
    const Values part = (chain.pinned ? odd : even) * y;
    const double mass = is_standing ? chain.masses.dot(part.cwiseAbs2()) : 0.5;
    if (mass < 0.5) continue;
    const double size = 1.0 / std::sqrt(n * mass);
    waves.push_back({square, k, size * (even * y).head<n_own>(), size * (odd * y).head<n_own>()});
  }
}

// Those of every second wave number, ascending.
std::vector<Wave> waves_of(const Chain& chain, std::size_t first) {
  std::vector<Wave> waves;
  for (std::size_t k = first; k <= chain.n_elements; k += 2) add_waves(chain, k, waves);
  std::ranges::sort(waves, {}, &Wave::square);
  return waves;
}

// The field of a free chain that turns its ends: a uniform curvature of 1/m without shear and
// without momentum, or a rigid rotation about mid-span.
Vector released_field(const Chain& chain, bool bent) {
  const Array& x = chain.from_middle;
  const Array moves = chain.translation.array(), turns = chain.gyration * (1.0 - moves);
  if (!bent) return moves * x + turns;
  const Vector field = moves * x.square() / 2.0 + turns * x;
  const Vector momentum = chain.mass.cwiseProduct(chain.translation);
  return field - momentum.dot(field) / momentum.dot(chain.translation) * chain.translation;
}

template <class Function>
void for_each_unknown(const Chain& chain, Function function) {
  for (std::size_t e = 0; e < chain.unknowns.size(); ++e) {
    for (std::size_t i = 0; i < n_own; ++i) {
      if (chain.unknowns[e][i] >= 0) function(index(e), index(i), chain.unknowns[e][i]);
    }
  }
}

// Modes that are alike on both sides of mid-span, or opposite.
struct Family {
  bool even;
  std::vector<Wave> waves;
  Matrix phases;  // by elements; rows 2 floor(k/2) and the next: factors of even and odd
  // Of free ends: the field that turns them, and its products of inertia with the waves.
  Vector released, inertia;
  Poles poles;
};

Matrix phases_of(const Chain& chain, std::size_t first) {
  const std::size_t n = chain.n_elements;
  Matrix phases = Matrix::Zero(2 * index(n / 2 + 1), index(chain.unknowns.size()));
  for (std::size_t k = first; k <= n; k += 2) {
    for (std::size_t e = 0; e < chain.unknowns.size(); ++e) {
      const double angle = pi * static_cast<double>(k * e % (2 * n)) / static_cast<double>(n);
      const double c = std::cos(angle), s = std::sin(angle);
      phases.col(index(e)).segment<2>(2 * index(k / 2)) << (chain.pinned ? s : c),
          (chain.pinned ? c : -s);
    }
  }
  return phases;
}

Family family_of(const Chain& chain, bool even, double bending_stiffness) {
  const std::size_t first = even == chain.pinned ? 1 : 0;
  Family family{even, waves_of(chain, first), phases_of(chain, first), {}, {}, {}};
  const std::vector<Wave>& waves = family.waves;
  Poles& poles = family.poles;
  poles.at.resize(index(waves.size()));
  for (std::size_t i = 0; i < waves.size(); ++i) poles.at(index(i)) = waves[i].square;
  if (chain.pinned) return family;
  family.released = released_field(chain, even);
  const Vector momentum = chain.mass.cwiseProduct(family.released);
  Matrix by_elements = Matrix::Zero(n_own, index(chain.unknowns.size()));
  for_each_unknown(chain, [&](Eigen::Index e, Eigen::Index i, Eigen::Index unknown) {
    by_elements(i, e) = momentum(unknown);
  });
  const Matrix by_waves = by_elements * family.phases.transpose();
  family.inertia.resize(poles.size());
  for (std::size_t i = 0; i < waves.size(); ++i) {
    const Eigen::Index k = 2 * index(waves[i].k / 2);
    family.inertia(index(i)) =
        waves[i].even.dot(by_waves.col(k)) + waves[i].odd.dot(by_waves.col(k + 1));
  }
  poles.weight = family.inertia.array().square() * poles.at;
  if (even) {  // the first wave is the rigid translation: a curvature's pole is at its place
    poles.at(0) = 0.0;
    poles.weight(0) = bending_stiffness * chain.length * static_cast<double>(chain.n_elements);
  }
  return family;
}

struct Mode {
  const Family* family = nullptr;
  SecularRoot square;  // omega^2
  bool is_rigid = false, is_between_close_poles = false;
  Eigen::Index wave = -1;  // that it is, where ends are pinned
};

// False if two poles are too close, or a wave is not coupled to the field that turns the ends.
bool add_modes(const Chain& chain, const Family& family, std::vector<Mode>& modes) {
  const Poles& poles = family.poles;
  if (chain.pinned) {
    for (Eigen::Index i = 0; i < poles.size(); ++i) {
      modes.push_back({&family, {poles.at(i), 0.0}, false, false, i});
    }
    return true;
  }
  if (!(poles.weight > 0.0).all()) return false;
  modes.push_back({&family, {0.0, 0.0}, true});
  double at_ends = 0.0;
  for (const Eigen::Index end : chain.end_rotations) {
    at_ends += chain.mass(end) * family.released(end) * family.released(end);
  }
  for (Eigen::Index i = 1; i < poles.size(); ++i) {
    const double gap = 1.0 - poles.at(i - 1) / poles.at(i);
    if (!(gap > apart_poles)) return false;
    const SecularRoot root = root_below(poles, i, [&](double) { return -at_ends; });
    modes.push_back({&family, root, false, gap < close_poles});
  }
  modes.push_back({&family, root_above(poles, -at_ends)});
  return true;
}

// Writes the shapes of a few modes of one family.
void write_shapes(const Chain& chain, const Family& family, const std::vector<Mode>& modes,
                  std::span<const std::size_t> numbers, Eigen::Map<Matrix> shapes) {
  const Poles& poles = family.poles;
  Matrix waves = Matrix::Zero(n_own * index(numbers.size()), family.phases.rows());
  for (std::size_t m = 0; m < numbers.size(); ++m) {
    const Mode& mode = modes[numbers[m]];
    const Vector shares =
        mode.wave < 0 ? Vector(family.inertia.array() * poles.at / mode.square.distances(poles))
                      : Vector(Vector::Unit(poles.size(), mode.wave));
    for (std::size_t i = 0; i < family.waves.size(); ++i) {
      const Wave& wave = family.waves[i];
      const Eigen::Index k = 2 * index(wave.k / 2);
      waves.col(k).segment<n_own>(n_own * index(m)) += shares(index(i)) * wave.even;
      waves.col(k + 1).segment<n_own>(n_own * index(m)) += shares(index(i)) * wave.odd;
    }
    for (const Eigen::Index end : chain.end_rotations) {
      shapes(end, index(numbers[m])) = family.released(end);
    }
  }
  const Matrix values = waves * family.phases;
  for (std::size_t m = 0; m < numbers.size(); ++m) {
    for_each_unknown(chain, [&](Eigen::Index e, Eigen::Index i, Eigen::Index unknown) {
      shapes(unknown, index(numbers[m])) = values(n_own * index(m) + i, e);
    });
  }
}

// Orthonormal, without frequencies.
std::optional<NaturalModes> modes_of(const Chain& chain, bool half, double bending_stiffness,
                                     const BandedMatrix& mass) {
  constexpr std::size_t block = 20;  // stays in the cache; columns a power of 2 apart would not
  std::vector<Family> families = {family_of(chain, true, bending_stiffness)};
  if (!half) families.push_back(family_of(chain, false, bending_stiffness));
  std::vector<Mode> modes;
  for (const Family& family : families) {
    if (!add_modes(chain, family, modes)) return std::nullopt;
  }
  std::ranges::stable_sort(modes, {}, [](const Mode& mode) { return mode.square.value(); });
  const std::size_t n = modes.size();
  NaturalModes found{std::vector<double>(n), std::vector<double>(n * n)};
  Eigen::Map<Matrix> shapes(found.shapes.data(), index(n), index(n));
  for (const Family& family : families) {
    if (!chain.pinned) {  // the rigid modes come first
      shapes.col(family.even ? 0 : 1) = family.even ? chain.translation : family.released;
    }
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < n; ++i) {
      if (modes[i].family == &family && !modes[i].is_rigid) numbers.push_back(i);
    }
    for (std::size_t first = 0; first < numbers.size(); first += block) {
      const std::size_t count = std::min(block, numbers.size() - first);
      write_shapes(chain, family, modes, std::span(numbers).subspan(first, count), shapes);
    }
  }
  normalise(found, mass);
  for (std::size_t k = 0; k < n; ++k) {
    if (modes[k].is_between_close_poles) make_orthogonal(found, k, mass);
  }
  return found;
}

}  // namespace

bool SpectralMesh::has_closed_modes() const {
  constexpr double rounding = 1e-12;
  return nodes_.ends[0] == nodes_.ends[1] && nodes_.ends[0] != EndSupport::clamped &&
         std::abs(elements_.back().length / elements_.front().length - 1.0) < rounding;
}

// Measured: half models of 401 and 961 unknowns take 3.1 and 23 ms, decomposed, which counts n^3/2,
// 24 and 303 ms.
double SpectralMesh::closed_modes_work() const {
  return 0.05 * std::pow(static_cast<double>(n_unknowns()), 3);
}

NaturalModes SpectralMesh::natural_modes(double bending_stiffness) const {
  if (!has_closed_modes()) return dense_natural_modes(*this, bending_stiffness);
  Chain chain;
  chain.n_elements = nodes_.n_elements_whole();
  chain.length = elements_.front().length;
  chain.gyration = gyration_;
  chain.pinned = nodes_.ends[0] == EndSupport::pinned;
  for (std::size_t q = 0; q < n_own; ++q) {
    const double weight = chain.length * gauss<n_points>.weights[q % n_points];
    const double stiffness = q < of_bending ? shear_stiffness_per_length_ : bending_stiffness;
    for (std::size_t i = 0; i < n_values; ++i) {
      chain.strains(index(q), index(i)) =
          std::sqrt(stiffness * weight) * strains_[elements_.front().side].rows[q][i];
    }
  }
  for (std::size_t i = 0; i < n_values; ++i) {
    chain.masses(index(i)) = mass_per_length_ * chain.length * node_weights[i / 2];
  }
  const std::size_t n_kept = elements_.size();
  chain.unknowns.resize(n_kept + 1);
  chain.mass = chain.translation = Vector::Zero(index(n_unknowns()));
  chain.from_middle = chain.mass;
  for (std::size_t e = 0; e <= n_kept; ++e) {
    for (std::size_t i = 0; i < n_own; ++i) {
      const bool is_last = e == n_kept;
      const std::size_t unknown = !is_last ? elements_[e].unknowns[i]
                                  : i < 2  ? elements_.back().unknowns[n_own + i]
                                           : none;
      chain.unknowns[e][i] = index(unknown);
      if (unknown == none) continue;
      const double from_first = static_cast<double>(e) + nodes[i / 2];
      const Eigen::Index k = index(unknown);
      chain.mass(k) = mass_.at(unknown, unknown);
      chain.from_middle(k) =
          chain.length * (from_first - 0.5 * static_cast<double>(nodes_.n_elements_whole()));
      chain.translation(k) = i % 2 == 0 ? 1.0 : 0.0;
    }
  }
  if (!chain.pinned) {
    chain.end_rotations = {std::exchange(chain.unknowns.front()[1], -1)};
    if (!symmetric()) chain.end_rotations.push_back(std::exchange(chain.unknowns.back()[1], -1));
  }
  std::optional<NaturalModes> modes = modes_of(chain, symmetric(), bending_stiffness, mass());
  if (!modes) return dense_natural_modes(*this, bending_stiffness);
  complete(*modes, *this, bending_stiffness);
  return std::move(*modes);
}

}  // namespace subimpact
