#include "system/support_reactions.h"

#include "system/beam_field.h"

namespace subimpact {

SupportReactions::SupportReactions(const StruckBeam& beam, double length, double struck_at)
    : beam_(beam), length_(length), struck_at_(struck_at) {
  const BeamMesh& mesh = beam.mesh();
  const double end = mesh.symmetric() ? 0.0 : length;
  const auto is_held = [&](double x) {
    const auto support = support_at(mesh, x);
    return support && *support != EndSupport::free;
  };
  held_ = {is_held(0.0), is_held(end)};
  if (!exist()) return;
  momentum_ = eliminated(mesh.momentum_functional());
  if (mesh.moment_functional().empty()) return;
  moment_ = eliminated(mesh.moment_functional());
  add_end_moment(1.0, 0.0, true, *moment_);
  add_end_moment(-1.0, end, false, *moment_);
}

SupportReactions::Eliminated SupportReactions::eliminated(
    std::span<const double> functional) const {
  const BeamMesh& mesh = beam_.mesh();
  std::vector<double> g(functional.begin(), functional.end());
  beam_.mass_solver().solve(g);
  Eliminated result;
  result.of_force = mesh.struck_point()(g);
  const auto modal = beam_.modal_stiffness();
  if (!modal.empty()) {
    for (std::size_t k = 0; k < g.size(); ++k) result.of_moments.push_back(-modal[k] * g[k]);
    return result;
  }
  result.of_moments.resize(mesh.n_sections());
  mesh.curvatures(g, result.of_moments);
  const auto weights = mesh.section_weights();
  for (std::size_t j = 0; j < weights.size(); ++j) result.of_moments[j] *= -weights[j];
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
    if (beam_.modal_stiffness().empty()) {
      to.of_moments[section] += share;
    } else {
      mesh.curvature_functional(section).add_to(to.of_moments,
                                                share * beam_.sections().stiffness());
    }
  };
  add(nearest, sign * (1.0 - next_share));
  add(next, sign * next_share);
}

double SupportReactions::value(const Eliminated& of, std::span<const double> moments,
                               double force) {
  double sum = force * of.of_force;
  for (std::size_t j = 0; j < of.of_moments.size(); ++j) sum += of.of_moments[j] * moments[j];
  return sum;
}

SupportReactions::Forces SupportReactions::at(const State& y, Accounts& accounts) const {
  const double force = beam_.contact_force(y);
  const bool in_modes = !beam_.modal_stiffness().empty();
  const std::span<const double> moments =
      in_modes ? beam_.beam_positions(y) : accounts.bending(y).moments;
  const double sum = value(momentum_, moments, force) - force;
  if (beam_.mesh().symmetric()) return {0.5 * sum, 0.5 * sum};
  if (!held_[1]) return {sum, std::nullopt};
  if (!held_[0]) return {std::nullopt, sum};
  if (!moment_) return {};
  const double last = (value(*moment_, moments, force) - force * struck_at_) / length_;
  return {sum - last, last};
}

}  // namespace subimpact
