#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace subimpact {

/// Turning points that make small loops inside large ones: step sizes are spread evenly over three
/// decades up to `reach`, and the walk stays within [low, high].
inline std::vector<double> nested_walk(unsigned seed, std::size_t n, double low, double high,
                                       double reach) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> decades(-3.0, 0.0);
  std::bernoulli_distribution up(0.5);
  std::vector<double> points;
  double at = low > 0.0 || high < 0.0 ? 0.5 * (low + high) : 0.0;
  while (points.size() < n) {
    const double step = reach * std::pow(10.0, decades(random)) * (up(random) ? 1.0 : -1.0);
    if (at + step < low || at + step > high) continue;
    at += step;
    points.push_back(at);
  }
  return points;
}

inline std::vector<double> random_numbers(unsigned seed, std::size_t n, double size = 1.0) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> numbers(n);
  for (double& number : numbers) number = uniform(random);
  return numbers;
}

}  // namespace subimpact
