#include "subimpact/case/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "case/model_factory.h"
#include "simulate/run.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/model/contact_law_check.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

// The sections nearest to the positions asked for; in a half model their mirror images stand for
// those of the other half.
std::vector<std::size_t> sections_at(const Case& input, const BeamMesh& mesh) {
  std::vector<std::size_t> sections;
  const auto& positions = mesh.section_positions();
  for (const double fraction : input.output.sections) {
    const double modelled = mesh.symmetric() ? std::min(fraction, 1.0 - fraction) : fraction;
    const double x = modelled * input.scene.beam.length;
    const auto nearest =
        std::min_element(positions.begin(), positions.end(),
                         [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
    sections.push_back(static_cast<std::size_t>(nearest - positions.begin()));
  }
  return sections;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// What helps when the integrator could not go on.
std::string remedy(const Case& input) {
  return input.solver.step ? "use a smaller solver.step or another solver.method"
                           : "use a larger solver.rtol or another solver.method";
}

// What helps when a check failed.
std::string remedy_of_error(const Case& input, const Used& used) {
  return used.step ? fmt::format("use a solver.step below {:.3g} us, or another solver.method",
                                 us * *used.step)
                   : fmt::format("use a solver.rtol below {:.0e}, or another solver.method",
                                 input.solver.rtol);
}

void add_remedy(Outcome& outcome, const Case& input, const Used& used) {
  if (outcome.kind == OutcomeKind::solver_failed) {
    outcome.message += "; " + remedy(input);
  } else if (outcome.first_failure) {
    outcome.message += "; " + remedy_of_error(input, used);
  }
}

// The largest indentation of the run bounds what is looked at.
std::optional<std::string> rule_broken_by_own_law(const Case& input, const StruckBeam& beam) {
  if (!input.parts.contact_law) return std::nullopt;
  const ContactLaw& law = *input.parts.contact_law;
  const double velocity = input.scene.striker.velocity;
  const double deepest = law.indentation_at(0.5 * beam.striker_mass() * velocity * velocity);
  return broken_rule(law, std::min(deepest, input.scene.beam.thickness));
}

// A law that is wrong from the start makes a result that is wrong from the start.
Result not_run(const std::string& why, Used used) {
  Result result;
  result.outcome = {OutcomeKind::inaccurate, 0.0, why, Interval{0.0, 0.0}};
  result.used = std::move(used);
  return result;
}

RunOptions run_options(const Case& input, const Used& used, const BeamMesh& mesh) {
  RunOptions options;
  options.loop = loop_options(input, used);
  options.limits = audit_limits(used);
  options.history_interval = input.output.interval;
  options.sections = sections_at(input, mesh);
  options.zone_gap = input.output.zone_gap * used.first_period;
  options.subzone_gap = input.output.subzone_gap * used.first_period;
  options.fixed_step = used.step;
  if (input.stop == StopRule::no_more_contact) options.stops_without_contact = input.scene.beam;
  return options;
}

}  // namespace

Used explain(const Case& input) {
  check(input);
  return describe(input, make_struck_beam(input));
}

Result simulate(const Case& input, const Progress& progress, Observer* observer) {
  const auto start = std::chrono::steady_clock::now();
  check(input);
  StruckBeam beam = make_struck_beam(input);
  Used used = describe(input, beam);
  const auto integrator = make_integrator(input, used, beam);
  if (const auto broken = rule_broken_by_own_law(input, beam)) {
    return not_run(*broken, std::move(used));
  }
  const RunOptions options = run_options(input, used, beam.mesh());
  const double setup_seconds = seconds_since(start);

  Result result = simulate(beam, *integrator, options, progress, observer);
  add_remedy(result.outcome, input, used);
  result.used = std::move(used);
  const std::vector<std::string> doubts = doubtful_units(input);
  result.warnings.insert(result.warnings.begin(), doubts.begin(), doubts.end());
  result.work.setup_seconds += setup_seconds;
  result.work.wall_seconds = seconds_since(start);
  return result;
}

}  // namespace subimpact
