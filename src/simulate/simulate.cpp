#include "subimpact/simulate/simulate.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "simulate/event_loop.h"
#include "simulate/model_factory.h"
#include "simulate/recorder.h"
#include "subimpact/simulate/case_keys.h"
#include "subimpact/simulate/doubtful_units.h"
#include "system/no_more_contact.h"

namespace subimpact {
namespace {

constexpr long progress_interval = 512;  // steps
constexpr long proof_interval = 32;

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

}  // namespace

Used explain(const Case& input) {
  check(input);
  return describe(input, make_struck_beam(input));
}

Result simulate(const Case& input, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  check(input);
  StruckBeam beam = make_struck_beam(input);
  Result result;
  result.warnings = doubtful_units(input);
  result.used = describe(input, beam);
  beam.set_pair_detection(input.solver.pair_detection);
  const auto integrator = make_integrator(input, result.used, beam);
  Recorder recorder(beam, beam.initial_state(), input.output.interval, result.used.events, result);
  recorder.keep_sections(sections_at(input, beam.mesh()));
  EventLoop loop(beam, *integrator, recorder, loop_options(input, result.used));
  std::optional<NoMoreContact> no_more_contact;
  if (input.stop == StopRule::no_more_contact) no_more_contact.emplace(beam, input.scene.beam);
  result.work.setup_seconds = seconds_since(start);

  try {
    result.outcome.message = "completed";
    loop.start();
    for (long n = 1; !loop.finished(); ++n) {
      loop.advance();
      if (no_more_contact && n % proof_interval == 0 &&
          no_more_contact->is_proven(beam, loop.state())) {
        result.no_more_contact = loop.time();
        result.outcome.message = "no further contact is possible";
        break;
      }
      if (n % progress_interval == 0 && progress && !progress(loop.time())) {
        result.outcome = {OutcomeKind::stopped, loop.time(), "stopped on request"};
        break;
      }
    }
  } catch (const RunStopped& stop) {
    result.outcome.kind = stop.reason == RunStopped::Reason::unstable ? OutcomeKind::unstable
                                                                      : OutcomeKind::left_validity;
    result.outcome.message = stop.what();
  } catch (const IntegrationFailure& failure) {
    result.outcome.kind = OutcomeKind::solver_failed;
    result.outcome.message = failure.what() + ("; " + remedy(input));
  }
  result.outcome.time = loop.time();
  recorder.finish(loop.time(), loop.state(), beam);
  assign_zones(result.sub_impacts, input.output.zone_gap * result.used.first_period,
               input.output.subzone_gap * result.used.first_period);

  const WorkCounts counts = integrator->work();
  result.work.steps = counts.steps;
  result.work.rejected_steps = counts.rejected_steps;
  result.work.partial_steps = counts.partial_steps;
  result.work.right_hand_sides = beam.n_accelerations() + beam.n_forces();
  const bool in_modes = !beam.mesh().modal_stiffness().empty();  // where mass is diagonal
  result.work.mass_solves =
      in_modes ? 0 : beam.n_accelerations() + beam.n_further_solves() + counts.mass_solves;
  result.work.jacobians = counts.jacobians;
  result.work.factorisations = (in_modes ? 0 : 1) + counts.factorisations;
  result.work.nonlinear_iterations = counts.nonlinear_iterations;
  result.work.nonlinear_failures = counts.nonlinear_failures;
  result.work.roots = loop.n_events();
  result.work.wall_seconds = seconds_since(start);
  return result;
}

}  // namespace subimpact
