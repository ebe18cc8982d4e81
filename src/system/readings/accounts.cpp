#include "system/readings/accounts.h"

#include "numerics/lanes.h"

namespace subimpact {

Accounts::Accounts(const StruckBeam& beam, const SectionField& sections)
    : beam_(beam), sections_(sections), curvatures_(sections.size()), moments_(sections.size()) {}

Energies Accounts::energies(const State& y, double t) {
  const BeamMesh& mesh = beam_.mesh();
  const std::span<const double> modal = beam_.modal_stiffness();
  Energies sum;
  if (!beam_.has_stop()) sum.striker = 0.5 * beam_.striker_mass() * y.back() * y.back();
  sum.beam_kinetic = 0.5 * mesh.mass().quadratic_form(beam_.beam_velocities(y));
  if (!modal.empty()) {
    for (std::size_t i = 0; i < modal.size(); ++i) sum.bending_elastic += modal[i] * y[i] * y[i];
    sum.bending_elastic *= 0.5;
  } else {
    mesh.curvatures(beam_.beam_positions(y), curvatures_);
    const auto bending = sections_.energies(curvatures_, mesh.section_weights());
    sum.bending_elastic = bending.elastic + mesh.shear_energy(beam_.beam_positions(y));
    sum.bending_plastic = bending.plastic;
    if (const Tension* tension = beam_.tension()) {
      const Tension::Energies axial = tension->energies(beam_.beam_positions(y));
      sum.bending_elastic += axial.elastic;
      sum.bending_plastic += axial.plastic;
    }
  }
  const ContactState::Energies contact = beam_.contact().energies(beam_.indentation(y));
  sum.contact_elastic = contact.elastic;
  sum.contact_plastic = contact.plastic + beam_.losses().contact;
  sum.beam_damping = beam_.losses().beam;
  sum.bending_plastic -= beam_.spent().bending;
  sum.contact_plastic -= beam_.spent().contact;
  sum.work = beam_.work_of_loads(y, t);
  return sum;
}

double Accounts::momentum(const State& y, double t) const {
  const Loads& loads = beam_.loads();
  return beam_.striker_mass() * (y.back() - loads.gravity() * t) + beam_impulse(y, t);
}

double Accounts::beam_impulse(const State& y, double t) const {
  double sum = beam_momentum(y);
  if (!beam_.loads().is_empty()) sum -= beam_.loads().impulse(t);
  const double alpha = beam_.damping().mass;
  if (alpha == 0.0) return sum;
  const std::span<const double> positions = beam_.beam_positions(y);
  return sum +
         alpha * dot(beam_.mesh().momentum_functional().data(), positions.data(), positions.size());
}

double Accounts::beam_momentum(const State& y) const {
  const std::span<const double> velocities = beam_.beam_velocities(y);
  return dot(beam_.mesh().momentum_functional().data(), velocities.data(), velocities.size());
}

Accounts::Displacements Accounts::displacements(const State& y) const {
  const auto unknowns = beam_.beam_positions(y);
  return {beam_.mesh().struck_point()(unknowns), y[unknowns.size()],
          beam_.mesh().first_end()(unknowns)};
}

Accounts::Bending Accounts::bending(const State& y) {
  beam_.mesh().curvatures(beam_.beam_positions(y), curvatures_);
  sections_.moments(curvatures_, moments_);
  return {curvatures_, moments_};
}

double Accounts::back_stress(const State& y) const {
  const std::size_t section = beam_.mesh().struck_section();
  return sections_.outer_stress(section, beam_.mesh().curvature(section, beam_.beam_positions(y)),
                                beam_.outer_stiffness());
}

}  // namespace subimpact
