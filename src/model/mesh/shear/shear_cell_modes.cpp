#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <vector>

#include "model/mesh/modes.h"
#include "model/mesh/shear/secular_equation.h"
#include "numerics/lanes.h"

// A chain whose ends do not turn (phi = 0 at the end faces, no shear force) has waves for modes.
// A free end is such an end without the section of its end cell, and with the rotary inertia of
// half a cell more, both on the rotation of the first face: one equation for each parity, between
// whose poles, the frequencies squared of the waves, lies one root each (docs/theory.md).

namespace subimpact {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using Array = Eigen::ArrayXd;

// Frequencies squared of waves, and their part in the rotation of the first face.
Poles poles_of(const ShearCellChain& chain, bool symmetric) {
  struct Pole {
    double lambda, weight;
  };
  std::vector<Pole> poles;
  const auto n = static_cast<double>(chain.n_cells);
  for (std::size_t k = symmetric ? 2 : 1; k < chain.n_cells; k += 2) {
    const double theta = pi * static_cast<double>(k) / n;
    const double g = 2.0 * std::sin(0.5 * theta) / chain.spacing;
    // Of w and phi, scaled by the roots of their inertia.
    const double shear = chain.shear_stiffness * g * g / chain.mass_per_length;
    const double bend = chain.bending_stiffness * g * g / chain.rotary_inertia;
    const double turn = bend + chain.shear_stiffness / chain.rotary_inertia;
    const double coupling =
        chain.shear_stiffness * g / std::sqrt(chain.mass_per_length * chain.rotary_inertia);
    const double half = 0.5 * (turn - shear);
    const double root = std::hypot(half, coupling);
    const double high = 0.5 * (shear + turn) + root;
    const double more = 0.5 * (1.0 + std::abs(half) / root);
    const double less = coupling * coupling / (2.0 * root * (root + std::abs(half)));
    const double unit =
        4.0 * std::pow(std::sin(theta), 2) / (chain.rotary_inertia * chain.spacing * n);
    poles.push_back({shear * bend / high, unit * (half > 0.0 ? less : more)});
    poles.push_back({high, unit * (half > 0.0 ? more : less)});
  }
  std::ranges::sort(poles, {}, &Pole::lambda);
  const auto size = static_cast<Eigen::Index>(poles.size());
  Poles sorted{Array(size), Array(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    sorted.at[i] = poles[static_cast<std::size_t>(i)].lambda;
    sorted.weight[i] = poles[static_cast<std::size_t>(i)].weight;
  }
  return sorted;
}

// Adds the real parts of values[0], values[1] ratio, values[0] ratio^2, values[1] ratio^3, ... to
// the entries of a shape, from the first on or from the last one back, as far as they are felt.
// In real numbers: products of complex ones look for NaN.
void add_powers(std::span<double> shape, bool backward, std::array<Complex, 2> values,
                Complex ratio) {
  constexpr double felt = 1e-280;  // numbers with fewer digits are slow
  const double decay = -std::log(std::abs(ratio));
  const double range =
      std::log(std::max(std::abs(values[0]), std::abs(values[1]))) - std::log(felt);
  if (!(range > 0.0)) return;
  const std::size_t size = shape.size();
  const auto n =
      range > static_cast<double>(size) * decay ? size : static_cast<std::size_t>(range / decay);
  Lanes a, b;  // real and imaginary parts of eight
  Complex power = 1.0;
  for (std::size_t k = 0; k < n_lanes; ++k) {
    const Complex value = values[k % 2] * power;
    const std::size_t lane = backward ? n_lanes - 1 - k : k;
    a[lane] = value.real();
    b[lane] = value.imag();
    power *= ratio;
  }
  const double re = power.real(), im = power.imag();
  for (std::size_t i = 0; i < n; i += n_lanes) {
    if (i + n_lanes <= size) {
      double* const at = shape.data() + (backward ? size - i - n_lanes : i);
      store(lanes_at(at) + a, at);
    } else {
      for (std::size_t k = 0; i + k < size; ++k) {
        shape[backward ? size - 1 - i - k : i + k] += a[backward ? n_lanes - 1 - k : k];
      }
    }
    const Lanes turned = a * re - b * im;
    b = a * im + b * re;
    a = turned;
  }
}

// Adds one of the two waves of a frequency to the displacements and rotations from the end to the
// middle. `square` is g^2, `rest` g^2 - lambda rho A / kGA.
void add_wave(const ShearCellChain& chain, double square, double rest, bool symmetric,
              double factor, std::span<double> shape) {
  const double s = 0.25 * square * chain.spacing * chain.spacing;
  const double sine = std::sqrt(std::abs(s));
  const Complex half = s < 0.0   ? Complex(0.0, std::asinh(sine))  // theta / 2
                       : s < 1.0 ? Complex(std::asin(sine), 0.0)
                                 : Complex(0.5 * pi, std::acosh(sine));
  const auto power = [&](std::size_t count) {  // of e^(i theta / 2)
    const auto n = static_cast<double>(count);
    return std::polar(std::exp(-n * half.imag()), n * half.real());
  };
  const double sign = symmetric ? 1.0 : -1.0;
  const std::size_t from_end_to_end = 2 * chain.n_cells;
  // A wave that does not decay has at the far end the conjugate of what it has at the near one.
  const bool decays = half.imag() > 0.0;
  const Complex scale = (decays ? 1.0 : 2.0) * factor / (1.0 - sign * power(from_end_to_end));
  const Complex g = (s < 0.0 ? Complex(0.0, 2.0) : Complex(2.0)) * sine / chain.spacing;
  const Complex units[] = {Complex(0.0, -1.0) * g * scale, chain.gyration * rest * scale};
  const Complex ratio = power(1);
  add_powers(shape, false, {units[0] * ratio, units[1] * ratio}, ratio);
  if (!decays) return;
  const std::size_t last = (shape.size() - 1) % 2;  // whether a rotation
  const Complex of_far = (last == 0 ? sign : -sign) * power(from_end_to_end - shape.size());
  add_powers(shape, true, {of_far * units[last], -of_far * units[1 - last]}, ratio);
}

void fill_shape(const ShearCellChain& chain, double lambda, bool symmetric,
                std::span<double> shape) {
  const double inertia = lambda * chain.mass_per_length;
  const double of_shear = inertia / chain.shear_stiffness;
  const double of_bending = inertia / chain.bending_stiffness;
  const double middle = 0.5 * (lambda * chain.rotary_inertia / chain.bending_stiffness - of_shear);
  const double root = std::sqrt(middle * middle + of_bending);
  const double first = middle > 0.0 ? middle + root : of_bending / (root - middle);
  const double second = -of_bending / first;
  const double square = first + of_shear;
  const double other = of_shear * (lambda * chain.rotary_inertia - chain.shear_stiffness) /
                       (chain.bending_stiffness * square);
  // Shear forces at the end cancel.
  add_wave(chain, square, first, symmetric, 1.0, shape);
  add_wave(chain, other, second, symmetric, -1.0, shape);
}

}  // namespace

std::optional<NaturalModes> shear_cell_modes(const ShearCellChain& chain, bool symmetric_only,
                                             const BandedMatrix& mass) {
  const double dx = chain.spacing;
  const double a = chain.bending_stiffness / dx;
  const double b = 0.5 * chain.rotary_inertia * dx;
  const auto right = [&](double lambda) { return 1.0 / (a + b * lambda); };
  struct Root {
    double lambda;
    bool symmetric, is_between_close_poles;
  };
  std::vector<Root> roots;
  for (const bool symmetric : {true, false}) {
    if (!symmetric && symmetric_only) break;
    const Poles poles = poles_of(chain, symmetric);
    // The first antisymmetric root is the rigid rotation's.
    for (Eigen::Index i = symmetric ? 0 : 1; i < poles.at.size(); ++i) {
      const double gap = i > 0 ? 1.0 - poles.at[i - 1] / poles.at[i] : 1.0;
      if (!(gap > apart_poles)) return std::nullopt;
      roots.push_back({root_below(poles, i, right).value(), symmetric, gap < close_poles});
    }
  }
  std::ranges::sort(roots, {}, &Root::lambda);

  const std::size_t n_rigid = symmetric_only ? 1 : 2;
  const std::size_t n = symmetric_only ? chain.n_cells : 2 * chain.n_cells - 1;
  const std::size_t n_half = chain.n_cells;
  NaturalModes modes;
  modes.frequencies.assign(n_rigid, 0.0);
  modes.shapes.assign(n * n, 0.0);
  const auto shape = [&](std::size_t k) { return std::span(modes.shapes).subspan(k * n, n); };
  const double middle = 0.5 * (static_cast<double>(chain.n_cells) - 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_node = i % 2 == 0;
    shape(0)[i] = is_node ? 1.0 : 0.0;
    if (symmetric_only) continue;
    shape(1)[i] = is_node ? (0.5 * static_cast<double>(i) - middle) * dx : chain.gyration;
  }
  for (std::size_t k = 0; k < roots.size(); ++k) {
    modes.frequencies.push_back(std::sqrt(roots[k].lambda));
    const std::span<double> values = shape(n_rigid + k);
    const bool symmetric = roots[k].symmetric;
    fill_shape(chain, roots[k].lambda, symmetric, values.first(n_half));
    for (std::size_t i = n_half; i < n; ++i) {
      const bool alike = symmetric == (i % 2 == 0);
      values[i] = (alike ? 1.0 : -1.0) * values[n - 1 - i];
    }
  }
  normalise(modes, mass);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    if (roots[k].is_between_close_poles) make_orthogonal(modes, n_rigid + k, mass);
  }
  return modes;
}

}  // namespace subimpact
