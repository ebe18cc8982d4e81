// A ball on a beam so long that nothing comes back from its ends.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "model/mesh/cell_mesh.h"
#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {

namespace {

// Displacement under a unit impulse, by the mesh's modes.
double impulse_response(const CellMesh& mesh, const NaturalModes& modes, double time) {
  double sum = 0.0;
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const double at = mesh.struck_point()(modes.shape(k));
    const double omega = modes.frequencies[k];
    sum += at * at * (omega > 0.0 ? std::sin(omega * time) / omega : time);
  }
  return sum;
}

void add_impulse_response(Outcome& outcome) {
  Beam beam = case_of("long_beam").scene.beam;
  const double a = std::sqrt(beam.bending_stiffness() / beam.mass_per_length());
  const double time = 1e-4;
  beam.length = 160.0 * std::sqrt(a * time);
  const CellMesh mesh(beam, 0.5, 4001, CellMesh::Extent::half);
  const NaturalModes modes = mesh.natural_modes(beam.bending_stiffness());
  for (const double t : {0.25 * time, time}) {
    outcome.rows.push_back(
        {fmt::format("w(0, t) under a unit impulse, m/(N s), t = {:.3g} us", 1e6 * t),
         std::sqrt(t / (2.0 * std::numbers::pi * a)) / beam.mass_per_length(),
         impulse_response(mesh, modes, t), Bound::relative, 0.005});
  }
}

}  // namespace

Outcome check_long_beam() {
  Outcome outcome{"infinite beam, by an integral equation", {}, {}};
  add_impulse_response(outcome);
  const double table[][3] = {{0.1, 0.833988, 3.17827},
                             {0.2, 0.691619, 3.14231},
                             {0.5, 0.365645, 3.05351},
                             {1.0, 0.023346, 2.95472},
                             {1.5, -0.188204, 2.90546}};
  for (const auto& [mu, restitution, duration] : table) {
    Case input = case_of("long_beam");
    const Beam& beam = input.scene.beam;
    const double a = std::sqrt(beam.bending_stiffness() / beam.mass_per_length());
    const double k = *input.scene.contact.stiffness;
    const double v = input.scene.striker.velocity;
    // mu = m/(rho A sqrt(2 pi a T)), T = (m^2/(K^2 v))^(1/5): m^(4/5) = mu rho A sqrt(2 pi a) ...
    const double mass =
        std::pow(mu * beam.mass_per_length() * std::sqrt(2.0 * std::numbers::pi * a) *
                     std::pow(k * k * v, -0.1),
                 1.25);
    const double time = std::pow(mass * mass / (k * k * v), 0.2);
    input.scene.striker.mass = mass;
    input.end_time = 4.0 * time;
    // In units of the length over which bending spreads in T.
    input.scene.beam.length = 80.0 * std::sqrt(a * time);
    const Result result = simulate(input);
    const SubImpact& hit = result.sub_impacts.at(0);
    // Of the first touch's end: the ball may be caught up afterwards.
    outcome.rows.push_back({fmt::format("restitution, μ = {}", mu), restitution,
                            -hit.striker_velocity / v, Bound::absolute, 0.005});
    outcome.rows.push_back({fmt::format("contact time/T, μ = {}", mu), duration,
                            hit.end.value() / time, Bound::relative, 0.005});
  }
  return outcome;
}

}  // namespace subimpact::validation
