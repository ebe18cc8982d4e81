#pragma once

#include <vector>

#include "ode/free_flight.h"
#include "subimpact/model/natural_modes.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Free flight of a struck beam: no contact, and no section flows. What sections have flowed before
/// is a constant moment; the beam vibrates in its elastic modes about the shape that moment gives
/// it, and the striker moves uniformly. Guards are the curvatures of the sections, limited by their
/// elastic windows, and, as the last, the indentation, limited by the residual one.
class BeamFlight final : public FreeFlight {
 public:
  /// `beam` must outlive this; its mesh is not a ModalMesh.
  explicit BeamFlight(const StruckBeam& beam);

  std::span<const double> frequencies() const override { return frequencies_; }
  std::size_t n_guards() const override { return beam_.sections().size() + 1; }
  std::span<const double> guard(std::size_t i) const override {
    return {guards_.data() + i * frequencies_.size(), frequencies_.size()};
  }
  bool possible() const override {
    return !beam_.in_contact() && beam_.sections().flowing().empty();
  }
  double outlook(const State& y) override;
  void enter(const State& y, std::span<double> z, std::span<double> rates, std::span<double> low,
             std::span<double> high) override;
  void leave(std::span<const double> z, std::span<const double> rates, State& y) const override;

 private:
  const StruckBeam& beam_;
  NaturalModes modes_;
  std::size_t n_;  // modes
  std::vector<double> frequencies_, guards_;
  std::vector<double> shape_;        // w of the equilibrium
  std::vector<double> equilibrium_;  // z of the equilibrium
  std::vector<double> moments_, curvatures_, curvature_rates_;
  mutable std::vector<double> force_;
};

}  // namespace subimpact
