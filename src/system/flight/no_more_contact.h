#pragma once

#include <optional>
#include <span>
#include <vector>

#include "numerics/event_free_horizon.h"
#include "system/readings/accounts.h"

namespace subimpact {

/// Proves, where it can, that striker and beam never touch again: by the energy of the beam and,
/// where it is elastic and undamped, without tension, by the motion of its lowest modes until the
/// gap exceeds all that the beam can bridge (derived in docs/theory/events.md, "No more contact").
/// Rigorous for the discrete beam, whatever its section law and ends.
///
/// Nothing is proven under loads that change or that press the bodies together, of beams that other
/// loads than gravity bend and that may yield, that nothing holds or that have a tension, and of
/// beams on supports that lift.
class NoMoreContact {
 public:
  /// `beam` must outlive this. `first_period`: of its bending, roughly, s.
  NoMoreContact(const StruckBeam& beam, const Beam& material, double first_period);
  /// Whether no contact can follow the state y, which is separated and committed.
  bool is_proven(const StruckBeam& beam, const State& y);

 private:
  struct Mode {
    double frequency;             // rad/s; 0: rigid
    double share;                 // S phi
    std::vector<double> shape;    // phi
    std::vector<double> inertia;  // Mass phi
  };
  // Takes the compliance of sections that can yield; `response`: the shape u.
  void take_plastic_compliance(const StruckBeam& beam, std::span<const double> response,
                               const Beam& material);
  // Whether loads leave room for a proof; about_ is then the state of rest.
  bool allow_loads(const StruckBeam& beam);
  // Whether z0 + rate0 t - sum share z_k(t) stays below a limit (m) for all t.
  bool stays_below(double limit, std::span<const double> z, std::span<const double> rates);

  std::size_t n_;
  std::vector<double> about_;  // w_s; empty: straight
  double loads_begun_ = -1.0;  // s: the piece of the loads for which it holds
  bool loads_allow_ = true;
  std::vector<Mode> modes_;                  // the lowest; none: nothing can be proven
  std::vector<double> bar_;                  // W kbar; empty where the sections cannot yield
  double compliance_ = 0.0;                  // C, m/N
  double compliance_of_rest_ = 0.0;          // C', m/N, but for the lowest modes
  double plastic_compliance_ = 0.0;          // a, m/J
  std::optional<EventFreeHorizon> horizon_;  // of elastic beams
  Accounts accounts_;
};

}  // namespace subimpact
