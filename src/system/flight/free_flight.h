#pragma once

#include <memory>
#include <vector>

#include "numerics/event_free_horizon.h"
#include "ode/integrator.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Another integrator, spared the free flight of a struck beam: stretches without contact in which
/// no section flows (docs/theory.md, "Free flight"). A free flight is one step in closed form, up
/// to the event-free horizon (EventFreeHorizon); from there the other integrator goes on.
class FreeFlight final : public Integrator {
 public:
  /// `beam` must outlive this; its mesh is not a ModalMesh. `max_step`: longest step, s.
  FreeFlight(std::unique_ptr<Integrator> other, const StruckBeam& beam, double max_step);

  void restart(double t, const State& y) override;
  void limit_next_step(double longest) override { other_->limit_next_step(longest); }
  void step() override;
  void state_at(double t, State& y) override;
  void expect(std::span<const double> times) override {
    expected_.assign(times.begin(), times.end());
    n_batch_ = 0;
  }
  bool is_event_free() const override { return flying_; }
  std::optional<std::pair<double, double>> around_largest() const override {
    return around(horizon_.time_of_largest());
  }
  std::optional<std::pair<double, double>> around_smallest() const override {
    return around(horizon_.time_of_smallest());
  }
  WorkCounts work() const override;

 private:
  EventFreeHorizon make_horizon() const;
  // Two times in the flight on either side of a sample's, which is that long after its start.
  std::optional<std::pair<double, double>> around(double sample) const;
  // Whether y1_ begins a free flight, and one that lasts for a time if rates stay as they are.
  bool may_last(double time);
  // The share of each mode in unknown i.
  const double* phi_row(std::size_t i) const { return phi_rows_.data() + i * n_; }
  // Phi^T f, into entries 1 to n of `modal`.
  void to_modes(std::span<const double> f, std::vector<double>& modal) const;
  // w_e and the limits of the event functions about it, for past flow as it is now.
  void find_equilibrium();
  // Enters free flight at y1_; its event-free horizon, s.
  double begin();
  // The state a time t after free flight began.
  void closed_form(double t, State& y);
  // The states at expected times from the first on.
  void compute_batch(std::size_t first);
  // Striker and modes a time t after free flight began.
  void flow_to(double t, double* z, double* rates) const;

  std::unique_ptr<Integrator> other_;
  const StruckBeam& beam_;
  NaturalModes modes_;
  std::size_t n_;                 // modes
  std::vector<double> phi_rows_;  // Phi row by row
  EventFreeHorizon horizon_;
  double max_step_;
  bool flying_ = false;            // the last step was a free flight
  bool other_is_current_ = false;  // other_ stands at (t1_, y1_)
  double other_step_ = 0.0;        // its last step, s
  int steps_since_horizon_ = 0;    // its steps since a horizon was last computed
  long flights_ = 0;

  std::vector<double> shape_;        // w_e
  std::vector<double> equilibrium_;  // Phi^T Mass w_e, as z0_
  std::vector<double> z0_, rates0_;  // as free flight began: the striker, then the modes
  std::vector<double> z_, rates_, force_, curvatures_, low_, high_;
  std::vector<double> expected_;  // times, s
  // The states at some of them, computed at once: from that of this index on, this many.
  std::size_t first_of_batch_ = 0, n_batch_ = 0;
  std::vector<double> batch_, modal_batch_;
};

}  // namespace subimpact
