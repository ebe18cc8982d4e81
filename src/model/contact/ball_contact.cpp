#include "model/contact/ball_contact.h"

#include <cmath>

namespace subimpact {
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

}  // namespace subimpact
