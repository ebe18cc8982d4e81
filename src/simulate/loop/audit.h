#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "subimpact/simulate/result.h"
#include "system/readings/accounts.h"

namespace subimpact {

/// Ends a run; later results would not be valid.
class RunStopped : public std::runtime_error {
 public:
  RunStopped(OutcomeKind kind, const std::string& message,
             std::optional<Interval> first_failure = {})
      : std::runtime_error(message), kind(kind), first_failure(first_failure) {}
  OutcomeKind kind;
  std::optional<Interval> first_failure;
};

/// Largest errors that a run may make and still count as completed.
struct AuditLimits {
  double energy = std::numeric_limits<double>::infinity();    ///< relative to the initial energy
  double momentum = std::numeric_limits<double>::infinity();  ///< relative to m v0
};

/// The accounts of a run. Energy and (where no support takes it up) momentum are conserved exactly
/// by the equations of motion, so any deviation is the error of the time integration. Every check
/// either passes, and its time is stored as the last valid one, or throws RunStopped with the
/// interval in which the failure began: `unstable` for a value that is not finite or an energy far
/// above the initial one, else `inaccurate`.
class Audit {
 public:
  Audit(const StruckBeam& beam, const State& initial, AuditLimits limits = {});

  /// Judges the accepted state y at time t (s).
  void check(double t, const State& y) { check(t, y, accounts_.energies(y, t)); }
  void check(double t, const State& y, const Energies& energies);
  /// A cheap look at the struck point, for every step: throws if its indentation (m) or rate (m/s)
  /// is not finite; returns whether the striker's speed is suspicious enough for a full check.
  bool is_suspicious(double t, const State& y, double indentation, double rate) const;
  /// Judges the impulse of a sub-impact (N s) that ended at t against the integrated force.
  void check_impulse(double t, double impulse, double force_integral);
  const StruckBeam& beam() const { return accounts_.beam(); }
  /// Relative to the initial energy.
  double tolerated_energy() const { return limits_.energy; }
  /// By how much the energy that damping dissipates in a step may be off, J.
  double tolerated_loss() const { return share_of_losses * limits_.energy * energy_scale_; }
  /// By how much impulse and integrated force may differ, N s.
  double tolerated_impulse() const { return limits_.energy * momentum_scale_; }
  template <class... Values>
  [[noreturn]] void fail(double t, OutcomeKind kind, fmt::format_string<Values...> what,
                         Values&&... values) const {
    throw RunStopped(kind, fmt::format(what, std::forward<Values>(values)...),
                     Interval{std::min(last_good_, t), t});
  }

  /// Whether the last check found the energy above what is tolerated.
  bool gained_energy() const { return latest_energy_error_ > limits_.energy; }

  /// A copy of these accounts in which only a blow-up is an error.
  Audit without_limits() const {
    Audit copy = *this;
    copy.limits_ = {};
    return copy;
  }

  /// Relative to the initial energy; where loads do work, to the largest energy so far.
  double energy_error(const Energies& energies) const {
    return (energies.total() - initial_energy_) / energy_scale_;
  }
  std::optional<double> momentum_error(double t, const State& y) const;

  /// Largest errors over all checks, including those that failed.
  double max_energy_error() const { return max_energy_error_; }
  std::optional<double> max_momentum_error() const { return max_momentum_error_; }
  double max_impulse_error() const { return max_impulse_error_; }

 private:
  static constexpr double share_of_losses = 1e-5;

  Accounts accounts_;
  AuditLimits limits_;
  double initial_energy_;
  double initial_momentum_;
  double energy_scale_ = 0.0;    // J: the initial energy, or that of the strike if it is larger
  double momentum_scale_ = 0.0;  // N s: m v0 of a beam at rest
  double last_good_ = 0.0;
  double latest_energy_error_ = 0.0;
  double max_energy_error_ = 0.0;
  std::optional<double> max_momentum_error_;
  double max_impulse_error_ = 0.0;
};

}  // namespace subimpact
