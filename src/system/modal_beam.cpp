#include "system/modal_beam.h"

namespace subimpact {

ModalBeam::ModalBeam(const StruckBeam& beam) : beam_(beam) {
  const auto& mesh = dynamic_cast<const ModalMesh&>(beam.mesh());
  frequencies_.assign(mesh.frequencies().begin(), mesh.frequencies().end());
  for (const SparseFunctional::Term& term : mesh.struck_point().terms) {
    loads_.push_back(term.coefficient / mesh.mass().at(term.unknown, term.unknown));
    displacements_.push_back(-term.coefficient);
  }
  frequencies_.push_back(0.0);
  loads_.push_back(-1.0 / beam.striker_mass());
  displacements_.push_back(1.0);
}

ForcedOscillators::Force ModalBeam::force(double lambda) const {
  const ContactLaw& law = beam_.contact_law();
  const ContactBranch branch = beam_.contact_branch();
  const ContactHistory history = beam_.contact_history();
  return {law.branch_force(branch, history, lambda), law.branch_slope(branch, history, lambda)};
}

}  // namespace subimpact
