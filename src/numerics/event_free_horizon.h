#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace subimpact {

/// A proven lower bound for the time until one of many event functions of free oscillators reaches
/// its limits (docs/theory.md, "Free flight"):
///
///     z_k'' + omega_k^2 z_k = 0,   low_i < x_i < high_i,   x_i = sum_k g_ik z_k.
///
/// omega_k = 0 is a body moving uniformly.
class EventFreeHorizon {
 public:
  /// `frequencies`: omega, n of them, rad/s, ascending, the last above 0; `functions`: rows of g.
  EventFreeHorizon(std::vector<double> frequencies, std::vector<double> functions);

  std::span<const double> frequencies() const { return omega_; }
  std::size_t n_functions() const { return functions_.size() / n_; }

  /// Horizon (s), at most `longest`, from displacements z and their rates; 0: nothing is proven.
  double from(std::span<const double> z, std::span<const double> rates, std::span<const double> low,
              std::span<const double> high, double longest);

  /// Times (s) after the start at which the samples of the last function are largest and smallest,
  /// and the time between two samples.
  double time_of_largest() const { return time_of_largest_; }
  double time_of_smallest() const { return time_of_smallest_; }
  double sample_interval() const { return levels_.front().interval; }

 private:
  // The intervals of one length and the samples at their ends.
  struct Level {
    double interval = 0.0;   // tau, s
    std::size_t n_kept = 0;  // oscillators, the slowest
    // Motion over an interval, of all oscillators.
    std::vector<double> cosine, sine_over_omega, minus_omega_sine;
    std::vector<double> bounds;          // A_k min(1, (omega_k tau)^2/8)
    std::vector<double> margins;         // per function; negative: not computed yet
    std::vector<double> z, rates;        // at the end of the last interval
    std::vector<double> values;          // of the functions there
    std::vector<std::size_t> functions;  // those sampled on this level
  };
  bool stays_within_limits(std::size_t function) const;
  bool passes(Level& level, std::size_t function, double before, double after);
  // The time without an event in `n` intervals of a level, from its z and rates.
  double event_free_time(std::size_t level, std::size_t n);

  std::vector<double> omega_, functions_;
  std::size_t n_;          // oscillators
  std::size_t n_uniform_;  // of them of frequency 0
  std::vector<double> amplitudes_;
  std::span<const double> low_, high_;  // of the present search
  double time_of_largest_ = 0.0, largest_ = 0.0, time_of_smallest_ = 0.0, smallest_ = 0.0;
  std::vector<Level> levels_;
};

}  // namespace subimpact
