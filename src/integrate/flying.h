#pragma once

#include <memory>
#include <vector>

#include "integrate/safe_flight.h"
#include "ode/free_flight.h"
#include "ode/integrator.h"

namespace subimpact {

/// Another integrator, spared the stretches of free flight (FreeFlight): there the motion is known
/// in closed form, and one step goes as far as it can be shown that no guard reaches its limits.
///
/// The proof that a flight passes nothing over is SafeFlight's; from where it ends the other
/// integrator goes on.
///
/// To find out how far a flight goes takes a few passes over the matrix of guards, as much as some
/// steps of the other integrator. So it is only tried where the outlook is good, and less often
/// where flights did not pay.
class Flying final : public Integrator {
 public:
  /// `max_step`: longest flight in one step, s; infinite if it does not matter.
  Flying(std::unique_ptr<Integrator> integrator, std::unique_ptr<FreeFlight> flight,
         double max_step);

  void restart(double t, const State& y) override;
  void step() override;
  void state_at(double t, State& y) override;
  bool is_eventless() const override { return flown_; }
  WorkCounts work() const override;

 private:
  void move(double t);

  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<FreeFlight> flight_;
  SafeFlight safe_flight_;
  double max_step_;
  std::span<const double> omega_;
  std::size_t n_;
  bool flown_ = false;       // the last step was a flight
  bool follows_ = false;     // the other integrator stands at (t1_, y1_)
  int waited_ = 0;           // its steps since free flight became possible or was tried
  double usual_step_ = 0.0;  // its last step, s
  int patience_;
  long flights_ = 0;

  std::vector<double> z0_, rates0_, low_, high_;  // as the flight began
  std::vector<double> z_, rates_;
};

}  // namespace subimpact
