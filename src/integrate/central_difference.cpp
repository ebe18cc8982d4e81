#include "integrate/central_difference.h"

#include <utility>

namespace subimpact {

CentralDifference::CentralDifference(SecondOrderOde& ode, double step, bool constant_force_on_last)
    : ode_(ode),
      n_(ode.n_positions()),
      step_(step),
      constant_force_on_last_(constant_force_on_last),
      a0_(n_),
      a1_(n_),
      a_partial_(n_) {}

void CentralDifference::restart(double t, const State& y) {
  stand_at(t, y);
  origin_ = t;
  steps_from_origin_ = 0;
  ode_.set_time(t);
  ode_.acceleration({y1_.data(), n_}, a1_);
  ++work_.right_hand_sides;
}

void CentralDifference::advance(double t, double h, const State& from, const AlignedVector& a_from,
                                State& y, AlignedVector& acceleration) {
  const double half = 0.5 * h;
  const double* q0 = from.data();
  const double* v0 = q0 + n_;
  double* q = y.data();
  double* v = q + n_;
  const double* a0 = a_from.data();
  const double* a1 = acceleration.data();
  assign_by_lines(v, n_, [=](auto at) { return at(v0) + half * at(a0); });
  assign_by_lines(q, n_, [=](auto at) { return at(q0) + h * at(v); });
  if (constant_force_on_last_) q[n_ - 1] = q0[n_ - 1] + h * v0[n_ - 1];
  ode_.set_time(t + h);
  ode_.acceleration({q, n_}, acceleration);
  ++work_.right_hand_sides;
  assign_by_lines(v, n_, [=](auto at) { return at(v) + half * at(a1); });
}

void CentralDifference::step() {
  std::swap(y0_, y1_);
  std::swap(a0_, a1_);
  t0_ = t1_;
  advance(t0_, step_, y0_, a0_, y1_, a1_);
  t1_ = origin_ + static_cast<double>(++steps_from_origin_) * step_;
  ++work_.steps;
}

void CentralDifference::state_at(double t, State& y) {
  y.resize(2 * n_);
  advance(t0_, t - t0_, y0_, a0_, y, a_partial_);
  ++work_.partial_steps;
}

void CentralDifference::state_before_end(double t, State& y) {
  y.resize(2 * n_);
  advance(t1_, t - t1_, y1_, a1_, y, a_partial_);
  ++work_.partial_steps;
}

}  // namespace subimpact
