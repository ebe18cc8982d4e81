#include "model/cell_modes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

using std::numbers::pi;
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

// What a wave number theta brings with it.
struct Wave {
  double s, sigma, phi, sinh_phi;
  double stretch;  // 1 + rho s

  Wave(double theta, double rho) {
    const double half = 2.0 * std::sin(0.5 * theta);
    s = half * half;
    stretch = 1.0 + rho * s;
    sigma = s / stretch;
    phi = 2.0 * std::asinh(0.5 * std::sqrt(sigma));
    sinh_phi = std::sqrt(sigma + 0.25 * sigma * sigma);
  }
};

// Free-end condition, as a function of y = theta c.
double end_condition(double y, double c, double rho, bool symmetric) {
  const double theta = y / c;
  const Wave wave(theta, rho);
  const double decay = std::tanh(wave.phi * c);
  const double bracket =
      wave.stretch * wave.stretch *
          (0.5 * wave.sigma + wave.sinh_phi * (symmetric ? decay : 1.0 / decay)) +
      0.5 * wave.s;
  return symmetric ? std::sin(y) * std::sin(theta) + bracket * std::cos(y)
                   : std::cos(y) * std::sin(theta) - bracket * std::sin(y);
}

// Shape at distances d = c, c - 1, ... >= 0 from the middle.
void fill_shape(double theta, double c, double rho, bool symmetric, std::span<double> shape) {
  const Wave wave(theta, rho);
  const double step = std::exp(-wave.phi);
  const double full = std::exp(-2.0 * wave.phi * c);
  const double sign = symmetric ? 1.0 : -1.0;
  const double at_end = symmetric ? std::cos(theta * c) : std::sin(theta * c);
  const double amplitude = wave.stretch * at_end / (1.0 + sign * full);
  const double cosine = std::cos(theta);
  const double sine = std::sin(theta);
  // Rotated inwards from the end, cell by cell: cos and sin of theta d, e^-phi(c - d), e^-phi(c +
  // d).
  double x = std::cos(theta * c);
  double y = std::sin(theta * c);
  double near = 1.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double far = near > 0.0 ? full / near : 0.0;
    shape[i] = (symmetric ? x : y) + amplitude * (near + sign * far);
    const double turned = x * cosine + y * sine;
    y = y * cosine - x * sine;
    x = turned;
    near *= step;
    if (near < 1e-300) near = 0.0;
  }
}

}  // namespace

NaturalModes free_cell_modes(const CellChain& chain, bool symmetric_only, std::size_t n_kept) {
  const double c = 0.5 * (static_cast<double>(chain.n_cells) - 1.0);
  const double dx2 = chain.spacing * chain.spacing;
  const double rho = chain.rotary_inertia / (chain.mass_per_length * dx2);
  const double unit = std::sqrt(chain.bending_stiffness / chain.mass_per_length) / dx2;
  const std::size_t n_modes = symmetric_only ? (chain.n_cells + 1) / 2 : chain.n_cells;
  NaturalModes modes;
  modes.frequencies.assign(n_modes, 0.0);
  modes.shapes.assign(n_modes * n_kept, 1.0);
  std::size_t next = 1;
  if (!symmetric_only) {
    for (std::size_t i = 0; i < n_kept; ++i) {
      modes.shapes[n_kept + i] = static_cast<double>(i) - c;
    }
    next = 2;
  }
  for (std::size_t number = 1; next < n_modes; ++number, ++next) {
    const bool symmetric = symmetric_only || number % 2 == 1;
    const double k = static_cast<double>(symmetric_only ? number : (number + 1) / 2);
    const double low = symmetric ? (k - 0.5) * pi : k * pi;
    // Where rotary inertia outweighs all else, the root is at the lower end to rounding.
    const double y = root_in([&](double at) { return end_condition(at, c, rho, symmetric); },
                             (1.0 - rounding) * low, low + 0.5 * pi);
    const Wave wave(y / c, rho);
    modes.frequencies[next] = unit * wave.s / std::sqrt(wave.stretch);
    const std::span<double> shape(modes.shapes.data() + next * n_kept, n_kept);
    const std::size_t n_half = (chain.n_cells + 1) / 2;
    fill_shape(y / c, c, rho, symmetric, shape.first(std::min(n_half, n_kept)));
    for (std::size_t i = n_half; i < n_kept; ++i) {
      shape[i] = (symmetric ? 1.0 : -1.0) * shape[chain.n_cells - 1 - i];
    }
  }
  return modes;
}

}  // namespace subimpact
