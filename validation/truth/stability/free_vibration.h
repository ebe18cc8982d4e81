#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "integrate/sundials.h"
#include "simulate/run_parts.h"
#include "subimpact/case/simulate.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// The elastic beam of a case in free vibration, contact open, under one of the one-step methods
/// with a fixed step. Nothing is located and nothing yields: what is left is the method itself.
class FreeVibration {
 public:
  /// Method and table are those of the case. Throws InvalidCase.
  explicit FreeVibration(const Case& input)
      : run_(resolve(elastic(input))),
        beam_(run_.parts().beam),
        modes_(beam_.mesh().natural_modes(beam_.sections().stiffness())) {
    beam_.contact().set(ContactBranch::separated, {});
  }

  std::size_t n_modes() const { return modes_.size(); }
  double frequency(std::size_t mode) const { return modes_.frequencies[mode]; }  ///< rad/s
  /// The mesh's bound of the highest frequency, from which limits are predicted, rad/s.
  double highest_frequency() const {
    return beam_.mesh().highest_frequency(beam_.sections().stiffness());
  }

  /// By how much `n_steps` steps multiply the amplitude of a natural mode, per step: the largest
  /// eigenvalue of what they do to (omega times the mode's displacement, its velocity), found from
  /// two runs. Infinite where the numbers overflow.
  double growth(std::size_t mode, double step, int n_steps) {
    const Amplitudes first = run(mode, step, n_steps, {1.0, 0.0});
    const Amplitudes second = run(mode, step, n_steps, {0.0, 1.0});
    const double radius = spectral_radius(
        {{{first.displacement, second.displacement}, {first.velocity, second.velocity}}});
    if (!std::isfinite(radius)) return std::numeric_limits<double>::infinity();
    return std::pow(radius, 1.0 / n_steps);
  }

 private:
  // The mode's displacement times omega, and its velocity, after the steps.
  struct Amplitudes {
    double displacement, velocity;
  };

  static Case elastic(Case input) {
    input.model.section = SectionKind::elastic;
    input.study.beyond_critical = true;
    return input;
  }

  Amplitudes run(std::size_t mode, double step, int n_steps, const Amplitudes& start) {
    const std::size_t n = beam_.mesh().n_unknowns();
    const std::span<const double> shape = modes_.shape(mode);
    State y(2 * beam_.n_positions(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = start.displacement / frequency(mode) * shape[i];
      y[n + 1 + i] = start.velocity * shape[i];
    }
    run_.parts().given.solver.step = step;
    run_.parts().settings.step = step;
    const auto integrator = run_.parts().make_integrator();
    integrator->restart(0.0, y);
    for (int i = 0; i < n_steps; ++i) integrator->step();

    std::vector<double> weighted(n);
    beam_.mesh().mass().multiply(shape, weighted);
    const State& end = integrator->state();
    Amplitudes result{0.0, 0.0};
    for (std::size_t i = 0; i < n; ++i) {
      result.displacement += frequency(mode) * weighted[i] * end[i];
      result.velocity += weighted[i] * end[n + 1 + i];
    }
    return result;
  }

  ResolvedRun run_;
  StruckBeam& beam_;
  NaturalModes modes_;
};

}  // namespace subimpact
