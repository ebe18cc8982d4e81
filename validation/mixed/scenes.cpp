// Random strikes that yield, on mixed cells: how the runs end, and what their numbers conserve.

#include "scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "subimpact/case/simulate.h"
#include "subimpact/simulate/options.h"

namespace {

using namespace subimpact;

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : engine_(seed) {}

  // Three decades of velocity and of mass about the published strike.
  Case next() {
    Case input;
    Scene& scene = input.scene;
    scene.beam = {.length = between(0.4, 1.2),
                  .width = between(0.01, 0.03),
                  .thickness = between(0.004, 0.012),
                  .density = between(2500.0, 8000.0),
                  .youngs_modulus = between(7e10, 2.1e11),
                  .yield_stress = by_decades(1e8, 6e8)};
    scene.beam.ends = {any_end(), any_end()};
    scene.striker.mass = by_decades(0.002, 2.0);
    scene.striker.velocity = by_decades(0.1, 100.0);
    scene.striker.nose_radius = by_decades(0.003, 0.1);
    scene.striker.position = between(0.0, 1.0) < 0.5 ? 0.5 : between(0.15, 0.85);
    if (between(0.0, 1.0) < 0.3) scene.contact = {ContactKind::hertz, {}, {}, {}, {}};
    input.model.mesh = MeshKind::mixed;
    input.model.segments = 2 * static_cast<int>(by_decades(40.0, 400.0));
    input.model.section = SectionKind::exact;
    input.solver.method = Method::central_difference;
    input.end_time = 2e-3;
    return input;
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(engine_);
  }
  double by_decades(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  EndSupport any_end() {
    constexpr EndSupport kinds[] = {EndSupport::free, EndSupport::free, EndSupport::pinned,
                                    EndSupport::clamped};
    return kinds[std::uniform_int_distribution<>(0, 3)(engine_)];
  }
  std::mt19937_64 engine_;
};

bool is_finite(const Result& result) {
  const bool contacts = std::ranges::all_of(result.sub_impacts, [](const SubImpact& s) {
    return std::isfinite(s.start) && std::isfinite(s.end.value_or(0.0)) &&
           std::isfinite(s.impulse) && std::isfinite(s.peak_force);
  });
  const bool rows = std::ranges::all_of(result.history, [](const HistoryRow& row) {
    return std::isfinite(row.force) && std::isfinite(row.energy_error);
  });
  return contacts && rows && std::isfinite(result.striker_velocity);
}

}  // namespace

int study_random_scenes(int n, unsigned seed) {
  RandomScenes scenes(seed);
  std::map<std::string, int> ends, ends_of_fine;
  int n_fine = 0, n_refused = 0, n_not_finite = 0;
  double momentum = 0.0, energy = 0.0;
  for (int yielding = 0, number = 0; yielding < n; ++number) {
    const Case input = scenes.next();
    Result result;
    try {
      result = simulate(input);
    } catch (const InvalidCase& refusal) {
      ++n_refused;
      continue;
    }
    if (result.n_yielded_sections == 0) continue;
    ++yielding;
    const std::string end(to_string(result.outcome.kind));
    ++ends[end];
    if (input.model.segments >= 200) ++n_fine, ++ends_of_fine[end];
    if (!is_finite(result)) ++n_not_finite;
    if (!result.outcome.completed()) {
      fmt::print("scene {} of seed {}, {} cells: {}\n", number, seed, input.model.segments,
                 result.outcome.message);
      continue;
    }
    momentum = std::max(momentum, result.max_momentum_error.value_or(0.0));
    energy = std::max(energy, result.max_energy_error);
  }
  fmt::print("\n| end | {} strikes that yield | {} of them on 200 cells or more |\n|---|---|---|\n",
             n, n_fine);
  for (const auto& [end, count] : ends) {
    fmt::print("| {} | {} ({:.2f} %) | {} ({:.2f} %) |\n", end, count, 100.0 * count / n,
               ends_of_fine[end], 100.0 * ends_of_fine[end] / std::max(n_fine, 1));
  }
  fmt::print(
      "\nnot finite: {}; largest error in completed runs: momentum without supports {:.1e}, "
      "energy {:.1e}; refused before they began: {}\n",
      n_not_finite, momentum, energy, n_refused);
  return n_not_finite == 0 && ends["completed"] > 0 ? 0 : 1;
}
