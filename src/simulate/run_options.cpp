#include "simulate/run_options.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulate/methods.h"

namespace subimpact {
namespace {

constexpr double tolerated_momentum = 1e-9;

// How far the section correction of a step may be off, as part of the striker's velocity. At rtol
// the error is a third of what the integrator may add, root mean square over the steps of the
// paper's beam. A smaller tolerance cuts steps at section events, some thousand in 8 ms, however
// small rtol is: at rtol 1e-8 those cost more than they gain, at 1e-12 a share of 1e-8 adds a tenth
// of the time and takes nine tenths (paper's beam) to 99.9 % (slender beams without rotary inertia)
// off the errors of events.
double correction_tolerance(double rtol) {
  constexpr double cheap_from = 1e-8;
  constexpr double least = 1e-20;
  const double ratio = std::min(1.0, rtol / cheap_from);
  return std::max(least, rtol * ratio * ratio);
}

// The sections nearest to the given positions; in a half model their mirror images stand for those
// of the other half.
std::vector<std::size_t> sections_at(const std::vector<double>& fractions, double length,
                                     const BeamMesh& mesh) {
  std::vector<std::size_t> sections;
  const auto& positions = mesh.section_positions();
  for (const double fraction : fractions) {
    const double x = length * (mesh.symmetric() ? std::min(fraction, 1.0 - fraction) : fraction);
    const auto nearest =
        std::min_element(positions.begin(), positions.end(),
                         [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
    sections.push_back(static_cast<std::size_t>(nearest - positions.begin()));
  }
  return sections;
}

FieldOptions field_options(const Problem& problem, const Options& options,
                           const ResolvedSettings& used) {
  FieldOptions fields;
  fields.shape_interval = used.shape_interval;
  fields.most_points = most_shape_points(options);
  fields.end_time = options.end_time;
  fields.length = problem.beam.length;
  fields.thickness = problem.beam.thickness;
  fields.struck_at = problem.striker.position * problem.beam.length;
  if (problem.beam.shears()) {
    fields.shear_flexibility = problem.beam.bending_stiffness() / problem.beam.shear_stiffness();
  }
  fields.yield_curvature = problem.beam.yield_curvature();
  fields.reactions = options.output.interval > 0.0;
  for (const double fraction : options.output.points) {
    fields.points.push_back(fraction * problem.beam.length);
  }
  return fields;
}

}  // namespace

std::size_t most_shape_points(const Options& options) {
  return static_cast<std::size_t>(options.output.shape_points);
}

RunOptions run_options(const Problem& problem, const Options& options, const ResolvedSettings& used,
                       const BeamMesh& mesh) {
  RunOptions run;
  run.loop.end_time = options.end_time;
  run.loop.first_touch = problem.striker.first_touch();
  run.loop.events = used.events;
  run.loop.double_roots = options.study.pair_detection;
  if (used.reversals == ReversalHandling::located) {
    run.loop.correction_tolerance =
        correction_tolerance(options.solver.rtol) * problem.striker.velocity;
  }
  run.loop.largest_indentation = problem.beam.thickness;
  run.loop.audit_interval = descriptor_of(options.solver.method).audit_interval;
  run.loop.shortest_contact = M_PI / used.joined_frequency;
  run.limits = {used.energy_tolerance, tolerated_momentum};
  run.history_interval = options.output.interval;
  run.sections = sections_at(options.output.sections, problem.beam.length, mesh);
  run.fields = field_options(problem, options, used);
  run.zone_gap = options.output.zone_gap * used.first_period;
  run.subzone_gap = options.output.subzone_gap * used.first_period;
  run.fixed_step = used.step;
  if (options.stop == StopRule::no_more_contact) run.stops_without_contact = problem.beam;
  return run;
}

}  // namespace subimpact
