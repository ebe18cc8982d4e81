#pragma once

#include <memory>
#include <vector>

#include "integrate/integrator.h"
#include "system/free_flight.h"

namespace subimpact {

/// Another integrator, spared the stretches of free flight (FreeFlight): there the motion is known
/// in closed form, and one step goes as far as it can be shown that no guard reaches its limits.
///
/// The proof: with amplitudes A_k = |(z_k, z_k'/omega_k)|, which free flight keeps, guard i moves
/// by no more than sum |g_ik| A_k, so most guards can never reach their limits and are left out for
/// the whole flight. Of the others the highest oscillators, whose share r_i = sum |g_ik| A_k is a
/// small part of the room, are replaced by that bound. The rest is sampled at intervals tau,
/// between which a guard exceeds the larger of its samples by no more than tau^2/8 sum |g_ik| A_k
/// omega_k^2. The step ends before the first interval in which the sum of these could reach a
/// limit; from there the other integrator goes on, and nothing has been passed over.
///
/// A flight costs a few passes over the matrix of guards, so it is only tried after some steps of
/// the other integrator since it became possible, and after more of them where it did not pay.
class Flying final : public Integrator {
 public:
  /// `max_step`: longest flight in one step, s; infinite if it does not matter.
  Flying(std::unique_ptr<Integrator> integrator, std::unique_ptr<FreeFlight> flight,
         double max_step);

  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;
  bool is_eventless() const override { return flown_; }
  WorkCounts work() const override;

 private:
  // One guard that could reach its limits.
  struct Watched {
    std::size_t guard;
    double low, high;
    double room;       // to the nearer limit, or what stands for it
    double dropped;    // r_i
    double curvature;  // sum |g_ik| A_k omega_k^2 of the kept oscillators
  };
  double fly();
  bool choose_guards();
  void choose_oscillators();
  double sample();
  // Of the intervals between samples m and m + 1, how many from the first are shown to be safe.
  std::size_t safe_intervals(std::size_t m);
  void move(double t);

  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<FreeFlight> flight_;
  double max_step_;
  std::span<const double> omega_;
  std::size_t n_;
  bool flown_ = false;    // the last step was a flight
  bool follows_ = false;  // the other integrator stands at (t1_, y1_)
  int waited_ = 0;        // its steps since free flight became possible
  int patience_;
  long flights_ = 0;

  std::vector<double> z0_, rates0_, low_, high_;  // as the flight began
  std::vector<double> amplitude_;
  std::vector<Watched> watched_;
  std::vector<std::size_t> kept_;  // oscillators sampled
  double interval_ = 0.0;          // tau, s
  double longest_interval_ = 0.0;  // a radian of the slowest oscillator
  std::vector<double> rows_;       // watched guards of the kept oscillators, row by row
  std::vector<double> samples_, sample_rates_;  // kept oscillators, one sample after another
  std::vector<double> values_;                  // watched guards, one sample after another
  // The kept oscillators' motion over a time.
  struct Rotation {
    std::vector<double> cosine, sine_over_omega, minus_omega_sine;
    void set(std::span<const double> omega, const std::vector<std::size_t>& kept, double time);
    void apply(const double* z, const double* rates, double* to, double* rates_to) const;
  };
  Rotation fine_, coarse_;             // over one interval, over n_fine of them
  std::vector<std::size_t> in_doubt_;  // of the watched guards, in one coarse interval
  std::vector<double> before_;
  std::vector<double> z_, rates_;
};

}  // namespace subimpact
