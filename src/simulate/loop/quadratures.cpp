#include "simulate/loop/quadratures.h"

#include <algorithm>
#include <cmath>

#include "numerics/gauss.h"
#include "numerics/hermite.h"

namespace subimpact {

namespace {

// Halvings of a step: each takes the error down 16 times.
constexpr int most_halvings_of_force = 8;

// Lengths of two steps that differ by more tell nothing of the fourth derivative.
constexpr double largest_ratio = 1e3;

// Tolerated error of the impulse of a support over a step, as a share of the tolerated one.
constexpr double share_of_impulse = 1e-3;

double fifth_power(double h) { return h * h * h * h * h; }

constexpr int most_halvings_of_loss = 6;
constexpr std::size_t n_points = 4;

// Weights of the positions, velocities and accelerations at both ends in position and velocity of a
// Hermite polynomial, at s in [0, 1] of a step of length h.
struct HermiteWeights {
  double position[2][3], velocity[2][3];
};

HermiteWeights cubic_weights(double s, double h) {
  const double r = 1.0 - s;
  const double slope = 6.0 * s * r / h;
  return {{{r * r * (1.0 + 2.0 * s), h * r * r * s, 0.0},
           {s * s * (1.0 + 2.0 * r), -h * s * s * r, 0.0}},
          {{-slope, r * (1.0 - 3.0 * s), 0.0}, {slope, s * (1.0 - 3.0 * r), 0.0}}};
}

HermiteWeights quintic_weights(double s, double h) {
  HermiteWeights weights{};
  for (int end = 0; end < 2; ++end) {
    const double x = end == 0 ? s : 1.0 - s;
    const double sign = end == 0 ? 1.0 : -1.0;
    const double r = 1.0 - x;
    const double r2 = r * r;
    const double r3 = r2 * r;
    weights.position[end][0] = r3 * (1.0 + 3.0 * x + 6.0 * x * x);
    weights.position[end][1] = sign * h * r3 * (x + 3.0 * x * x);
    weights.position[end][2] = h * h * r3 * 0.5 * x * x;
    weights.velocity[end][0] = -sign * 30.0 * x * x * r2 / h;
    weights.velocity[end][1] = r2 * (1.0 + 2.0 * x - 15.0 * x * x);
    weights.velocity[end][2] = sign * h * r2 * (x - 2.5 * x * x);
  }
  return weights;
}

bool is_damped_in_contact(const StruckBeam& beam) {
  for (std::size_t i = 0; i < beam.n_contacts(); ++i) {
    if (beam.contact(i).is_damped() && beam.contact(i).is_closed()) return true;
  }
  return false;
}

bool needs_halving(double quintic, double cubic, double tolerance) {
  if (!(std::abs(quintic) > tolerance)) return false;
  const double share = std::abs((quintic - cubic) / quintic);
  return share * std::sqrt(share) * std::abs(quintic) > tolerance;
}

}  // namespace

template <std::size_t n_points>
double ForceQuadrature::between(const Node& a, const Node& b, const StruckBeam& beam) const {
  const double h = b.time - a.time;
  if (!(h > 0.0)) return 0.0;
  const HermiteCubic indentation(a.indentation, a.rate, b.indentation, b.rate, h);
  const ContactState& contact = beam.contact(contact_);
  double sum = 0.0;
  for (std::size_t i = 0; i < n_points; ++i) {
    const double s = gauss<n_points>.points[i];
    sum += gauss<n_points>.weights[i] * contact.force(indentation(s), indentation.slope(s) / h);
  }
  return h * sum;
}

double ForceQuadrature::halved(const Node& a, const Node& b, double whole, const ObservedStep& step,
                               const StruckBeam& beam, int depth) {
  const double middle_time = 0.5 * (a.time + b.time);
  step.state_at(middle_time, state_);
  const Node middle = node(middle_time, state_, beam);
  largest_indentation_ = std::max(largest_indentation_, middle.indentation);
  const double first = between(a, middle, beam);
  const double second = between(middle, b, beam);
  const double correction = (first + second - whole) / 15.0;
  if (!(std::abs(correction) > tolerance_) || depth == most_halvings_of_force) {
    return first + second + correction;
  }
  return halved(a, middle, first, step, beam, depth + 1) +
         halved(middle, b, second, step, beam, depth + 1);
}

double ForceQuadrature::over(const ObservedStep& step, const StruckBeam& beam) {
  largest_indentation_ = 0.0;
  if (!(step.length() > 0.0)) return 0.0;  // an event at the very start of a step
  const auto [a, b] = ends_of(step, beam);
  const double h = step.length();
  const double whole = between(a, b, beam);
  double constant = 0.0;
  if (previous_ && std::max(h / previous_->length, previous_->length / h) < largest_ratio) {
    const double both = h + previous_->length;
    const double change = previous_->integral + whole - between(previous_->start, b, beam);
    constant = change / (fifth_power(both) - fifth_power(h) - fifth_power(previous_->length));
  }
  // Where the fourth derivative changes its sign the constant is small by chance, but not twice.
  const bool has_two = previous_ && previous_->constant != 0.0;
  const bool trusted =
      has_two &&
      std::max(std::abs(constant), std::abs(previous_->constant)) * fifth_power(h) <= tolerance_;
  previous_ = Step{a, h, whole, constant};
  if (trusted || !(std::abs(whole) > tolerance_)) return whole + constant * fifth_power(h);
  return halved(a, b, whole, step, beam, 1);
}

double ForceQuadrature::up_to(double t, const State& y, const ObservedStep& step,
                              const StruckBeam& beam) {
  const Node a = node(step.t0(), step.y0(), beam), b = node(t, y, beam);
  const double whole = between(a, b, beam);
  return std::abs(whole) > tolerance_ ? halved(a, b, whole, step, beam, 1) : whole;
}

LossQuadrature::LossQuadrature(const Audit& audit, EventHandling events)
    : tolerance_(audit.tolerated_loss()),
      events_(events),
      impulses_(audit.beam().supports().size()) {
  for (std::size_t i = 0; i < impulses_.size(); ++i) {
    forces_.emplace_back(share_of_impulse * audit.tolerated_impulse(), i + 1);
  }
}

void LossQuadrature::read_acceleration(Node& node, StruckBeam& beam) {
  node.acceleration.resize(beam.n_positions());
  beam.set_time(node.time);
  beam.acceleration_at(node.y, node.acceleration);
  if (!beam.loads().varies()) return;
  const std::span<const double> y = node.y;
  const std::size_t n = beam.n_positions();
  node.power_of_change = {beam.loads().power_of_change(beam.beam_positions(y)),
                          beam.loads().power_of_change(beam.beam_positions(y.subspan(n))),
                          beam.loads().power_of_change(beam.beam_positions(node.acceleration))};
}

Losses LossQuadrature::between(const Node& a, const Node& b, bool quintic, StruckBeam& beam) {
  const std::size_t n = beam.n_positions();
  const double h = b.time - a.time;
  const ContactState& contact = beam.contact();
  const bool has_damping = beam_by_quadrature_ || is_damped_in_contact(beam);
  Losses sum;
  state_.resize(2 * n);
  for (std::size_t k = 0; k < n_points; ++k) {
    const double s = gauss<n_points>.points[k];
    const HermiteWeights w = quintic ? quintic_weights(s, h) : cubic_weights(s, h);
    const double weight = h * gauss<n_points>.weights[k];
    for (std::size_t of = 0; of < 3; ++of) {
      sum.of_change += weight * (w.position[0][of] * a.power_of_change[of] +
                                 w.position[1][of] * b.power_of_change[of]);
    }
    if (!has_damping) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = [&](const double(&weights)[2][3]) {
        return weights[0][0] * a.y[i] + weights[0][1] * a.y[n + i] +
               weights[0][2] * a.acceleration[i] + weights[1][0] * b.y[i] +
               weights[1][1] * b.y[n + i] + weights[1][2] * b.acceleration[i];
      };
      state_[i] = at(w.position);
      state_[n + i] = at(w.velocity);
    }
    if (contact.is_closed()) {
      sum.contact +=
          weight * contact.damping_power(beam.indentation(state_), beam.indentation_rate(state_));
    }
    for (std::size_t i = 1; i < beam.n_contacts(); ++i) {
      if (!beam.contact(i).is_closed()) continue;
      sum.beam += weight * beam.supports()[i - 1].copies *
                  beam.contact(i).damping_power(beam.indentation(state_, i),
                                                beam.indentation_rate(state_, i));
    }
    if (beam_by_quadrature_) {
      sum.beam += weight * beam.damping_power(beam.beam_velocities(state_));
    }
  }
  return sum;
}

Losses LossQuadrature::halved(const Node& a, const Node& b, const ObservedStep& step,
                              StruckBeam& beam, int depth) {
  const Losses whole = between(a, b, true, beam);
  const Losses rough = between(a, b, false, beam);
  Node middle{0.5 * (a.time + b.time), {}, {}, {}};
  const bool has_middle = middle.time > a.time && middle.time < b.time;
  if (depth == most_halvings_of_loss || !has_middle) return whole;
  const bool is_rough = needs_halving(whole.contact, rough.contact, tolerance_) ||
                        needs_halving(whole.beam, rough.beam, tolerance_) ||
                        needs_halving(whole.of_change, rough.of_change, tolerance_);
  if (!is_rough && !beam.loads().varies()) return whole;
  step.state_at(middle.time, middle.y);
  read_acceleration(middle, beam);
  if (!is_rough) {  // in a long flight the beam may swing more often than its ends show
    const Losses finer = between(a, middle, true, beam) + between(middle, b, true, beam);
    if (std::abs(finer.of_change - whole.of_change) <= tolerance_) return finer;
  }
  return halved(a, middle, step, beam, depth + 1) + halved(middle, b, step, beam, depth + 1);
}

Losses LossQuadrature::over(const ObservedStep& step, double t, const State& y, StruckBeam& beam) {
  Losses sum;
  std::ranges::fill(impulses_, 0.0);
  if (!(t > step.t0())) return sum;
  const std::span<const double> damping = beam.modal_damping();
  squares_.resize(beam.n_positions());
  const bool has_closed_form = !damping.empty() && !beam.damping().is_none() &&
                               step.integrator().integrate_squared_velocities(t, squares_);
  beam_by_quadrature_ = !beam.damping().is_none() && !has_closed_form;
  if (beam_by_quadrature_ || is_damped_in_contact(beam) || beam.loads().varies()) {
    Node start{step.t0(), step.y0(), {}, {}};
    Node end{t, y, {}, {}};
    read_acceleration(start, beam);
    read_acceleration(end, beam);
    sum = halved(start, end, step, beam, 0);
  }
  for (std::size_t i = 0; i < beam.n_contacts(); ++i) {
    const ContactState& contact = beam.contact(i);
    if (!contact.is_recovering()) continue;
    const double lost = contact.energies(beam.indentation(step.y0(), i)).elastic -
                        contact.energies(beam.indentation(y, i)).elastic;
    (i == 0 ? sum.contact : sum.beam) += i == 0 ? lost : beam.supports()[i - 1].copies * lost;
  }
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    if (!beam.contact(i + 1).exerts_force()) continue;
    impulses_[i] = events_ == EventHandling::interpolated
                       ? forces_[i].roughly_up_to(t, y, step, beam)
                   : t < step.t1() ? forces_[i].up_to(t, y, step, beam)
                                   : forces_[i].over(step, beam);
  }
  if (has_closed_form) {
    for (std::size_t k = 0; k < damping.size(); ++k) {
      sum.beam += damping[k] * beam.mesh().mass().at(k, k) * squares_[k];
    }
  }
  return sum;
}

}  // namespace subimpact
