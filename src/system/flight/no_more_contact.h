#pragma once

#include <optional>
#include <span>
#include <vector>

#include "numerics/event_free_horizon.h"
#include "system/readings/accounts.h"

namespace subimpact {

/// Proves, where it can, that striker and beam never touch again.
///
/// Apart, the striker moves uniformly, and so does the rigid part R of the struck point's
/// displacement (its share of the modes of frequency zero). The rest is
///
///     d = S w - R = sum W kbar M + sum W k kbar kappa_p,
///
/// with k the elastic stiffness of a section, kappa_p = kappa - M/k its plastic curvature, and kbar
/// the curvatures of the shape u that a unit force at the struck point gives the beam when the
/// inertia of its rigid motion balances it: d = u^T K w for any w. Let C = sum W k kbar^2 be that
/// shape's compliance and E the energy of the beam beyond its rigid motion, kinetic and elastic.
/// Future plastic work D reduces E, and nothing increases E, so
///
///   - |sum W kbar M| <= sqrt(2 C U_e) <= sqrt(2 C (E - D)), since M^2/(2 k) is at most the elastic
///     energy of a section (both by Cauchy and Schwarz);
///   - the plastic part of d changes by no more than a D, a = max|kbar| modulus h/(2 Y) (times
///     Fibres::extent, 1 for a rectangle), since a fibre that flows by d eps dissipates Y |d eps|
///     per volume.
///
/// Over 0 <= D <= E the sum of both parts is at most f = sqrt(2 C E), or a E + C/(2 a) if 2 a^2 E >
/// C. Hence
///
///     lambda(t) <= [w_m - R - d_p + f] + (v_m - R') t   for all later t,
///
/// d_p the plastic part now: if the striker does not approach the rigid motion, v_m <= R', and the
/// bracket is below the residual indentation, they never meet. Rigorous for the discrete beam,
/// whatever its section law and ends. Damping of the beam takes energy, as plastic work does, and
/// leaves the rigid motion alone, but for damping by mass: R' then falls to zero, and v_m <= 0 is
/// needed too.
///
/// Under loads that stay as they are, bodies that these press together meet again, and nothing is
/// proven. Gravity on a beam that nothing holds moves both bodies alike and leaves all of the above
/// as it is. A held beam that stays elastic moves as without loads about its equilibrium w_s: w -
/// w_s takes the place of w, and the striker's uniform motion is above its own where loads pull it
/// away. Nothing is proven of beams that other loads bend and that may yield, or that nothing
/// holds.
///
/// The energy of a tension (Tension) is part of E, so that the bound holds with it, but for loads.
///
/// A beam that is elastic and undamped, without tension, is followed beyond that: its lowest modes
/// move freely (EventFreeHorizon), and the rest of d stays below sqrt(2 C' E'), with the compliance
/// and the energy of the other modes. It is followed until the gap exceeds all that d can be.
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
  std::vector<Mode> modes_;  // the lowest
  std::vector<double> bar_;  // W kbar; empty where the sections cannot yield
  bool can_prove_ = false;
  bool is_damped_;
  bool rigid_motion_decays_;                 // by damping
  double compliance_ = 0.0;                  // C, m/N
  double compliance_of_rest_ = 0.0;          // C', m/N, but for the lowest modes
  double plastic_compliance_ = 0.0;          // a, m/J
  std::optional<EventFreeHorizon> horizon_;  // of elastic beams
  Accounts accounts_;
};

}  // namespace subimpact
