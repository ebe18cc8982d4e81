#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "ode/free_flight.h"

namespace subimpact {

/// For how long the guards of a FreeFlight can be shown to keep within their limits.
///
/// With amplitudes A_k = |(z_k, z_k'/omega_k)|, which free flight keeps, guard i moves by no more
/// than sum |g_ik| A_k, so some guards can never reach their limits. For the others the highest
/// oscillators are replaced by the bound on their share, and the rest is sampled: in an interval
/// tau guard i exceeds the larger of its values at both ends by no more than
///
///     doubt_i = sum over dropped |g_ik| A_k + tau^2/8 sum over kept |g_ik| A_k omega_k^2.
///
/// Few oscillators and long intervals clear most guards most of the time; those that could reach a
/// limit in an interval are looked at again in it with more oscillators and shorter intervals, in
/// three levels. The flight is safe up to the first interval of the last level that a guard does
/// not pass.
class SafeFlight {
 public:
  explicit SafeFlight(const FreeFlight& flight);

  /// Time (s), at most `longest`, up to which no guard reaches its limits from displacements z and
  /// their rates; 0 if that cannot be shown for any time.
  double duration(std::span<const double> z, std::span<const double> rates,
                  std::span<const double> low, std::span<const double> high, double longest);

 private:
  // A guard that could reach its limits.
  struct Watched {
    const double* coefficients;
    double low, high;
    double room;   // to the nearer limit, or what stands for it
    double swing;  // sum |g_ik| A_k
  };
  struct Level {
    std::size_t n_kept = 0;     // oscillators, the lowest
    double interval = 0.0;      // tau, s
    std::size_t n_parts = 0;    // of an interval of the level above
    std::vector<double> doubt;  // of the watched guards; below zero: not asked for yet
    // Motion of all oscillators that the last level keeps over an interval.
    std::vector<double> cosine, sine_over_omega, minus_omega_sine;
    std::vector<double> z, rates;       // at the start of the interval looked at
    std::vector<double> values;         // of the watched guards there
    std::vector<std::size_t> guards;    // those looked at on this level
    std::vector<std::size_t> in_doubt;  // of them, in this interval
  };
  bool choose_guards(std::span<const double> z, std::span<const double> low,
                     std::span<const double> high);
  void choose_levels();
  double doubt(Level& level, std::size_t i);
  void set_level(Level& level, std::size_t n_kept, double interval);
  // Of `parts` intervals of a level, begun at its z and rates: the time that is safe.
  double safe_time(std::size_t level, std::size_t parts);

  const FreeFlight& flight_;
  std::span<const double> omega_;
  std::size_t n_;
  std::size_t n_uniform_;                    // of frequency 0
  double longest_interval_;                  // a radian of the slowest oscillator, s
  std::vector<double> amplitude_, bending_;  // A_k, A_k omega_k^2
  std::vector<double> share_;                // sum over watched guards |g_ik|/room_i
  std::vector<Watched> watched_;
  static constexpr std::size_t n_levels = 3;
  std::array<Level, n_levels> levels_;
};

}  // namespace subimpact
