#include "integrate/oscillator_step.h"

#include <cmath>
#include <utility>

#include "numerics/gauss.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

constexpr std::size_t s = n_force_nodes;

// basis[m][j]: coefficient of s^m/m! in the Lagrange polynomial of Gauss point j.
using Basis = std::array<std::array<double, s>, s>;

Basis make_basis() {
  constexpr auto x = gauss<s>.points;
  Basis basis{};
  for (std::size_t j = 0; j < s; ++j) {
    std::array<double, s> product{1.0};
    std::size_t degree = 0;
    for (std::size_t k = 0; k < s; ++k) {
      if (k == j) continue;
      const double scale = 1.0 / (x[j] - x[k]);
      std::array<double, s> next{};
      for (std::size_t m = 0; m <= degree; ++m) {
        next[m + 1] += scale * product[m];
        next[m] -= scale * x[k] * product[m];
      }
      product = next;
      ++degree;
    }
    double factorial = 1.0;
    for (std::size_t m = 0; m < s; ++m) {
      if (m > 0) factorial *= static_cast<double>(m);
      basis[m][j] = factorial * product[m];
    }
  }
  return basis;
}

const Basis& basis() {
  static const Basis values = make_basis();
  return values;
}

// Response at time theta h of an oscillator, y = omega h theta, to the unit force at Gauss point j:
// position in units of h^2, velocity in units of h.
struct UnitResponse {
  Lanes position[s], velocity[s];
};

UnitResponse unit_response(double theta, const StumpffLanes& c) {
  UnitResponse response{};
  const Basis& b = basis();
  double power = theta;
  for (std::size_t m = 0; m < s; ++m) {
    const Lanes velocity = power * c[m + 1];
    power *= theta;
    const Lanes position = power * c[m + 2];
    for (std::size_t j = 0; j < s; ++j) {
      response.velocity[j] += b[m][j] * velocity;
      response.position[j] += b[m][j] * position;
    }
  }
  return response;
}

// Position and velocity of a damped oscillator under the unit force at Gauss point j of a step h.
std::pair<double, double> unit_response(const DampedOscillator& at, std::size_t j, double h) {
  double position = 0.0;
  double velocity = 0.0;
  double scale = 1.0;  // 1/h^m
  for (std::size_t m = 0; m < s; ++m) {
    position += basis()[m][j] * scale * at.forced[m];
    velocity += basis()[m][j] * scale * (m == 0 ? at.response : at.forced[m - 1]);
    scale /= h;
  }
  return {position, velocity};
}

// Eight at once, the last group filled up with zeros.
Lanes load(std::span<const double> from, std::size_t i) {
  if (i + n_lanes <= from.size()) return lanes_at(from.data() + i);
  Lanes values{};
  for (std::size_t k = i; k < from.size(); ++k) values[k - i] = from[k];
  return values;
}

void store(const Lanes& values, std::span<double> to, std::size_t i) {
  if (i + n_lanes <= to.size()) return subimpact::store(values, to.data() + i);
  for (std::size_t k = i; k < to.size(); ++k) to[k] = values[k - i];
}

// Free oscillators that hold less than this share of the squares of all velocities, omega q among
// them, do not move anything by more than 1e-11 of what the others do.
constexpr double least_share = 1e-22;

// The sum (omega q)^2 + q'^2 of an oscillator, omega > 0, below which it counts as resting.
double resting_below(const ForcedOscillators& oscillators, std::span<const double> y,
                     const ForcePolynomial& force) {
  for (const double f : force.coefficients()) {
    if (f != 0.0) return 0.0;
  }
  const std::size_t n = oscillators.size();
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double wq = oscillators.frequencies()[k] * y[k];
    sum += wq * wq + y[n + k] * y[n + k];
  }
  return least_share * sum / static_cast<double>(n);
}

bool has_all_frequencies(const Lanes& w) {
  for (std::size_t k = 0; k < n_lanes; ++k) {
    if (!(w[k] > 0.0)) return false;
  }
  return true;
}

// Coefficients of t^m/m! in the force over a step of length h.
std::array<double, s> in_time(const ForcePolynomial& force, double h) {
  std::array<double, s> scaled{};
  double scale = 1.0;
  for (std::size_t m = 0; m < s; ++m) {
    scaled[m] = scale * force.coefficients()[m];
    scale /= h;
  }
  return scaled;
}

void flow_damped(const ForcedOscillators& oscillators, std::span<const double> y,
                 const ForcePolynomial& force, double h, double t, std::span<double> result) {
  const std::size_t n = oscillators.size();
  const std::array<double, s> f = in_time(force, h);
  const double least = resting_below(oscillators, y, force);
  for (std::size_t k = 0; k < n; ++k) {
    const double w = oscillators.frequencies()[k];
    if (w > 0.0 && w * y[k] * w * y[k] + y[n + k] * y[n + k] < least) {
      result[k] = result[n + k] = 0.0;
      continue;
    }
    const DampedOscillator at(w, oscillators.decay_rates()[k], t);
    double position = f[0] * at.forced[0];
    double velocity = f[0] * at.response;
    for (std::size_t m = 1; m < s; ++m) {
      position += f[m] * at.forced[m];
      velocity += f[m] * at.forced[m - 1];
    }
    const double l = oscillators.loads()[k];
    const double q = y[k];
    const double v = y[n + k];
    result[k] = at.position * q + at.response * v + l * position;
    result[n + k] = -w * w * at.response * q + at.slope * v + l * velocity;
  }
}

}  // namespace

ForcePolynomial::ForcePolynomial(const NodeForces& values) {
  for (std::size_t j = 0; j < s; ++j) {
    for (std::size_t m = 0; m < s; ++m) coefficients_[m] += values[j] * basis()[m][j];
  }
}

double ForcePolynomial::operator()(double x) const {
  return coefficients_[0] +
         x * (coefficients_[1] + x * (coefficients_[2] / 2.0 + x * coefficients_[3] / 6.0));
}

OscillatorStep::OscillatorStep(const ForcedOscillators& oscillators, double length)
    : n_(oscillators.size()), length_(length) {
  for (Column* column : {&cosine_, &sine_over_omega_, &minus_omega_sine_}) column->resize(n_);
  for (std::size_t j = 0; j < s; ++j) {
    for (auto* columns : {&free_position_, &free_velocity_, &position_, &velocity_}) {
      (*columns)[j].resize(n_);
    }
  }
  if (oscillators.decay_rates().empty()) {
    make_undamped(oscillators);
  } else {
    make_damped(oscillators);
  }
  if (oscillators.has_loads()) make_loads(oscillators);
  error_per_swing_ = find_error_per_swing(oscillators);
}

// A swing is off by at most h^4/384 of its fourth derivative; neither it nor the cubic through its
// ends exceeds A (1 + 8/27 omega h). The errors of all modes add up to the bound by Cauchy's
// inequality.
double OscillatorStep::find_error_per_swing(const ForcedOscillators& oscillators) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = oscillators.frequencies()[k];
    if (!is_fast(w, length_)) continue;
    const double delta = oscillators.decay_rates().empty() ? 0.0 : oscillators.decay_rates()[k];
    const double rate = delta + std::hypot(w, delta);
    const double of_derivative = std::pow(rate, 3) * std::pow(length_, 4) / 384.0;
    const double error = std::min(of_derivative, 2.0 / w + 8.0 / 27.0 * length_);
    sum += std::pow(oscillators.displacements()[k] * error, 2);
  }
  return std::sqrt(sum);
}

void OscillatorStep::make_loads(const ForcedOscillators& oscillators) {
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = oscillators.frequencies()[k];
    const double delta = oscillators.decay_rates().empty() ? 0.0 : oscillators.decay_rates()[k];
    const DampedOscillator end(w, delta, length_);
    by_impulse_.push_back(end.response);
    by_value_.push_back(end.forced[0]);
    by_rate_.push_back(end.forced[1]);
    for (std::size_t i = 0; i < s; ++i) {
      const DampedOscillator node(w, delta, gauss<s>.points[i] * length_);
      for (std::size_t m = 0; m < 2; ++m) {
        lambda_by_load_[i][m].push_back(oscillators.displacements()[k] * node.forced[m]);
      }
    }
  }
}

void OscillatorStep::add_loads(const ForcedOscillators::Loads& loads, std::span<double> end) const {
  for (std::size_t k = 0; k < n_; ++k) {
    end[k] += by_value_[k] * loads.value[k] + by_rate_[k] * loads.rate[k];
    end[n_ + k] += by_impulse_[k] * loads.value[k] + by_value_[k] * loads.rate[k];
  }
}

void OscillatorStep::add_loads(const ForcedOscillators::Loads& loads, NodeForces& lambda) const {
  for (std::size_t i = 0; i < s; ++i) {
    lambda[i] += dot(lambda_by_load_[i][0].data(), loads.value.data(), n_) +
                 dot(lambda_by_load_[i][1].data(), loads.rate.data(), n_);
  }
}

void add_response(const ForcedOscillators& oscillators, const ForcedOscillators::Loads& loads,
                  double t, std::span<double> y) {
  const std::size_t n = oscillators.size();
  for (std::size_t k = 0; k < n && !loads.value.empty(); ++k) {
    const double delta = oscillators.decay_rates().empty() ? 0.0 : oscillators.decay_rates()[k];
    const DampedOscillator at(oscillators.frequencies()[k], delta, t);
    y[k] += at.forced[0] * loads.value[k] + at.forced[1] * loads.rate[k];
    y[n + k] += at.response * loads.value[k] + at.forced[0] * loads.rate[k];
  }
}

void OscillatorStep::make_damped(const ForcedOscillators& oscillators) {
  const double h = length_;
  rate_cosine_.resize(n_);
  double response = 0.0;
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = oscillators.frequencies()[k];
    const double delta = oscillators.decay_rates()[k];
    const double l = oscillators.loads()[k];
    const double d = oscillators.displacements()[k];
    const DampedOscillator end(w, delta, h);
    cosine_[k] = end.position;
    rate_cosine_[k] = end.slope;
    sine_over_omega_[k] = end.response;
    minus_omega_sine_[k] = -w * w * end.response;
    for (std::size_t j = 0; j < s; ++j) {
      const auto [position, velocity] = unit_response(end, j, h);
      position_[j][k] = l * position;
      velocity_[j][k] = l * velocity;
    }
    response += d * l * end.forced[0];
    for (std::size_t i = 0; i < s; ++i) {
      const DampedOscillator node(w, delta, gauss<s>.points[i] * h);
      free_position_[i][k] = d * node.position;
      free_velocity_[i][k] = d * node.response;
      for (std::size_t j = 0; j < s; ++j) {
        compliance_[i][j] += d * l * unit_response(node, j, h).first;
      }
    }
  }
  constant_force_compliance_ = std::abs(response);
}

void OscillatorStep::make_undamped(const ForcedOscillators& oscillators) {
  const auto omega = oscillators.frequencies();
  const auto load_factors = oscillators.loads();
  const auto displacement = oscillators.displacements();
  const double h = length_;
  Lanes response{};
  Lanes compliance[s][s] = {};
  for (std::size_t k = 0; k < n_; k += n_lanes) {
    const Lanes w = load(omega, k);
    const Lanes l = load(load_factors, k);
    const Lanes d = load(displacement, k);
    const Lanes x = w * h;
    const auto at_end = stumpff(x);
    store(at_end[0], cosine_, k);
    store(h * at_end[1], sine_over_omega_, k);
    store(-w * x * at_end[1], minus_omega_sine_, k);
    const UnitResponse end = unit_response(1.0, at_end);
    for (std::size_t j = 0; j < s; ++j) {
      store(l * h * h * end.position[j], position_[j], k);
      store(l * h * end.velocity[j], velocity_[j], k);
    }
    const Lanes scale = d * l * h * h;
    response += scale * at_end[2];
    for (std::size_t i = 0; i < s; ++i) {
      const double theta = gauss<s>.points[i];
      const auto at_node = stumpff(x * theta);
      store(d * at_node[0], free_position_[i], k);
      store(d * theta * h * at_node[1], free_velocity_[i], k);
      const UnitResponse node = unit_response(theta, at_node);
      for (std::size_t j = 0; j < s; ++j) compliance[i][j] += scale * node.position[j];
    }
  }
  constant_force_compliance_ = std::abs(sum(response));
  for (std::size_t i = 0; i < s; ++i) {
    for (std::size_t j = 0; j < s; ++j) compliance_[i][j] = sum(compliance[i][j]);
  }
}

NodeForces OscillatorStep::free_displacements(std::span<const double> y) const {
  const double* q = y.data();
  const double* v = q + n_;
  Lanes running[s] = {};
  std::size_t k = 0;
  for (; k + n_lanes <= n_; k += n_lanes) {
    for (std::size_t i = 0; i < s; ++i) {
      running[i] += lanes_at(free_position_[i].data() + k) * lanes_at(q + k) +
                    lanes_at(free_velocity_[i].data() + k) * lanes_at(v + k);
    }
  }
  NodeForces result;
  for (std::size_t i = 0; i < s; ++i) {
    result[i] = sum(running[i]);
    for (std::size_t j = k; j < n_; ++j) {
      result[i] += free_position_[i][j] * q[j] + free_velocity_[i][j] * v[j];
    }
  }
  return result;
}

void OscillatorStep::advance_freely(std::span<const double> y, std::span<double> end) const {
  const double* q = y.data();
  const double* v = q + n_;
  double* q1 = end.data();
  double* v1 = q1 + n_;
  const double* c = cosine_.data();
  const double* so = sine_over_omega_.data();
  const double* os = minus_omega_sine_.data();
  if (!rate_cosine_.empty()) {
    for (std::size_t k = 0; k < n_; ++k) {
      q1[k] = c[k] * q[k] + so[k] * v[k];
      v1[k] = os[k] * q[k] + rate_cosine_[k] * v[k];
    }
    return;
  }
#pragma GCC ivdep
  for (std::size_t k = 0; k < n_; ++k) {
    q1[k] = c[k] * q[k] + so[k] * v[k];
    v1[k] = os[k] * q[k] + c[k] * v[k];
  }
}

void OscillatorStep::advance(std::span<const double> y, const NodeForces& forces,
                             std::span<double> end) const {
  advance_freely(y, end);
  double* q1 = end.data();
  double* v1 = q1 + n_;
  const double* p0 = position_[0].data();
  const double* p1 = position_[1].data();
  const double* p2 = position_[2].data();
  const double* p3 = position_[3].data();
  const double* r0 = velocity_[0].data();
  const double* r1 = velocity_[1].data();
  const double* r2 = velocity_[2].data();
  const double* r3 = velocity_[3].data();
  const NodeForces f = forces;
  static_assert(s == 4);
#pragma GCC ivdep
  for (std::size_t k = 0; k < n_; ++k) {
    q1[k] += f[0] * p0[k] + f[1] * p1[k] + f[2] * p2[k] + f[3] * p3[k];
    v1[k] += f[0] * r0[k] + f[1] * r1[k] + f[2] * r2[k] + f[3] * r3[k];
  }
}

void integrate_squared_velocities(const ForcedOscillators& oscillators, std::span<const double> y,
                                  const ForcePolynomial& force, double h, double t,
                                  std::span<double> result) {
  const std::size_t n = oscillators.size();
  const std::array<double, s> f = in_time(force, h);
  const double least = resting_below(oscillators, y, force);
  for (std::size_t k = 0; k < n; ++k) {
    result[k] = 0.0;
    const double delta = oscillators.decay_rates()[k];
    const double wq = oscillators.frequencies()[k] * y[k];
    if (delta == 0.0 || wq * wq + y[n + k] * y[n + k] < least) continue;
    std::array<double, s> scaled = f;
    for (double& x : scaled) x *= oscillators.loads()[k];
    result[k] = integral_of_squared_velocity(oscillators.frequencies()[k], delta, y[k], y[n + k],
                                             scaled, t);
  }
}

void flow(const ForcedOscillators& oscillators, std::span<const double> y,
          const ForcePolynomial& force, double h, double t, std::span<double> result) {
  if (!oscillators.decay_rates().empty()) {
    return flow_damped(oscillators, y, force, h, t, result);
  }
  const std::size_t n = oscillators.size();
  const auto omega = oscillators.frequencies();
  const auto loads = oscillators.loads();
  const auto a = force.coefficients();
  const double theta = t / h;
  // The force's coefficients, of t^m/m!, times the powers of t that go with them.
  const double f0 = a[0] * t;
  const double f1 = a[1] * theta * t;
  const double f2 = a[2] * theta * theta * t;
  const double f3 = a[3] * theta * theta * theta * t;
  const auto q0 = y.first(n);
  const auto v0 = y.subspan(n, n);
  const double least = resting_below(oscillators, y, force);
  for (std::size_t k = 0; k < n; k += n_lanes) {
    const Lanes w = load(omega, k);
    const Lanes q = load(q0, k);
    const Lanes v = load(v0, k);
    if (sum(w * q * w * q + v * v) < least && has_all_frequencies(w)) {
      store(Lanes{}, result.first(n), k);
      store(Lanes{}, result.subspan(n, n), k);
      continue;
    }
    const Lanes l = load(loads, k);
    const Lanes x = w * t;
    const auto c = stumpff(x);
    const Lanes position = t * (f0 * c[2] + f1 * c[3] + f2 * c[4] + f3 * c[5]);
    const Lanes velocity = f0 * c[1] + f1 * c[2] + f2 * c[3] + f3 * c[4];
    store(c[0] * q + t * c[1] * v + l * position, result.first(n), k);
    store(-w * x * c[1] * q + c[0] * v + l * velocity, result.subspan(n, n), k);
  }
}

}  // namespace subimpact
