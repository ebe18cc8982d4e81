#include "simulate/loop/audit.h"

#include <cmath>

#include "numerics/units.h"

namespace subimpact {
namespace {

// An energy above the initial one by this part is a blow-up, not an error.
constexpr double blow_up = 0.5;

// The larger of the two, or NaN if `error` is not a number.
double larger(double largest, double error) { return error <= largest ? largest : error; }

}  // namespace

Audit::Audit(const StruckBeam& beam, const State& initial, AuditLimits limits)
    : accounts_(beam),
      limits_(limits),
      initial_energy_(accounts_.energies(initial).total()),
      initial_momentum_(accounts_.conserves_momentum() ? accounts_.momentum(initial) : 0.0) {
  const double mass = beam.has_stop() ? beam.mesh().beam_mass() : beam.striker_mass();
  const double speed = beam.scales().velocity;
  const double of_striker = beam.has_stop() ? 0.0 : mass * std::abs(initial.back());
  energy_scale_ = std::max(initial_energy_, 0.5 * mass * speed * speed);
  momentum_scale_ = std::max(mass * speed, of_striker + std::abs(accounts_.beam_momentum(initial)));
}

std::optional<double> Audit::momentum_error(double t, const State& y) const {
  if (!accounts_.conserves_momentum()) return std::nullopt;
  return (accounts_.momentum(y, t) - initial_momentum_) / momentum_scale_;
}

void Audit::check(double t, const State& y, const Energies& energies) {
  if (energies.work != 0.0) energy_scale_ = std::max(energy_scale_, energies.taken_up());
  const double error = energy_error(energies);
  latest_energy_error_ = error;
  max_energy_error_ = larger(max_energy_error_, std::abs(error));
  if (!std::isfinite(error)) {
    fail(t, OutcomeKind::unstable, "the energy is no longer a finite number");
  }
  if (error > blow_up) {
    fail(t, OutcomeKind::unstable,
         "the solution grows without bound: the energy is {:.3g} times the initial one",
         1.0 + error);
  }
  if (!(std::abs(error) <= limits_.energy)) {
    fail(t, OutcomeKind::inaccurate,
         "the energy is off by {:+.2e} of the initial energy, tolerated are {:.1e}", error,
         limits_.energy);
  }
  if (const auto momentum = momentum_error(t, y)) {
    max_momentum_error_ = larger(max_momentum_error_.value_or(0.0), std::abs(*momentum));
    if (!(std::abs(*momentum) <= limits_.momentum)) {
      fail(t, OutcomeKind::inaccurate,
           "the momentum is off by {:+.2e} of m v0, tolerated are {:.1e}", *momentum,
           limits_.momentum);
    }
  }
  last_good_ = std::max(last_good_, t);
}

bool Audit::is_suspicious(double t, const State& y, double indentation, double rate) const {
  if (!std::isfinite(indentation) || !std::isfinite(rate)) {
    fail(t, OutcomeKind::unstable, "the motion of the struck point is no longer finite");
  }
  const double mass = accounts_.beam().striker_mass();
  return 0.5 * mass * y.back() * y.back() > (1.0 + blow_up) * energy_scale_;
}

void Audit::check_impulse(double t, double impulse, double force_integral) {
  const double error = (impulse - force_integral) / momentum_scale_;
  max_impulse_error_ = larger(max_impulse_error_, std::abs(error));
  if (!(std::abs(error) <= limits_.energy)) {
    fail(t, OutcomeKind::inaccurate,
         "the impulse of the sub-impact that ends at {} differs from its integrated force by "
         "{:+.2e} of m v0, tolerated are {:.1e}",
         instant_text(t), error, limits_.energy);
  }
}

}  // namespace subimpact
