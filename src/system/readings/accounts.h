#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "subimpact/system/readings.h"
#include "system/struck_beam.h"

namespace subimpact {

/// kappa - M/(E I), 1/m; 0 where the two differ by rounding, as in sections that never yielded.
inline double plastic_curvature(double curvature, double moment, double stiffness) {
  constexpr double rounding = 1e-12;
  const double plastic = curvature - moment / stiffness;
  return std::abs(plastic) > rounding * std::abs(curvature) ? plastic : 0.0;
}

/// Energies, momenta and other quantities of the states of a struck beam. The beam is not changed.
class Accounts {
 public:
  /// Both must outlive this. `sections`: the histories that are used, by default those of the beam.
  explicit Accounts(const StruckBeam& beam) : Accounts(beam, beam.sections()) {}
  Accounts(const StruckBeam& beam, const SectionField& sections);

  const StruckBeam& beam() const { return beam_; }

  /// Energies at a time (s), which matters only if loads change.
  Energies energies(const State& y, double t = 0.0);
  /// kg m/s, of beam and striker, without the impulse of gravity and loads since t = 0, and with
  /// what supports that lift and the damping by mass have taken since then: alpha times the
  /// integral of the beam's momentum.
  double momentum(const State& y, double t = 0.0) const;
  double beam_momentum(const State& y) const;  ///< kg m/s
  /// N s, up to a constant: the impulse of the contact force on a beam without supports or springs,
  /// from its own momentum.
  double beam_impulse(const State& y, double t) const;
  /// Whether striker and loads alone act on the beam: no supports, springs or stop.
  bool conserves_momentum() const {
    return !beam_.mesh().translation().empty() && !beam_.has_stop();
  }

  struct Displacements {
    double struck, striker, first_end;  ///< m
  };
  Displacements displacements(const State& y) const;

  /// Curvatures (1/m) and moments M (N m) of all sections; valid until the next call.
  struct Bending {
    std::span<const double> curvatures, moments;
  };
  Bending bending(const State& y);
  double back_stress(const State& y) const;  ///< outer fibre at the struck section, far side, Pa

 private:
  const StruckBeam& beam_;
  const SectionField& sections_;
  std::vector<double> curvatures_, moments_;
};

/// Coefficients, on the velocities of the unknowns, of the velocity (m/s) that the struck point
/// would have if the beam moved as a rigid body with its momentum and moment of momentum: a body
/// free to move and turn, or one that turns about its one pinned end. Between other supports, and
/// on springs, it stands still (nothing); against a stop a beam on springs counts as free, one
/// between other supports has its mean velocity, as has a free beam whose mesh does not give the
/// moment of momentum.
std::vector<double> rigid_motion_at_struck_point(const StruckBeam& struck_beam, const Beam& beam,
                                                 double position);

}  // namespace subimpact
