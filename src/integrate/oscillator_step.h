#pragma once

#include <array>
#include <span>
#include <vector>

#include "integrate/damped_oscillator.h"
#include "ode/second_order_ode.h"

namespace subimpact {

/// Number of collocation points of the force in a step: the Gauss points.
constexpr std::size_t n_force_nodes = 4;
using NodeForces = std::array<double, n_force_nodes>;

/// The cubic through values at the Gauss points, by its coefficients of s^m/m!, s in [0, 1].
class ForcePolynomial {
 public:
  ForcePolynomial() = default;
  explicit ForcePolynomial(const NodeForces& values);
  double operator()(double s) const;
  std::span<const double> coefficients() const { return coefficients_; }

 private:
  std::array<double, n_force_nodes> coefficients_{};
};

/// Tables of a step of one length h of forced oscillators (ForcedOscillators): all that can be
/// computed before the state is known, for a force that is a cubic through its values at the Gauss
/// points (docs/theory.md, "The exponential method"). With damping: DampedOscillator.
class OscillatorStep {
 public:
  OscillatorStep(const ForcedOscillators& oscillators, double length);

  double length() const { return length_; }
  /// lambda at the Gauss points of the free motion from y = [q, q'].
  NodeForces free_displacements(std::span<const double> y) const;
  /// G_ij, m/N.
  double compliance(std::size_t i, std::size_t j) const { return compliance_[i][j]; }
  /// Size of the response of lambda to a constant unit force over the step, m/N.
  double constant_force_compliance() const { return constant_force_compliance_; }
  /// Whether a mode turns so far within a step that the Gauss points do not show its swing; of one
  /// frequency or of Lanes.
  static auto is_fast(const auto& omega, double length) { return omega * length > 3.0; }
  /// Bound of the error (m per m/s) of the cubic through the ends of lambda, where fast modes swing
  /// with speeds omega A whose squares add up to 1; 0: no mode is fast.
  double error_per_swing() const { return error_per_swing_; }
  /// The step's end under the forces, or in free motion.
  void advance(std::span<const double> y, const NodeForces& forces, std::span<double> end) const;
  void advance_freely(std::span<const double> y, std::span<double> end) const;
  /// Adds the response to loads that begin at the step's start, from rest, to the end or to lambda.
  void add_loads(const ForcedOscillators::Loads& loads, std::span<double> end) const;
  void add_loads(const ForcedOscillators::Loads& loads, NodeForces& lambda) const;

 private:
  void make_undamped(const ForcedOscillators& oscillators);
  void make_damped(const ForcedOscillators& oscillators);
  void make_loads(const ForcedOscillators& oscillators);
  double find_error_per_swing(const ForcedOscillators& oscillators) const;

  std::size_t n_;
  double length_;
  double constant_force_compliance_ = 0.0;
  double error_per_swing_ = 0.0;
  std::array<std::array<double, n_force_nodes>, n_force_nodes> compliance_{};
  using Column = std::vector<double>;
  std::array<Column, n_force_nodes> free_position_, free_velocity_;  // lambda at the Gauss points
  Column cosine_, sine_over_omega_, minus_omega_sine_;
  Column rate_cosine_;  // of q'; empty without damping, where it is cosine_
  std::array<Column, n_force_nodes> position_, velocity_;  // P_j, V_j
  // Responses to the accelerations 1, t and, as velocity, to their rates 0, 1; empty without loads.
  Column by_impulse_, by_value_, by_rate_;
  std::array<std::array<Column, 2>, n_force_nodes> lambda_by_load_;
};

/// Adds the response to loads, from rest, a time t after they began.
void add_response(const ForcedOscillators& oscillators, const ForcedOscillators::Loads& loads,
                  double t, std::span<double> y);

/// The state a time t after y, t within a step of length h over which the force is the polynomial.
void flow(const ForcedOscillators& oscillators, std::span<const double> y,
          const ForcePolynomial& force, double h, double t, std::span<double> result);

/// Integral of q_i'^2 over that time, of each damped oscillator; 0 for those without damping.
void integrate_squared_velocities(const ForcedOscillators& oscillators, std::span<const double> y,
                                  const ForcePolynomial& force, double h, double t,
                                  std::span<double> result);

}  // namespace subimpact
