#pragma once

// An integrator from outside: velocity Verlet (Verlet 1967; Swope and others 1982), second order,
// for accelerations that depend on positions alone.

#include <memory>
#include <vector>

#include "subimpact/ode/integrator.h"

class VelocityVerlet final : public subimpact::Integrator {
 public:
  VelocityVerlet(subimpact::SecondOrderOde& ode, double step)
      : ode_(ode), n_(ode.n_positions()), step_(step), a0_(n_), a1_(n_), a_within_(n_) {}

  void restart(double t, const subimpact::State& y) override {
    stand_at(t, y);
    ode_.set_time(t);
    ode_.acceleration({y.data(), n_}, a1_);
  }
  void step() override {
    t0_ = t1_;
    y0_ = y1_;
    a0_ = a1_;
    advance(step_, y1_, a1_);
    t1_ = t0_ + step_;
    ++work_.steps;
  }
  void state_at(double t, subimpact::State& y) override { advance(t - t0_, y, a_within_); }

 private:
  // q = q0 + h v0 + h^2/2 a0, v = v0 + h/2 (a0 + a).
  void advance(double h, subimpact::State& y, std::vector<double>& a) {
    y.resize(2 * n_);
    for (std::size_t i = 0; i < n_; ++i) y[i] = y0_[i] + h * (y0_[n_ + i] + 0.5 * h * a0_[i]);
    ode_.set_time(t0_ + h);
    ode_.acceleration({y.data(), n_}, a);
    for (std::size_t i = 0; i < n_; ++i) y[n_ + i] = y0_[n_ + i] + 0.5 * h * (a0_[i] + a[i]);
  }

  subimpact::SecondOrderOde& ode_;
  std::size_t n_;
  double step_;
  std::vector<double> a0_, a1_, a_within_;
};

inline std::shared_ptr<const subimpact::OwnIntegrator> velocity_verlet() {
  const auto make = [](subimpact::SecondOrderOde& ode, const subimpact::StepControl& control) {
    return std::make_unique<VelocityVerlet>(ode, control.step.value());
  };
  return std::make_shared<subimpact::OwnIntegrator>(subimpact::OwnIntegrator{make, 2});
}
