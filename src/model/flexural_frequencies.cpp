#include "model/flexural_frequencies.h"

#include <cmath>

namespace subimpact {
namespace {

// Frequency function of mode i = 1, 2, ... (odd: symmetric), continuous in beta.
double frequency_function(double beta, double slenderness, bool symmetric) {
  const double b4 = std::pow(beta, 4);
  const double inertia = b4 * slenderness * slenderness;
  const double a = std::sqrt(0.5 * (inertia + std::sqrt(inertia * inertia + 4.0 * b4)));
  const double b = beta * beta / a;
  const double ratio = std::pow(b / a, 3);
  const double decay = std::tanh(0.5 * b);
  return symmetric ? ratio * std::sin(0.5 * a) + std::cos(0.5 * a) * decay
                   : std::sin(0.5 * a) - ratio * std::cos(0.5 * a) * decay;
}

}  // namespace

std::vector<double> free_free_wave_numbers(double slenderness, std::size_t n) {
  std::vector<double> roots;
  double beta = 1.0;  // well below the first root, well above the rigid modes
  for (std::size_t mode = 1; mode <= n; ++mode) {
    const bool symmetric = mode % 2 == 1;
    const auto f = [&](double x) { return frequency_function(x, slenderness, symmetric); };
    double low = beta;
    double high = low + 0.05;
    while (f(low) * f(high) > 0.0) {
      low = high;
      high += 0.05;
    }
    const double at_low = f(low);
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (f(middle) * at_low > 0.0 ? low : high) = middle;
    }
    beta = 0.5 * (low + high);
    roots.push_back(beta);
  }
  return roots;
}

std::vector<double> free_free_frequencies(const Beam& beam, std::size_t n) {
  const double slenderness =
      beam.theory == BeamTheory::rayleigh ? beam.radius_of_gyration() / beam.length : 0.0;
  const double unit =
      std::sqrt(beam.bending_stiffness() / beam.mass_per_length()) / (beam.length * beam.length);
  std::vector<double> frequencies;
  for (const double beta : free_free_wave_numbers(slenderness, n)) {
    frequencies.push_back(unit * beta * beta);
  }
  return frequencies;
}

}  // namespace subimpact
