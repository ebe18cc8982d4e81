#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "model/mesh/modes.h"
#include "model/mesh/shear/secular_equation.h"
#include "model/mesh/shear/spectral_mesh.h"
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
constexpr int n_values = 2 * static_cast<int>(SpectralMesh::n_nodes);  // that an element reads
constexpr int n_own = n_values - 2;  // of them, without those of the node that the next one has too
using Values = Eigen::Matrix<double, n_values, 1>;
using Strains = Eigen::Matrix<double, n_own, n_values>;
using Own = Eigen::Matrix<double, n_own, 1>;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

struct Chain {
  std::size_t n_elements;  // of the whole beam
  double length;           // of an element, m
  double gyration;         // m, the unit of rotations
  bool pinned;
  Strains strains;  // of an element: their product with themselves is its stiffness matrix
  Values masses;    // of an element, kg
  std::vector<std::array<Eigen::Index, n_values>> unknowns;  // of elements kept; -1: held
  std::vector<Eigen::Index> end_rotations;                   // unknowns of free ends
  Vector mass, translation;                                  // of all unknowns
};

// Element e has the values cos(e theta) even - sin(e theta) odd where ends do not turn, where they
// are pinned sin(e theta) even + cos(e theta) odd; theta = pi k / n.
struct Wave {
  double square;  // omega^2
  std::size_t k;
  Values even, odd;
};

// Values of an element from eight numbers whose real part is alike on both sides of the first node:
// there and at mid-element displacements are real, rotations imaginary, but for the phase.
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
    field.row(row) *= std::polar(1.0, theta * (row / 2) / SpectralMesh::degree);
  }
  return field;
}

void add_waves(const Chain& chain, std::size_t k, std::vector<Wave>& waves) {
  const auto field = field_of(pi * static_cast<double>(k) / static_cast<double>(chain.n_elements));
  const auto& m = chain.masses;
  Own scale;
  scale << m(0) + m(8), m(1) + m(9), m(2), m(2), m(3), m(3), m(4), m(5);
  scale = scale.cwiseSqrt().cwiseInverse();
  const Eigen::Matrix<double, n_values, n_own> even = field.real() * scale.asDiagonal();
  const Eigen::Matrix<double, n_values, n_own> odd = field.imag() * scale.asDiagonal();
  const Eigen::Matrix<double, n_own, n_own> of_even = chain.strains * even;
  const Eigen::Matrix<double, n_own, n_own> of_odd = chain.strains * odd;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n_own, n_own>> solver(
      of_even.transpose() * of_even + of_odd.transpose() * of_odd);
  for (int j = 0; j < n_own; ++j) {
    const Own y = solver.eigenvectors().col(j);
    const double square = (of_even * y).squaredNorm() + (of_odd * y).squaredNorm();
    const Wave wave{square, k, even * y, odd * y};
    // At wave numbers 0 and pi one half of them vanishes in the chain.
    const Values& seen = chain.pinned ? wave.odd : wave.even;
    const bool is_seen = chain.masses.dot(seen.cwiseAbs2()) > 0.5;
    if ((k > 0 && k < chain.n_elements) || is_seen) waves.push_back(wave);
  }
}

// Those of every second wave number, ascending.
std::vector<Wave> waves_of(const Chain& chain, std::size_t first) {
  std::vector<Wave> waves;
  for (std::size_t k = first; k <= chain.n_elements; k += 2) add_waves(chain, k, waves);
  std::ranges::sort(waves, {}, &Wave::square);
  return waves;
}

// A column each, of unit mass.
Matrix shapes_of(const Chain& chain, const std::vector<Wave>& waves) {
  const std::size_t n = chain.n_elements;
  std::vector<Complex> turns;
  for (std::size_t i = 0; i < 2 * n; ++i) {
    turns.push_back(std::polar(1.0, pi * static_cast<double>(i) / static_cast<double>(n)));
  }
  const Complex phase = chain.pinned ? Complex(0.0, -1.0) : 1.0;
  Matrix shapes(chain.mass.size(), index(waves.size()));
  for (std::size_t j = 0; j < waves.size(); ++j) {
    auto shape = shapes.col(index(j));
    const Wave& wave = waves[j];
    for (std::size_t e = 0; e < chain.unknowns.size(); ++e) {
      const Complex turn = phase * turns[wave.k * e % (2 * n)];
      const Values values = turn.real() * wave.even - turn.imag() * wave.odd;
      for (std::size_t i = 0; i < n_values; ++i) {
        const Eigen::Index unknown = chain.unknowns[e][i];
        if (unknown >= 0) shape(unknown) = values(index(i));
      }
    }
    for (const Eigen::Index end : chain.end_rotations) shape(end) = 0.0;
    shape /= std::sqrt(chain.mass.dot(shape.cwiseAbs2()));
  }
  return shapes;
}

struct Mode {
  double square;  // omega^2
  Vector shape;
  bool is_between_close_poles = false;
};

// The field of a free chain that turns its ends: a uniform curvature of 1/m without shear and
// without momentum, or a rigid rotation about mid-span.
Vector released_field(const Chain& chain, bool bent) {
  Vector field(chain.mass.size());
  for (std::size_t e = 0; e < chain.unknowns.size(); ++e) {
    for (std::size_t i = 0; i < n_values; ++i) {
      const double x = chain.length * (static_cast<double>(e) + SpectralMesh::nodes[i / 2] -
                                       0.5 * static_cast<double>(chain.n_elements));
      const double displacement = bent ? 0.5 * x * x : x;
      const double rotation = chain.gyration * (bent ? x : 1.0);
      const Eigen::Index unknown = chain.unknowns[e][i];
      if (unknown >= 0) field(unknown) = i % 2 == 0 ? displacement : rotation;
    }
  }
  if (!bent) return field;
  const Vector momentum = chain.mass.cwiseProduct(chain.translation);
  return field - momentum.dot(field) / momentum.dot(chain.translation) * chain.translation;
}

// Of one parity of a free chain. `released`: the field that turns the ends; `stiffness`: twice its
// energy.
// False if two poles are too close.
bool add_free_modes(const Chain& chain, bool even, double bending_stiffness,
                    std::vector<Mode>& modes) {
  const std::vector<Wave> waves = waves_of(chain, even ? 0 : 1);
  const Matrix shapes = shapes_of(chain, waves);
  const Vector released = released_field(chain, even);
  const Vector inertia = shapes.transpose() * chain.mass.cwiseProduct(released);
  Poles poles{Vector(waves.size()), {}};
  for (std::size_t i = 0; i < waves.size(); ++i) poles.at(index(i)) = waves[i].square;
  poles.weight = inertia.array().square() * poles.at;
  if (even) {  // the first wave is the rigid translation, whose pole that of a curvature is
    poles.at(0) = 0.0;
    poles.weight(0) = bending_stiffness * chain.length * static_cast<double>(chain.n_elements);
  }
  modes.push_back({0.0, even ? chain.translation : released});
  double at_ends = 0.0;
  for (const Eigen::Index end : chain.end_rotations) {
    at_ends += chain.mass(end) * released(end) * released(end);
  }
  const auto right = [&](double) { return -at_ends; };
  Matrix shares(poles.size(), poles.size());
  Vector turns = Vector::Ones(poles.size());  // of the ends
  const std::size_t first = modes.size();
  for (Eigen::Index i = 1; i <= poles.size(); ++i) {
    const bool is_last = i == poles.size();
    const double gap = is_last ? 1.0 : 1.0 - poles.at(i - 1) / poles.at(i);
    if (!(gap > apart_poles)) return false;
    const SecularRoot root = is_last ? root_above(poles, -at_ends) : root_below(poles, i, right);
    const Eigen::ArrayXd distances = root.distances(poles);
    if ((distances == 0.0).any()) {  // a wave that does not turn the ends
      shares.col(i - 1) = (distances == 0.0).cast<double>();
      turns(i - 1) = 0.0;
    } else {
      shares.col(i - 1) = inertia.array() * poles.at / distances;
    }
    modes.push_back({root.value(), {}, gap < close_poles});
  }
  Matrix found = shapes * shares;
  for (const Eigen::Index end : chain.end_rotations) {
    found.row(end) = released(end) * turns.transpose();
  }
  for (Eigen::Index i = 0; i < found.cols(); ++i) {
    modes[first + static_cast<std::size_t>(i)].shape = found.col(i);
  }
  return true;
}

bool add_modes(const Chain& chain, bool even, double bending_stiffness, std::vector<Mode>& modes) {
  if (!chain.pinned) return add_free_modes(chain, even, bending_stiffness, modes);
  const std::vector<Wave> waves = waves_of(chain, even ? 1 : 0);
  const Matrix shapes = shapes_of(chain, waves);
  for (std::size_t i = 0; i < waves.size(); ++i) {
    modes.push_back({waves[i].square, shapes.col(index(i))});
  }
  return true;
}

}  // namespace

bool SpectralMesh::has_closed_modes() const {
  constexpr double rounding = 1e-12;
  return ends_[0] == ends_[1] && ends_[0] != EndSupport::clamped &&
         std::abs(elements_.back().length / elements_.front().length - 1.0) < rounding;
}

NaturalModes SpectralMesh::natural_modes(double bending_stiffness) const {
  if (!has_closed_modes()) return dense_natural_modes(*this, bending_stiffness);
  Chain chain;
  chain.n_elements = n_elements_;
  chain.length = elements_.front().length;
  chain.gyration = gyration_;
  chain.pinned = ends_[0] == EndSupport::pinned;
  for (std::size_t q = 0; q < n_own; ++q) {
    const double weight = chain.length * gauss<n_points>.weights[q % n_points];
    const double stiffness = q < of_bending ? shear_stiffness_per_length_ : bending_stiffness;
    for (std::size_t i = 0; i < n_values; ++i) {
      chain.strains(index(q), index(i)) =
          std::sqrt(stiffness * weight) * strains_.front().rows[q][i];
    }
  }
  for (std::size_t i = 0; i < n_values; ++i) {
    chain.masses(index(i)) = mass_per_length_ * chain.length * node_weights[i / 2];
  }
  for (const Element& element : elements_) {
    std::ranges::transform(element.unknowns, chain.unknowns.emplace_back().begin(), index);
  }
  chain.mass.resize(index(n_unknowns()));
  for (std::size_t i = 0; i < n_unknowns(); ++i) chain.mass(index(i)) = mass_.at(i, i);
  if (!chain.pinned) {
    chain.translation = Vector::Map(translation().data(), index(n_unknowns()));
    chain.end_rotations = {chain.unknowns.front()[1]};
    if (!symmetric()) chain.end_rotations.push_back(chain.unknowns.back().back());
  }

  std::vector<Mode> found;
  for (const bool even : {true, false}) {
    if (!even && symmetric()) break;
    if (!add_modes(chain, even, bending_stiffness, found)) {
      return dense_natural_modes(*this, bending_stiffness);
    }
  }
  std::ranges::stable_sort(found, {}, &Mode::square);
  NaturalModes modes;
  modes.frequencies.resize(found.size());
  for (const Mode& mode : found) {
    modes.shapes.insert(modes.shapes.end(), mode.shape.begin(), mode.shape.end());
  }
  complete(modes, *this, bending_stiffness);
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].is_between_close_poles) make_orthogonal(modes, k, mass());
  }
  return modes;
}

}  // namespace subimpact
