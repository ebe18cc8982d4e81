#include "study/model/body_runs.h"

#include <algorithm>

#include "case/meshes.h"
#include "case/problem.h"
#include "study/model/coarse_strike.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

constexpr double share_of_work = 0.08;    // of each horizon
constexpr double least_work = 2e6;        // some 10 ms
constexpr double dearer = 1.5;            // an evaluation on a coarse mesh that yields
constexpr double coarsest = 0.02;         // of the mesh of the run
constexpr double near_ratio = 1.5;        // of two meshes, of which one does for both horizons
constexpr double n_rows = 50.0;           // of which largest displacements are taken
constexpr int most_cells = 241;           // where the mesh of the run does not do
constexpr double most_of_modes = 2e7;     // of unlike ends with shear, which are decomposed: 0.1 s
constexpr double fewest_elements = 0.25;  // of those wanted
constexpr double times_parting = 2.0;     // horizon of what is decided early
constexpr double most_energy_lost = 0.05;

}  // namespace

BodyRuns::BodyRuns(const Case& input, const Result& result, const std::optional<double>& parting,
                   double n_runs, const Progress& progress)
    : input_(input), result_(result), progress_(progress) {
  try {
    if (mesh_order(input_)) refinement_.emplace(input_, OpenChoices());
    Case usual = input_;  // whose first mesh does not follow from that of the run
    usual.model.segments = ModelOptions().segments;
    usual.model.elements = ModelOptions().elements;
    if (refinement_) first_ = mesh_count(Refinement(usual, OpenChoices()).first());
  } catch (const InvalidCase&) {  // its mesh cannot be resized
  }
  choose_horizons(parting, n_runs);
}

std::optional<Result> BodyRuns::on_mesh(const Case& input, const Horizon& horizon) {
  return run_of(case_on_mesh(input, horizon));
}

std::optional<Result> BodyRuns::on_cells(const Case& input, const Horizon& horizon) {
  return run_of(case_on_cells(input, horizon));
}

// Meshes by counted work, that to the parting not by the end of the run: what is decided by twice
// that time may take least_work or, if more, a run on the coarsest mesh worth one.
void BodyRuns::choose_horizons(const std::optional<double>& parting, double n_runs) {
  const double end = result_.outcome.time, work = counted_work(input_, result_);
  const double of_modes = result_.used.decomposition;  // whatever the end
  const double touch = result_.sub_impacts.front().start;
  n_runs *= input_.strikes;
  const auto ratio_for = [&](double part, double most) {
    const double of_run = of_modes + part * (work - of_modes);
    const double share = most / (n_runs * of_run);  // that each run may take
    return share >= 1.0 || !mesh_order(input_) ? 1.0 : std::pow(share / dearer, 1.0 / usual_growth);
  };
  const double most = share_of_work * work_with_others * input_.strikes * work;
  const double of_all = std::max(most, least_work);
  Horizon whole{end, ratio_for(1.0, of_all), of_all / n_runs};
  if (parting && input_.strikes == 1) {
    until_ = touch + times_parting * (*parting - touch);
    const double part = (until_ - touch) / (end - touch);
    Horizon early{std::min(until_, end), ratio_for(part, least_work), least_work / n_runs};
    if (refinement_) {
      const double first = first_ / mesh_count(input_);
      early.ratio = std::max(early.ratio, std::min({first, ratio_for(part, most), 1.0}));
    }
    if (early.end == end) {
      whole.ratio = std::max(whole.ratio, early.ratio);
    } else if (std::abs(std::log(whole.ratio / early.ratio)) < std::log(near_ratio)) {
      whole.ratio = early.ratio;  // the same runs until then
    } else {
      horizons_.push_back(early);
    }
  }
  horizons_.push_back(whole);
  for (Horizon& horizon : horizons_) {
    const bool is_run = horizon.ratio == 1.0 && horizon.end == end && input_.strikes == 1;
    horizon.base = is_run ? std::optional(result_) : on_mesh(input_, horizon);
  }
}

std::optional<Case> BodyRuns::case_on_cells(const Case& of, const Horizon& horizon) const {
  const int cells = affordable_cells(of, horizon.end, most_cells, horizon.work);
  if (cells == 0) return std::nullopt;
  Case other = coarse_case(of, cells, horizon.end);
  other.output.opening = input_.output.opening;
  other.output.zone_gap = input_.output.zone_gap;
  return other;
}

std::optional<Case> BodyRuns::case_on_mesh(const Case& of, const Horizon& horizon) const {
  const bool was_rigid = !descriptor_of(input_.model.mesh).bends;
  const bool bends = descriptor_of(of.model.mesh).bends && !of.scene.beam.fixed;
  if (was_rigid && bends) return case_on_cells(of, horizon);
  Case other = of;
  if (horizon.ratio < 1.0) {
    if (horizon.ratio < coarsest || !refinement_) return std::nullopt;
    const std::optional<Case> resized = refinement_->resized(of, horizon.ratio);
    if (!resized) return std::nullopt;
    other = *resized;
  }
  const auto& suits = descriptor_of(other.model.mesh).suits;
  if (!suits(other.scene.beam)) {
    const int quarter = other.model.elements / 4 + 1;
    other.model.elements = 2 * quarter;
    other.model.mesh = MeshKind::spectral;
    const double modes = resolve(other).settings().decomposition;
    const double affordable = std::cbrt(std::max(horizon.work, most_of_modes) / modes);
    if (affordable < fewest_elements) return std::nullopt;
    if (affordable < 1.0) other.model.elements = 2 * static_cast<int>(affordable * quarter);
  }
  other.scatter.clear();
  other.strikes = 1;
  other.accuracy = {};
  other.accuracy.energy = 1.0;  // what is lost is judged here
  other.output.keep_no_rows();
  other.output.interval = horizon.end / n_rows;
  other.output.shapes = other.end_time = horizon.end;
  // Without gravity nothing changes after the last contact.
  const bool weighs = of.scene.gravity != 0.0 || of.scene.beam.has_loads();
  other.stop = weighs ? StopRule::end_time : StopRule::no_more_contact;
  return other;
}

std::optional<Result> BodyRuns::run_of(std::optional<Case> next) {
  std::optional<Result> run;
  for (int strike = 1; next && strike <= input_.strikes && !is_stopped_; ++strike) {
    run = coarse_run(*next, progress_);
    is_stopped_ = run && run->outcome.kind == OutcomeKind::stopped;
    const bool is_sound =
        run && run->outcome.completed() && run->max_energy_error < most_energy_lost;
    if (!is_sound) return std::nullopt;
    next->parts.start = run->end_state;
  }
  return is_stopped_ ? std::nullopt : std::move(run);
}

}  // namespace subimpact
