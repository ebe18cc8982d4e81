#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "system/readings/accounts.h"

namespace subimpact {

/// The forces of the supports on the beam, N, positive in the direction of the strike, from the
/// balances of momentum and of moment of momentum about x = 0 (docs/theory.md, "Beam").
class SupportReactions {
 public:
  /// `struck_at`: x_s, m. `beam` must outlive this.
  SupportReactions(const StruckBeam& beam, double length, double struck_at);

  /// Whether any end is held, on a mesh that gives displacements at the ends, or lies on a support.
  bool exist() const {
    return is_held() || std::ranges::any_of(beam_.supports(), [&](const LiftingSupport& support) {
             return is_at(support, 0) || is_at(support, 1);
           });
  }

  /// At time t (s), x = 0 and x = l; none at a free end, or without a moment functional to
  /// distinguish the two.
  using Forces = std::array<std::optional<double>, 2>;
  Forces at(double t, const State& y, Accounts& accounts) const;

 private:
  // A functional of the accelerations, as one of moments, unknowns, velocities and contact force.
  struct Eliminated {
    std::vector<double> of_moments;     // -W_j (B g)_j; none in modes
    std::vector<double> of_unknowns;    // -K_s g, in modes -stiffness g; none where neither exists
    std::vector<double> of_velocities;  // -C g; none without damping inside the beam
    std::vector<double> of_loads;       // g
    std::vector<double> of_tension;     // G g; none without tension
    std::vector<double> of_supports;    // -a_j.g of each copy of those that lift
    double of_force = 0.0;              // S.g
  };
  Eliminated eliminated(std::span<const double> functional) const;
  double value(const Eliminated& of, double t, const State& y,
               std::span<const double> moments) const;
  // Adds sign times the moment at a clamped end.
  void add_end_moment(double sign, double x, bool first, Eliminated& to) const;
  void add_damping(Eliminated& to) const;
  bool is_held() const { return held_[0] || held_[1]; }
  bool is_at(const LiftingSupport& support, std::size_t end) const {
    return support.position == (end == 0 || beam_.mesh().symmetric() ? 0.0 : length_);
  }
  // Of supports that lift, at x = 0 and x = l.
  Forces on_supports(const State& y) const;
  bool in_modes() const { return !beam_.modal_stiffness().empty(); }

  const StruckBeam& beam_;
  double length_, struck_at_;
  std::array<bool, 2> held_{};
  Eliminated momentum_;
  std::optional<Eliminated> moment_;  // d.w'' + M(0) - M(l)
};

}  // namespace subimpact
