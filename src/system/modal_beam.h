#pragma once

#include <span>
#include <vector>

#include "system/struck_beam.h"

namespace subimpact {

/// A struck beam on a modal mesh, as oscillators driven by the contact force; the striker is
/// the last of them. Only while no section flows.
class ModalBeam final : public ForcedOscillators {
 public:
  /// `beam`'s mesh must be a ModalMesh (std::bad_cast otherwise); both must outlive this.
  explicit ModalBeam(const StruckBeam& beam);

  std::span<const double> frequencies() const override { return frequencies_; }
  std::span<const double> decay_rates() const override { return decay_rates_; }
  std::span<const double> loads() const override { return loads_; }
  std::span<const double> displacements() const override { return displacements_; }
  Force force(double lambda) const override {
    return {beam_.contact().force(lambda), beam_.contact().slope(lambda)};
  }
  bool has_loads() const override { return !beam_.loads().is_empty(); }
  Loads loads_from(double t0) override;
  bool is_free() const override { return !beam_.contact().is_closed(); }
  double critical_displacement() const override { return beam_.contact().residual_indentation(); }
  SecondOrderOde::Scales scales() const override { return beam_.scales(); }

 private:
  const StruckBeam& beam_;
  std::vector<double> frequencies_, decay_rates_, loads_, displacements_;
  std::vector<double> accelerations_, rates_;  // of loads_from()
};

}  // namespace subimpact
