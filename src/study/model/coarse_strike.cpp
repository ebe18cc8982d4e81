#include "study/model/coarse_strike.h"

#include <algorithm>

#include "case/meshes.h"
#include "case/problem.h"
#include "study/judgement/totals.h"
#include "study/method_choice.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {

constexpr int fewest_cells = 60;
constexpr double evaluations_per_step = 8.0;  // of an explicit method that adapts its steps
constexpr double most_excess = 20.0;          // of their work over the one wanted

Case coarse_case(const Case& input, int cells, double end) {
  Case coarse = input;
  coarse.title.clear();
  coarse.scatter.clear();
  coarse.strikes = 1;
  static_cast<Options&>(coarse) = {};
  coarse.end_time = end;
  coarse.stop = StopRule::no_more_contact;
  coarse.accuracy.energy = 1.0;  // seen in the difference of two such runs, if it is large
  coarse.output.interval = coarse.output.shapes = end;
  const bool bends = descriptor_of(input.model.mesh).bends;
  coarse.solver.method = Method::nystrom;
  if (bends) {
    coarse.model = {};
    coarse.model.section = input.model.section;
    coarse.model.layers = input.model.layers;
    coarse.model.mesh = default_mesh(coarse);
    coarse.model.segments = 2 * (cells / 2) + 1;  // an odd number has a centre at mid-span
    coarse.model.elements = std::max(cells / 4, 4);
    if (coarse.model.mesh == MeshKind::cells) coarse.solver.method = Method::central_difference;
  }
  // Damped by modes where it can be: other methods do not take every kind.
  const bool is_damped = bends && !input.scene.beam.damping.is_none();
  coarse.solver.method =
      possible_method(coarse, is_damped ? Method::exponential : coarse.solver.method);
  return coarse;
}

int affordable_cells(const Case& input, double end, int most, double work) {
  double needed = 0.0;
  for (int cells = most;; cells = 7 * cells / 10) {
    try {
      const Case coarse = coarse_case(input, cells, end);
      const ResolvedSettings used = resolve(coarse).settings();
      const double evaluations =
          used.step ? end / *used.step : evaluations_per_step * end / used.critical_step;
      needed = evaluation_cost(coarse) * evaluations * static_cast<double>(used.n_unknowns);
      if (needed <= work) return cells;
    } catch (const InvalidCase&) {  // the run says so
    }
    if (cells <= fewest_cells) return needed <= most_excess * work ? cells : 0;
  }
}

std::optional<Result> coarse_run(Case input, const Progress& progress) {
  try {
    if (input.solver.step) {
      input.solver.step = std::min(*input.solver.step, largest_stable_step(input));
    }
    return simulate(input, progress);
  } catch (const InvalidCase&) {  // of numbers that only such a mesh cannot hold
    return std::nullopt;
  }
}

StrikeFigures figures_of(const Result& result, double until) {
  StrikeFigures figures;
  for (const SubImpact& s : result.sub_impacts) {
    if (s.start > until) break;
    figures.peak_force = std::max(figures.peak_force.value_or(0.0), s.peak_force);
    figures.max_indentation = std::max(figures.max_indentation.value_or(0.0), s.max_indentation);
    if (figures.parting || result.end_of(s) > until || !s.end) continue;
    if (s.opening.value_or(0.0) > hair_opening) figures.parting = s.end;
  }
  figures.striker_velocity = result.striker_velocity;
  if (!result.envelope.empty()) {
    figures.permanent_set = largest_magnitude(result.envelope, &EnvelopeRow::set_from_supports);
  }
  figures.restitution = result.restitution;
  figures.rests_since = result.rests_since;
  if (result.sub_impacts.empty()) return figures;
  figures.impulse = result.impulse();
  figures.dent = result.sub_impacts.back().residual_indentation;
  if (result.contact_over) figures.contact_end = result.sub_impacts.back().end;
  for (const ZoneSummary& zone : summarise_zones(result.sub_impacts)) {
    figures.zones.push_back({zone.start, zone.end, zone.impulse});
  }
  return figures;
}

}  // namespace subimpact
