#include <boost/numeric/odeint.hpp>

#include "peer.h"

namespace subimpact::peers {
namespace {

namespace odeint = boost::numeric::odeint;
using Vector = std::vector<double>;

template <class Stepper>
class Odeint final : public PeerIntegrator {
  using Controlled = typename odeint::result_of::make_controlled<Stepper>::type;

 public:
  Odeint(SecondOrderOde& ode, const StepControl& control)
      : PeerIntegrator(ode, control),
        controlled_(odeint::make_controlled(absolute_, 0.0, Stepper())) {}

 protected:
  void reset() override {
    if constexpr (requires { controlled_.reset(); }) controlled_.reset();
  }
  double take_step() override {
    double t = 0.0;
    next_ = std::min(next_, longest_);
    for (int tries = 0; tries < 500; ++tries) {
      if (controlled_.try_step(system(), present_, t, next_) == odeint::success) return t;
    }
    fail("try_step", "step size too small");
  }
  void take_exactly(double length, Vector& y) override {
    Stepper stepper;
    stepper.do_step(system(), y, 0.0, length);
  }

 private:
  auto system() {
    return [this](const Vector& y, Vector& rate, double) { equations_(y.data(), rate.data()); };
  }

  Controlled controlled_;
  double next_ = 1e-3;
};

template <class Stepper>
Peer peer(const char* name) {
  return {name, [](SecondOrderOde& ode, const StepControl& control) -> std::unique_ptr<Integrator> {
            return std::make_unique<Odeint<Stepper>>(ode, control);
          }};
}

}  // namespace

std::vector<Peer> odeint_peers() {
  return {peer<odeint::runge_kutta_dopri5<Vector>>("Boost.odeint dopri5"),
          peer<odeint::runge_kutta_fehlberg78<Vector>>("Boost.odeint fehlberg78")};
}

}  // namespace subimpact::peers
