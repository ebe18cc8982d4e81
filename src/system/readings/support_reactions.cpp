#include "system/readings/support_reactions.h"

#include <numeric>

#include "system/readings/beam_field.h"

namespace subimpact {
namespace {

double sum(std::span<const double> coefficients, std::span<const double> values) {
  return std::inner_product(coefficients.begin(), coefficients.end(), values.begin(), 0.0);
}

}  // namespace

SupportReactions::SupportReactions(const StruckBeam& beam, double length, double struck_at)
    : beam_(beam), length_(length), struck_at_(struck_at) {
  const BeamMesh& mesh = beam.mesh();
  const double end = mesh.symmetric() ? 0.0 : length;
  const auto is_held = [&](double x) {
    const auto support = support_at(mesh, x);
    return support && *support != EndSupport::free;
  };
  held_ = {is_held(0.0), is_held(end)};
  if (!SupportReactions::is_held()) return;
  momentum_ = eliminated(mesh.momentum_functional());
  add_damping(momentum_);
  if (mesh.moment_functional().empty()) return;
  moment_ = eliminated(mesh.moment_functional());
  add_end_moment(1.0, 0.0, true, *moment_);
  add_end_moment(-1.0, end, false, *moment_);
  add_damping(*moment_);
}

SupportReactions::Eliminated SupportReactions::eliminated(
    std::span<const double> functional) const {
  const BeamMesh& mesh = beam_.mesh();
  std::vector<double> g(functional.begin(), functional.end());
  beam_.mass_solver().solve(g);
  Eliminated result;
  result.of_force = mesh.struck_point()(g);
  for (const LiftingSupport& support : beam_.supports()) {
    result.of_supports.push_back(-support.copies * support.approach(g));
  }
  if (!beam_.loads().is_empty()) result.of_loads = g;
  if (in_modes()) {
    for (std::size_t k = 0; k < g.size(); ++k) {
      result.of_unknowns.push_back(-beam_.modal_stiffness()[k] * g[k]);
    }
    return result;
  }
  if (const Tension* tension = beam_.tension()) {
    result.of_tension.resize(g.size());
    tension->form().multiply(g, result.of_tension);
  }
  result.of_moments.resize(mesh.n_sections());
  mesh.curvatures(g, result.of_moments);
  for (std::size_t j = 0; j < mesh.n_sections(); ++j) {
    result.of_moments[j] *= -mesh.section_weights()[j];
  }
  if (mesh.shears()) {
    result.of_unknowns.resize(g.size());
    mesh.add_shear_forces(g, result.of_unknowns);
  }
  return result;
}

void SupportReactions::add_end_moment(double sign, double x, bool first, Eliminated& to) const {
  const BeamMesh& mesh = beam_.mesh();
  if (mesh.n_sections() < 2 || support_at(mesh, x) != EndSupport::clamped) return;
  const auto positions = mesh.section_positions();
  const std::size_t nearest = first ? 0 : mesh.n_sections() - 1;
  const std::size_t next = first ? 1 : nearest - 1;
  const double next_share = (x - positions[nearest]) / (positions[next] - positions[nearest]);
  const auto add = [&](std::size_t section, double share) {
    if (in_modes()) {
      mesh.curvature_functional(section).add_to(to.of_unknowns,
                                                share * beam_.sections().stiffness());
    } else {
      to.of_moments[section] += share;
    }
  };
  add(nearest, sign * (1.0 - next_share));
  add(next, sign * next_share);
}

// Damping inside the beam adds to each elastic moment and shear force beta times its rate; in a
// mode c/omega^2 times, where c is its own damping, without alpha.
void SupportReactions::add_damping(Eliminated& to) const {
  const BeamMesh& mesh = beam_.mesh();
  const BeamDamping& damping = beam_.damping();
  if (in_modes()) {
    if (damping.is_none()) return;
    to.of_velocities.resize(mesh.n_unknowns(), 0.0);
    for (std::size_t k = 0; k < mesh.n_unknowns(); ++k) {
      const double squared = beam_.modal_stiffness()[k] / mesh.mass().at(k, k);
      if (squared == 0.0) continue;
      to.of_velocities[k] = (beam_.modal_damping()[k] - damping.mass) / squared * to.of_unknowns[k];
    }
    return;
  }
  if (damping.stiffness == 0.0) return;
  to.of_velocities = to.of_unknowns;
  to.of_velocities.resize(mesh.n_unknowns(), 0.0);
  for (std::size_t j = 0; j < mesh.n_sections(); ++j) {
    mesh.curvature_functional(j).add_to(to.of_velocities,
                                        beam_.sections().stiffness() * to.of_moments[j]);
  }
  for (double& coefficient : to.of_velocities) coefficient *= damping.stiffness;
}

double SupportReactions::value(const Eliminated& of, double t, const State& y,
                               std::span<const double> moments) const {
  double value = beam_.contact_force(y) * of.of_force;
  value += sum(of.of_moments, moments);
  if (!of.of_loads.empty()) value += beam_.loads().potential(of.of_loads, t);
  value += sum(of.of_unknowns, beam_.beam_positions(y));
  if (!of.of_tension.empty()) {
    const auto unknowns = beam_.beam_positions(y);
    value -= beam_.tension()->at(unknowns) * sum(of.of_tension, unknowns);
  }
  for (std::size_t j = 0; j < of.of_supports.size(); ++j) {
    value += of.of_supports[j] * beam_.support_force(j, y);
  }
  return value + sum(of.of_velocities, beam_.beam_velocities(y));
}

SupportReactions::Forces SupportReactions::on_supports(const State& y) const {
  Forces forces;
  for (std::size_t j = 0; j < beam_.supports().size(); ++j) {
    const LiftingSupport& support = beam_.supports()[j];
    for (const std::size_t end : {0, 1}) {
      if (!is_at(support, end)) continue;
      forces[end] = forces[end].value_or(0.0) - support.sense * beam_.support_force(j, y);
    }
  }
  return forces;
}

SupportReactions::Forces SupportReactions::at(double t, const State& y, Accounts& accounts) const {
  const Forces lies_on = on_supports(y);
  if (!is_held()) return lies_on;
  const double force = beam_.contact_force(y);
  // The resultant of loads, springs and bedding.
  const std::span<const double> unknowns = beam_.beam_positions(y);
  const auto [load, load_moment] = beam_.loads().resultant(t);
  double others = load - sum(beam_.mesh().ground_force(), unknowns);
  double other_moments = load_moment - sum(beam_.mesh().ground_moment(), unknowns);
  for (std::size_t j = 0; j < beam_.supports().size(); ++j) {
    const LiftingSupport& support = beam_.supports()[j];
    const double push = support.sense * support.copies * beam_.support_force(j, y);
    others -= push;
    other_moments -= push * support.position;
  }
  std::span<const double> moments;
  if (!in_modes()) moments = accounts.bending(y).moments;
  const double both = value(momentum_, t, y, moments) - force - others;
  if (beam_.mesh().symmetric()) return {0.5 * both, 0.5 * both};
  if (!held_[1]) return {both, lies_on[1]};
  if (!held_[0]) return {lies_on[0], both};
  if (!moment_) return {};
  const double moment = value(*moment_, t, y, moments) - force * struck_at_ - other_moments;
  const double last = moment / length_;
  return {both - last, last};
}

}  // namespace subimpact
