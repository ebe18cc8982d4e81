#include "model/contact/mid_plane_contact.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "numerics/gauss.h"

namespace subimpact {
namespace {

std::atomic<std::uint64_t> n_laws = 0;

template <class F>
double integral(F f, double from, double to, int panels) {
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < gauss<5>.points.size(); ++i) {
      sum += gauss<5>.weights[i] * f(from + (to - from) * (panel + gauss<5>.points[i]) / panels);
    }
  }
  return (to - from) * sum / panels;
}

// The last value computed of a law at some argument: a run asks several times for the same.
template <class Value>
struct Last {
  std::uint64_t law = 0;
  double at = 0.0;
  Value value = {};

  template <class Compute>
  const Value& of(std::uint64_t this_law, double argument, Compute compute) {
    if (law != this_law || at != argument) *this = {this_law, argument, compute()};
    return value;
  }
};

// Of half widths for which starts are stored, in nose radii; below and above, guesses do.
constexpr double narrowest = 1e-6, widest_of_radius = 1.0;

}  // namespace

MidPlaneContact::MidPlaneContact(std::string name, NoseOnBeam nose,
                                 std::optional<MeanPressure> pressure)
    : name_(std::move(name)),
      nose_(std::move(nose)),
      pressure_(std::move(pressure)),
      first_yield_(pressure_ ? elastic_indentation(nose_.stiffness, pressure_->first_yield).at
                             : std::numeric_limits<double>::infinity()),
      serial_(++n_laws) {
  const double widest = std::min(nose_.widest, widest_of_radius * nose_.radius);
  elastic_starts_ = StartTable([this](double a) { return elastic_indentation(nose_.stiffness, a); },
                               std::min(narrowest * nose_.radius, 0.5 * widest), widest);
  if (!pressure_ || !(pressure_->first_yield < 0.5 * widest)) return;
  plastic_starts_ = StartTable([this](double a) { return indentation(a, 1.0, loading_force(a)); },
                               pressure_->first_yield, widest);
}

ContactScales MidPlaneContact::scales() const {
  if (nose_.order != 3) return ContactLaw::scales();
  return {nose_.stiffness * nose_.radius * std::sqrt(nose_.radius), 1.5};  // Hertz's
}

double MidPlaneContact::power(double a) const { return nose_.order == 3 ? a * a * a : a * a; }

ValueAndSlope MidPlaneContact::elastic_force(double stiffness, double a) const {
  return {stiffness * power(a), stiffness * nose_.order * power(a) / a};
}

ValueAndSlope MidPlaneContact::loading_force(double a) const {
  if (!pressure_ || a <= pressure_->first_yield) return elastic_force(nose_.stiffness, a);
  const auto [pressure, slope] = pressure_->beyond_it(a);
  const double area = nose_.area * power(a) / a;
  return {area * pressure, area * (slope + (nose_.order - 1) * pressure / a)};
}

ValueAndSlope MidPlaneContact::indentation(double a, double share, ValueAndSlope force) const {
  const auto [c, slope] = nose_.compliance(a);
  return {0.5 * share * a * a / nose_.radius + c * force.at,
          share * a / nose_.radius + c * force.slope + slope * force.at};
}

ValueAndSlope MidPlaneContact::elastic_indentation(double stiffness, double a) const {
  return indentation(a, stiffness / nose_.stiffness, elastic_force(stiffness, a));
}

double MidPlaneContact::half_width_at(double lambda) const {
  thread_local Last<double> last;
  return last.of(serial_, lambda, [&] {
    const auto curve = [this](double a) { return indentation(a, 1.0, loading_force(a)); };
    const StartTable& starts = lambda > first_yield_ ? plastic_starts_ : elastic_starts_;
    return inverse_of_power(curve, lambda, starts(lambda, std::sqrt(1.5 * nose_.radius * lambda)));
  });
}

// A dent's indentations are those of the flat surface times k_m/k.
double MidPlaneContact::half_width_of(const Dent& dent, double lambda) const {
  const double above = std::abs(lambda - dent.residual) * (nose_.stiffness / dent.stiffness);
  if (above == 0.0) return 0.0;
  thread_local Last<double> last;
  return last.of(serial_, above, [&] {
    const auto curve = [this](double a) { return elastic_indentation(nose_.stiffness, a); };
    return inverse_of_power(curve, above, elastic_starts_(above, std::sqrt(nose_.radius * above)));
  });
}

MidPlaneContact::Dent MidPlaneContact::dent_of(ContactHistory history) const {
  const double deepest = history.max_indentation;
  if (!(deepest > first_yield_)) return {nose_.stiffness, 0.0};
  thread_local Last<Dent> last;
  return last.of(serial_, deepest, [&]() -> Dent {
    const double a = half_width_at(deepest), stiffness = loading_force(a).at / power(a);
    return {stiffness, 0.5 * a * a / nose_.radius * (1.0 - stiffness / nose_.stiffness)};
  });
}

double MidPlaneContact::largest_indentation() const {
  if (std::isinf(nose_.widest)) return nose_.widest;
  return indentation(nose_.widest, 1.0, loading_force(nose_.widest)).at;
}

// Slopes grow up to the end of the law.
double MidPlaneContact::largest_slope(double lambda) const {
  const double x = std::min(lambda, (1.0 - 1e-6) * largest_indentation());
  return slope({x}, x);
}

double MidPlaneContact::force(ContactHistory history, double lambda) const {
  const Dent dent = dent_of(history);
  return std::copysign(dent.stiffness * power(half_width_of(dent, lambda)), lambda - dent.residual);
}

double MidPlaneContact::slope(ContactHistory history, double lambda) const {
  const Dent dent = dent_of(history);
  const double a = half_width_of(dent, lambda);
  if (a == 0.0) return 0.0;
  return elastic_force(dent.stiffness, a).slope / elastic_indentation(dent.stiffness, a).slope;
}

double MidPlaneContact::plastic_force(double lambda) const {
  if (!(lambda > first_yield_)) return force({}, lambda);
  return loading_force(half_width_at(lambda)).at;
}

double MidPlaneContact::plastic_slope(double lambda) const {
  if (!(lambda > first_yield_)) return slope({}, lambda);
  const double a = half_width_at(lambda);
  const ValueAndSlope force = loading_force(a);
  return force.slope / indentation(a, 1.0, force).slope;
}

// The integral of F d lambda, in which that of c F dF is taken by parts.
double MidPlaneContact::elastic_energy(double stiffness, double a) const {
  const auto part = [&](double x) {
    return std::pow(stiffness * power(x), 2) * nose_.compliance(x).slope;
  };
  constexpr int panels = 4;
  const double within = std::min(a, nose_.widest);  // smooth up to there
  const double rest = integral(part, 0.0, within, panels) + integral(part, within, a, panels);
  const double force = stiffness * power(a), share = stiffness / nose_.stiffness;
  return force * (share * a * a / ((nose_.order + 2) * nose_.radius) +
                  0.5 * force * nose_.compliance(a).at) +
         0.5 * rest;
}

double MidPlaneContact::recoverable_energy(ContactHistory history, double lambda) const {
  const Dent dent = dent_of(history);
  if (!(lambda > dent.residual)) return 0.0;
  return elastic_energy(dent.stiffness, half_width_of(dent, lambda));
}

double MidPlaneContact::dissipated_energy(ContactHistory history) const {
  if (!(history.max_indentation > first_yield_)) return 0.0;
  thread_local Last<double> last;
  return last.of(serial_, history.max_indentation, [&] {
    constexpr double panel = 0.125;
    const double a_y = pressure_->first_yield, a_m = half_width_at(history.max_indentation);
    // In s, a = a_y cosh s, nothing grows like a root where yielding begins.
    const double end = std::acosh(std::max(a_m / a_y, 1.0));
    const auto power_in_s = [&](double s) {
      const double a = a_y * std::cosh(s);
      const ValueAndSlope force = loading_force(a);
      return force.at * indentation(a, 1.0, force).slope * a_y * std::sinh(s);
    };
    const double work = integral(power_in_s, 0.0, end, 1 + static_cast<int>(end / panel));
    const double returned = elastic_energy(loading_force(a_m).at / power(a_m), a_m);
    return std::max(elastic_energy(nose_.stiffness, a_y) + work - returned, 0.0);
  });
}

namespace {

// Of C 2 pi E d/(3 (1 + nu)), with t = a/d.
ValueAndSlope displacement(double t, double poisson) {
  const double square = t * t;
  if (t < 0.1) {  // by series, where the closed form loses its digits
    constexpr int terms = 8;
    double sum = 0.0, slope = 0.0, power = 1.0;  // of -t^2
    for (int i = 0; i < terms; ++i, power *= -square) {
      const double odd = 2 * i + 1;
      const double term = power * (1.0 + 2.0 * (1.0 - poisson) / odd) / (odd + 2.0);
      sum += term;
      slope += 2 * i * term;
    }
    return {sum, slope / t};
  }
  const double theta = std::atan(t), cube = t * square;
  const double sum = ((t - theta) + (1.0 - poisson) * ((1.0 + square) * theta - t)) / cube;
  const double slope = (square / (1.0 + square) + 2.0 * (1.0 - poisson) * t * theta) / cube;
  return {sum, slope - 3.0 * sum / t};
}

}  // namespace

NoseOnBeam ball_on_beam(const BodiesOfBall& of) {
  const double scale = 1.5 * (1.0 + of.beam_poisson) / (M_PI * of.beam_modulus * of.depth);
  const auto compliance = [=](double a) -> ValueAndSlope {
    const double of_shape = 0.375 * (2.0 * of.of_ellipse - 1.0) / (of.modulus * a);
    if (std::isinf(of.depth)) return {of_shape, -of_shape / a};
    const auto [sum, slope] = displacement(a / of.depth, of.beam_poisson);
    return {of_shape - scale * sum, -of_shape / a - scale * slope / of.depth};
  };
  return {3, of.radius, 4.0 * of.modulus / (3.0 * of.radius), M_PI, of.depth, compliance};
}

NoseOnBeam cylinder_across(const BodiesOfLine& of) {
  constexpr double least = 0.5;  // c pi E* b, where the law ends
  const double modulus = 1.0 / (1.0 / of.beam_modulus + 1.0 / of.nose_modulus);
  const double share = modulus / of.beam_modulus, k = of.beam_poisson / (1.0 - of.beam_poisson);
  const double widest =
      std::exp(0.5 * (share * (2.0 * std::log(2.0 * of.depth) - k) +
                      (1.0 - share) * (2.0 * std::log(4.0 * of.radius) - 1.0) - 2.0 - least));
  const double scale = 2.0 / (M_PI * of.width * modulus);
  const auto compliance = [=](double a) -> ValueAndSlope {
    if (a >= widest) return {0.5 * least * scale, 0.0};  // of trial steps
    return {scale * (std::log(widest / a) + 0.5 * least), -scale / a};
  };
  return {2, of.radius, 0.5 / (scale * of.radius), 2.0 * of.width, widest, compliance};
}

}  // namespace subimpact
