#pragma once

#include <span>
#include <vector>

#include "subimpact/system/energies.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Energies, momenta and other readings of a struck beam's states. Changes nothing in the beam.
class Accounts {
 public:
  /// Both must outlive this. `sections`: the histories to read by, the beam's own by default.
  explicit Accounts(const StruckBeam& beam) : Accounts(beam, beam.sections()) {}
  Accounts(const StruckBeam& beam, const SectionField& sections);

  const StruckBeam& beam() const { return beam_; }

  Energies energies(const State& y);
  double momentum(const State& y) const;       ///< kg m/s, of beam and striker
  double beam_momentum(const State& y) const;  ///< kg m/s
  /// Whether nothing but the striker acts on the beam.
  bool conserves_momentum() const { return !beam_.mesh().translation().empty(); }

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

}  // namespace subimpact
