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
  for (const LiftingSupport& support : beam_.supports()) {
    const double depth = support.indentation(beam_.beam_positions(y));
    sum.bending_elastic += support.copies * support.contact.energies(depth).elastic;
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
  for (const LiftingSupport& support : beam_.supports()) {
    sum += support.sense * support.copies * support.impulse;
  }
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

namespace {

constexpr double rounding = 1e-6;  // of meshes that can move as a rigid body

// Whether the beam can turn about its one pinned end.
bool is_pendulum(const Beam& beam) {
  const auto [first, last] = beam.ends;
  return (first == EndSupport::free && last == EndSupport::pinned) ||
         (first == EndSupport::pinned && last == EndSupport::free);
}

}  // namespace

std::vector<double> rigid_motion_at_struck_point(const StruckBeam& struck_beam, const Beam& beam,
                                                 double position) {
  const BeamMesh& mesh = struck_beam.mesh();
  const bool flies = beam.is_free() && (!beam.is_sprung() || struck_beam.has_stop());
  const bool turns = is_pendulum(beam) && !beam.is_sprung();
  if (beam.fixed || !(flies || turns || struck_beam.has_stop())) return {};
  const std::size_t n = mesh.n_unknowns();
  const auto momentum = mesh.momentum_functional(), moment = mesh.moment_functional();
  std::vector<double> sum(n, 0.0);
  if (!turns) {
    for (std::size_t i = 0; i < n; ++i) sum[i] = momentum[i] / mesh.beam_mass();
  }
  const double pivot = !turns ? 0.5 : beam.ends[0] == EndSupport::pinned ? 0.0 : 1.0;
  const double lever = beam.length * (position - pivot);
  if (!(flies || turns) || moment.empty() || lever == 0.0) return sum;
  // With the moment of momentum h.v about the pivot, M r = h is solved by a rotation r.
  std::vector<double> about_pivot(n);
  for (std::size_t i = 0; i < n; ++i) {
    about_pivot[i] = moment[i] - pivot * beam.length * momentum[i];
  }
  std::vector<double> rotation = about_pivot;
  struck_beam.mass_solver().solve(rotation);
  const double of_point = mesh.struck_point()(rotation);
  if (!(std::abs(of_point - lever) <= rounding * beam.length)) return sum;
  const double inertia = dot(about_pivot.data(), rotation.data(), n);
  for (std::size_t i = 0; i < n; ++i) sum[i] += lever / inertia * about_pivot[i];
  return sum;
}

}  // namespace subimpact
