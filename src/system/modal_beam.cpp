#include "system/modal_beam.h"

namespace subimpact {

ModalBeam::ModalBeam(const StruckBeam& beam) : beam_(beam) {
  const auto& mesh = dynamic_cast<const ModalMesh&>(beam.mesh());
  frequencies_.assign(mesh.frequencies().begin(), mesh.frequencies().end());
  for (const SparseFunctional::Term& term : mesh.struck_point().terms) {
    loads_.push_back(term.coefficient / mesh.mass().at(term.unknown, term.unknown));
    displacements_.push_back(-term.coefficient);
  }
  if (!beam.damping().is_none()) {
    for (const double damping : beam.modal_damping()) decay_rates_.push_back(0.5 * damping);
    decay_rates_.push_back(0.0);  // the striker
  }
  frequencies_.push_back(0.0);
  loads_.push_back(-1.0 / beam.striker_mass());
  displacements_.push_back(1.0);
}

ForcedOscillators::Force ModalBeam::force(double lambda) const {
  return {beam_.contact().force(lambda), beam_.contact().slope(lambda)};
}

}  // namespace subimpact
