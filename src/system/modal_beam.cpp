#include "system/modal_beam.h"

#include "model/mesh/modal_mesh.h"

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
  loads_.push_back(-1.0 / beam.striker_mass());  // 0 of a stop
  displacements_.push_back(1.0);
}

ForcedOscillators::Loads ModalBeam::loads_from(double t0) {
  const subimpact::Loads& loads = beam_.loads();
  if (loads.is_empty()) return {};
  const std::size_t n = beam_.mesh().n_unknowns();
  accelerations_.assign(n + 1, beam_.striker_load());
  rates_.assign(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const double mass = beam_.mesh().mass().at(i, i);
    rates_[i] = loads.rate()[i] / mass;
    accelerations_[i] = loads.value()[i] / mass + (t0 - loads.start()) * rates_[i];
  }
  return {accelerations_, rates_};
}

}  // namespace subimpact
