#pragma once

/// Integrators of other libraries in this program's event loop: the same equations, the same
/// location of events, the same accounts of sections; only the steps are theirs.

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../measure.h"
#include "ode/integrator.h"

namespace subimpact::peers {

/// The published strike as the peers run it.
struct PeerScene {
  const char* name;
  SectionKind section;
  bool shears;  ///< Timoshenko's beam, and a line contact
};
inline constexpr PeerScene peer_scenes[] = {{"elastic", SectionKind::elastic, false},
                                            {"exact", SectionKind::exact, false},
                                            {"layered", SectionKind::layers, false},
                                            {"elastic-with-shear", SectionKind::elastic, true},
                                            {"exact-with-shear", SectionKind::exact, true}};
inline Case case_of(const PeerScene& scene) {
  return scene.shears ? benchmarks::paper_case_with_shear(scene.section)
                      : benchmarks::paper_case(scene.section);
}

struct StepControl {
  double tolerance;                ///< of every position over its scale, and of every velocity
  std::optional<double> max_step;  ///< s
};

/// The equations as first-order libraries take them: y = [q, tau v] over t/tau, tau being the ratio
/// of the scales of position and velocity, so that one absolute tolerance (m) serves all entries.
class Equations {
 public:
  explicit Equations(SecondOrderOde& ode)
      : ode_(ode),
        n_(ode.n_positions()),
        unit_(ode.scales().position / ode.scales().velocity),
        scale_(ode.scales().position) {}

  std::size_t size() const { return 2 * n_; }
  double unit() const { return unit_; }    ///< tau, s
  double scale() const { return scale_; }  ///< m

  void operator()(const double* y, double* rate) const {
    for (std::size_t i = 0; i < n_; ++i) rate[i] = y[n_ + i];
    ode_.acceleration({y, n_}, {rate + n_, n_});
    const double squared = unit_ * unit_;
    for (std::size_t i = n_; i < 2 * n_; ++i) rate[i] *= squared;
  }
  void to_peer(const State& y, double* scaled) const {
    for (std::size_t i = 0; i < n_; ++i) scaled[i] = y[i];
    for (std::size_t i = n_; i < 2 * n_; ++i) scaled[i] = unit_ * y[i];
  }
  void from_peer(const double* scaled, State& y) const {
    y.resize(2 * n_);
    for (std::size_t i = 0; i < n_; ++i) y[i] = scaled[i];
    const double rate = 1.0 / unit_;
    for (std::size_t i = n_; i < 2 * n_; ++i) y[i] = rate * scaled[i];
  }

 private:
  SecondOrderOde& ode_;
  std::size_t n_;
  double unit_, scale_;
};

/// What all peers share. Times and lengths of a peer's own functions are in units of tau.
class PeerIntegrator : public Integrator {
 public:
  PeerIntegrator(SecondOrderOde& ode, const StepControl& control)
      : equations_(ode),
        absolute_(control.tolerance * equations_.scale()),
        longest_(control.max_step ? *control.max_step / equations_.unit() : HUGE_VAL),
        present_(equations_.size()),
        start_(equations_.size()),
        trial_(equations_.size()) {}

  void restart(double t, const State& y) override {
    stand_at(t, y);
    equations_.to_peer(y, present_.data());
    reset();
  }
  void step() override {
    start_ = present_;
    std::swap(y0_, y1_);
    t0_ = t1_;
    t1_ = t0_ + equations_.unit() * take_step();
    equations_.from_peer(present_.data(), y1_);
    ++work_.steps;
  }
  void state_at(double t, State& y) override {
    trial_ = start_;
    take_exactly((t - t0_) / equations_.unit(), trial_);
    equations_.from_peer(trial_.data(), y);
    ++work_.partial_steps;
  }

 protected:
  /// After the equations or the state have changed.
  virtual void reset() = 0;
  /// Advances present_ by one accepted step of the peer's own choice, at most longest_; its length.
  virtual double take_step() = 0;
  /// Advances a state by one step of this length.
  virtual void take_exactly(double length, std::vector<double>& y) = 0;

  /// Throws; `call` has returned what it should not.
  [[noreturn]] void fail(const std::string& call, const std::string& flag) {
    y1_ = y0_;
    t1_ = t0_;
    throw IntegrationFailure(t0_, call, flag, {});
  }

  Equations equations_;
  double absolute_, longest_;
  std::vector<double> present_, start_, trial_;
};

struct Peer {
  std::string name;
  std::function<std::unique_ptr<Integrator>(SecondOrderOde&, const StepControl&)> make;
};

// By library; empty, with the reason printed, where the build has none.
std::vector<Peer> odeint_peers();
std::vector<Peer> gsl_peers();
std::vector<Peer> petsc_peers();

}  // namespace subimpact::peers
