#include "system/contact/contact_resonance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/dense.h"

namespace subimpact {
namespace {

constexpr std::size_t lanczos_steps = 24;

// Mass and stiffness of beam and striker joined by a spring.
class JoinedBodies {
 public:
  JoinedBodies(const StruckBeam& beam, double slope)
      : beam_(beam),
        mesh_(beam.mesh()),
        n_(mesh_.n_unknowns()),
        slope_(slope),
        moments_(mesh_.n_sections()) {}

  // d = (-S, 1).
  std::vector<double> difference() const {
    std::vector<double> d(n_ + 1, 0.0);
    mesh_.struck_point().add_to({d.data(), n_}, -1.0);
    d[n_] = 1.0;
    return d;
  }
  void solve_mass(std::vector<double>& x) const {
    beam_.mass_solver().solve({x.data(), n_});
    x[n_] /= beam_.striker_mass();
  }
  std::vector<double> stiffness_times(const std::vector<double>& x) {
    std::vector<double> result(n_ + 1, 0.0);
    const std::span<const double> unknowns(x.data(), n_);
    const std::span<double> forces(result.data(), n_);
    const auto modal = mesh_.modal_stiffness();
    if (!modal.empty()) {
      for (std::size_t i = 0; i < n_; ++i) forces[i] = modal[i] * x[i];
    } else {
      mesh_.curvatures(unknowns, moments_);
      for (double& moment : moments_) moment *= beam_.sections().stiffness();
      mesh_.internal_forces(unknowns, moments_, forces);
      for (double& force : forces) force = -force;
    }
    const double force = slope_ * (x[n_] - mesh_.struck_point()(unknowns));
    mesh_.struck_point().add_to(forces, -force);
    result[n_] = force;
    return result;
  }

 private:
  const StruckBeam& beam_;
  const BeamMesh& mesh_;
  std::size_t n_;
  double slope_;
  std::vector<double> moments_;
};

// The largest eigenvalue that Lanczos' method finds for Mass^-1 K, started from Mass^-1 d. Vectors
// are kept with their products by Mass, so that the inner product needs no mass matrix. Without
// orthogonalisation against all earlier vectors eigenvalues may come up twice, but none is wrong.
double largest_eigenvalue(JoinedBodies& bodies) {
  std::vector<double> times_mass = bodies.difference();
  const std::size_t n = times_mass.size();
  std::vector<double> x = times_mass;
  bodies.solve_mass(x);
  std::vector<double> previous(n, 0.0), previous_times_mass(n, 0.0);
  std::vector<double> diagonal, beside;
  const auto steps = std::min<std::size_t>(lanczos_steps, n);
  for (std::size_t k = 0; k < steps; ++k) {
    const double length = std::sqrt(std::max(dot(x.data(), times_mass.data(), n), 0.0));
    const bool exhausted = k > 0 && !(length > 1e-10 * std::abs(diagonal.front()));
    if (exhausted || !(length > 0.0)) break;
    if (k > 0) beside.push_back(length);
    for (std::size_t i = 0; i < n; ++i) {
      x[i] /= length;
      times_mass[i] /= length;
    }
    std::vector<double> next_times_mass = bodies.stiffness_times(x);
    diagonal.push_back(dot(x.data(), next_times_mass.data(), n));
    std::vector<double> next = next_times_mass;
    bodies.solve_mass(next);
    const double before = k > 0 ? length : 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      next[i] -= diagonal[k] * x[i] + before * previous[i];
      next_times_mass[i] -= diagonal[k] * times_mass[i] + before * previous_times_mass[i];
    }
    previous = std::exchange(x, std::move(next));
    previous_times_mass = std::exchange(times_mass, std::move(next_times_mass));
  }
  if (diagonal.empty()) return 0.0;
  return subimpact::largest_eigenvalue(diagonal, beside);
}

}  // namespace

ContactResonance contact_resonance(const StruckBeam& beam, double largest_indentation) {
  const ContactLaw& law = beam.contact().law();
  const auto [stiffness, exponent] = law.scales();
  const double mass = beam.has_stop() ? beam.mesh().beam_mass() : beam.striker_mass();
  const double velocity = beam.scales().velocity;
  ContactResonance result;
  result.largest_slope = law.largest_slope(
      std::min(law.indentation_at(0.5 * mass * velocity * velocity), largest_indentation));
  JoinedBodies bodies(beam, result.largest_slope);
  std::vector<double> answer = bodies.difference();
  const std::vector<double> difference = answer;
  bodies.solve_mass(answer);
  result.effective_mass = 1.0 / dot(difference.data(), answer.data(), answer.size());
  // Supports that lift are no part of `bodies`; their stiffness adds at most the squares of theirs.
  const double of_beam = beam.mesh().highest_frequency(beam.sections().stiffness());
  const double with_supports = beam.highest_frequency();
  const double of_supports = with_supports * with_supports - of_beam * of_beam;
  result.highest_frequency =
      std::max(with_supports, std::sqrt(largest_eigenvalue(bodies) + std::max(of_supports, 0.0)));
  result.contact_time =
      std::pow(result.effective_mass / (stiffness * std::pow(velocity, exponent - 1.0)),
               1.0 / (exponent + 1.0));
  return result;
}

}  // namespace subimpact
