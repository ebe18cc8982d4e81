#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "peer.h"

namespace subimpact::peers {
namespace {

template <auto function>
struct Free {
  template <class T>
  void operator()(T* of) const {
    function(of);
  }
};
using Stepper = std::unique_ptr<gsl_odeiv2_step, Free<gsl_odeiv2_step_free>>;

class Gsl final : public PeerIntegrator {
 public:
  Gsl(SecondOrderOde& ode, const StepControl& control, const gsl_odeiv2_step_type* type)
      : PeerIntegrator(ode, control),
        system_{rate, nullptr, equations_.size(), this},
        stepper_(gsl_odeiv2_step_alloc(type, equations_.size())),
        exact_(gsl_odeiv2_step_alloc(type, equations_.size())),
        control_(gsl_odeiv2_control_standard_new(absolute_, 0.0, 1.0, 0.0)),
        evolve_(gsl_odeiv2_evolve_alloc(equations_.size())),
        errors_(equations_.size()) {
    gsl_set_error_handler_off();
  }

 protected:
  void reset() override {
    gsl_odeiv2_evolve_reset(evolve_.get());
    gsl_odeiv2_step_reset(stepper_.get());
  }
  double take_step() override {
    double t = 0.0;
    next_ = std::min(next_, longest_);
    const int flag = gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), stepper_.get(),
                                             &system_, &t, 1e300, &next_, present_.data());
    if (flag != GSL_SUCCESS) fail("gsl_odeiv2_evolve_apply", gsl_strerror(flag));
    return t;
  }
  void take_exactly(double length, std::vector<double>& y) override {
    gsl_odeiv2_step_reset(exact_.get());
    const int flag = gsl_odeiv2_step_apply(exact_.get(), 0.0, length, y.data(), errors_.data(),
                                           nullptr, nullptr, &system_);
    if (flag != GSL_SUCCESS) fail("gsl_odeiv2_step_apply", gsl_strerror(flag));
  }

 private:
  static int rate(double, const double* y, double* rate, void* self) {
    static_cast<Gsl*>(self)->equations_(y, rate);
    return GSL_SUCCESS;
  }

  gsl_odeiv2_system system_;
  Stepper stepper_, exact_;
  std::unique_ptr<gsl_odeiv2_control, Free<gsl_odeiv2_control_free>> control_;
  std::unique_ptr<gsl_odeiv2_evolve, Free<gsl_odeiv2_evolve_free>> evolve_;
  std::vector<double> errors_;
  double next_ = 1e-3;
};

Peer peer(const char* name, const gsl_odeiv2_step_type* type) {
  return {name,
          [type](SecondOrderOde& ode, const StepControl& control) -> std::unique_ptr<Integrator> {
            return std::make_unique<Gsl>(ode, control, type);
          }};
}

}  // namespace

std::vector<Peer> gsl_peers() {
  return {peer("GSL rk8pd", gsl_odeiv2_step_rk8pd), peer("GSL rkf45", gsl_odeiv2_step_rkf45)};
}

}  // namespace subimpact::peers
