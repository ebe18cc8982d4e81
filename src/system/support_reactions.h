#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "system/accounts.h"

namespace subimpact {

/// The forces of the supports on the beam, N, positive in the direction of the strike.
///
/// They follow from the balances of momentum and of moment of momentum about x = 0,
///
///     R_0 + R_l = p.(w'' + alpha w') - F,   R_l l = d.(w'' + alpha w') - F x_s + M(0) - M(l),
///
/// with p and d the functionals of momentum and moment of momentum (BeamMesh), F at x_s, the
/// moments M at clamped ends (zero at others), and the damping by mass alpha, a force from outside
/// that is spread over the beam. All other damping is inside the beam: it adds to the moments. The
/// accelerations w'' = Mass^-1 (-B^T W M - K_s w - C w' + S F) are eliminated once, so that a state
/// costs one sum over the sections:
///
///     p.w'' = -sum W_j (B g)_j M_j - (K_s g).w - (C g).w' + F S.g,   Mass g = p.
///
/// With the moments of the equations of motion R_0 + R_l closes their momentum to rounding.
class SupportReactions {
 public:
  /// `struck_at`: x_s, m. `beam` must outlive this.
  SupportReactions(const StruckBeam& beam, double length, double struck_at);

  /// Whether any end is held, on a mesh that gives displacements at the ends.
  bool exist() const { return held_[0] || held_[1]; }

  /// At x = 0 and x = l; none at a free end, or without a moment functional to distinguish the two.
  using Forces = std::array<std::optional<double>, 2>;
  Forces at(const State& y, Accounts& accounts) const;

 private:
  // A functional of the accelerations, as one of moments, unknowns, velocities and contact force.
  struct Eliminated {
    std::vector<double> of_moments;     // -W_j (B g)_j; none in modes
    std::vector<double> of_unknowns;    // -K_s g, in modes -stiffness g; none where neither exists
    std::vector<double> of_velocities;  // -C g; none without damping inside the beam
    double of_force = 0.0;              // S.g
  };
  Eliminated eliminated(std::span<const double> functional) const;
  double value(const Eliminated& of, const State& y, std::span<const double> moments) const;
  // Adds sign times the moment at a clamped end.
  void add_end_moment(double sign, double x, bool first, Eliminated& to) const;
  void add_damping(Eliminated& to) const;
  bool in_modes() const { return !beam_.modal_stiffness().empty(); }

  const StruckBeam& beam_;
  double length_, struck_at_;
  std::array<bool, 2> held_{};
  Eliminated momentum_;
  std::optional<Eliminated> moment_;  // d.w'' + M(0) - M(l)
};

}  // namespace subimpact
