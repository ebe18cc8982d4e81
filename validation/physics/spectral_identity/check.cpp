// Energy that the contact force gives to the beam's modes against energy that the striker loses.

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "outcome.h"
#include "simulate/run_parts.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

// Integral of F exp(-i omega t) over the history, F linear between rows.
std::complex<double> transform(const std::vector<HistoryRow>& rows, double omega) {
  using namespace std::complex_literals;
  std::complex<double> sum = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double h = rows[i].time - rows[i - 1].time;
    const double f0 = rows[i - 1].force, f1 = rows[i].force;
    if (h <= 0.0 || (f0 == 0.0 && f1 == 0.0)) continue;
    // Of a linear force, about the middle: its mean times sin(x)/x, and its slope.
    const double x = 0.5 * omega * h;
    const double even = std::abs(x) < 1e-3 ? 1.0 - x * x / 6.0 : std::sin(x) / x;
    const double odd = std::abs(x) < 1e-3 ? x / 3.0 : (std::sin(x) / x - std::cos(x)) / x;
    const std::complex<double> phase =
        std::exp(-1i * omega * 0.5 * (rows[i].time + rows[i - 1].time));
    sum += h * phase * (0.5 * (f0 + f1) * even - 1i * 0.5 * (f1 - f0) * odd);
  }
  return sum;
}

}  // namespace

Outcome check_spectral_identity() {
  Outcome outcome{"energy balance of the modes", {}, {}};
  for (const char* velocity : {"15.9", "3.0"}) {
    const Case input = case_of("spectral_identity", {std::string("striker.velocity=") + velocity});
    const Result result = simulate(input);
    Case physical = input;  // the mesh itself, not its modes, for the modes' shapes
    physical.solver.method = Method::erk;
    ResolvedRun run = resolve(physical);
    const StruckBeam& beam = run.parts().beam;
    const NaturalModes modes = beam.mesh().natural_modes(input.scene.beam.bending_stiffness());
    double impulse = 0.0;
    for (const SubImpact& s : result.sub_impacts) impulse += s.impulse;
    double sum = 0.0;
    for (std::size_t k = 0; k < modes.size(); ++k) {
      const double at = beam.mesh().struck_point()(modes.shape(k));  // 1/M_k = at^2
      sum += std::norm(transform(result.history, modes.frequencies[k]) / impulse) * at * at;
    }
    const double v1 = input.scene.striker.velocity;
    const double v2 = -result.striker_velocity;  // rebound speed
    const double m = input.scene.striker.mass;
    outcome.rows.push_back({fmt::format("sum over modes, 1/kg, {} sub-impacts at {} m/s",
                                        result.sub_impacts.size(), velocity),
                            (v1 - v2) / (v1 + v2) / m, sum, Bound::relative, 1e-4});
  }
  return outcome;
}

}  // namespace subimpact::validation
