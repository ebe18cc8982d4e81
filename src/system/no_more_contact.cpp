#include "system/no_more_contact.h"

#include <algorithm>
#include <cmath>

#include "numerics/lanes.h"

namespace subimpact {

NoMoreContact::NoMoreContact(const StruckBeam& beam, const Beam& material)
    : n_(beam.mesh().n_unknowns()),
      rigid_motion_decays_(beam.damping().mass > 0.0),
      accounts_(beam),
      curvatures_(beam.mesh().n_sections()),
      moments_(beam.mesh().n_sections()) {
  const BeamMesh& mesh = beam.mesh();
  const SectionField& sections = beam.sections();
  std::vector<double> momentum(n_), reaction(n_, 0.0);
  const NaturalModes modes = mesh.natural_modes(sections.stiffness());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::span<const double> phi = modes.shape(k);
    const double frequency = modes.frequencies[k];
    const double share = mesh.struck_point()(phi);
    if (frequency == 0.0) {
      mesh.mass().multiply(phi, momentum);
      rigid_.push_back(momentum);
      rigid_share_.push_back(share);
      continue;
    }
    const double amount = share / (frequency * frequency);
    compliance_ += share * amount;
    for (std::size_t i = 0; i < n_; ++i) reaction[i] += amount * phi[i];
  }
  if (!sections.can_yield()) return;
  mesh.curvatures(reaction, curvatures_);
  double largest = 0.0;
  for (std::size_t i = 0; i < curvatures_.size(); ++i) {
    largest = std::max(largest, std::abs(curvatures_[i]));
    bar_.push_back(mesh.section_weights()[i] * curvatures_[i]);
  }
  plastic_compliance_ = largest * material.youngs_modulus * 0.5 * material.thickness /
                        material.yield_stress * sections.law().fibres().extent();
}

bool NoMoreContact::is_proven(const StruckBeam& beam, const State& y) {
  if (beam.contact().is_closed()) return false;
  const std::span<const double> w{y.data(), n_};
  const std::span<const double> v{y.data() + n_ + 1, n_};
  const Energies energies = accounts_.energies(y);
  double energy = energies.beam_kinetic + energies.bending_elastic;
  double rigid = 0.0;
  double rigid_rate = 0.0;
  for (std::size_t k = 0; k < rigid_.size(); ++k) {
    const double rate = dot(rigid_[k].data(), v.data(), n_);
    rigid += rigid_share_[k] * dot(rigid_[k].data(), w.data(), n_);
    rigid_rate += rigid_share_[k] * rate;
    energy -= 0.5 * rate * rate;
  }
  energy = std::max(energy, 0.0);
  if (!(y.back() <= rigid_rate)) return false;
  if (rigid_motion_decays_ && y.back() > 0.0) return false;

  double plastic = 0.0;
  if (!bar_.empty()) {
    const SectionField& sections = beam.sections();
    beam.mesh().curvatures(w, curvatures_);
    sections.moments(curvatures_, moments_);
    for (std::size_t i = 0; i < bar_.size(); ++i) {
      plastic += bar_[i] * (sections.stiffness() * curvatures_[i] - moments_[i]);
    }
  }
  const double a = plastic_compliance_;
  const double bound = 2.0 * a * a * energy > compliance_ ? a * energy + compliance_ / (2.0 * a)
                                                          : std::sqrt(2.0 * compliance_ * energy);
  return y[n_] - rigid - plastic + bound < beam.contact().residual_indentation();
}

}  // namespace subimpact
