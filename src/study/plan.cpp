#include "subimpact/study/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/methods.h"
#include "study/method_choice.h"
#include "study/refinement.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

// Tolerance of the reference over the wanted one.
constexpr double reference_share = 0.2;
// Runs within the wanted error that admit a mesh; the reference itself is one more of its sequence.
constexpr int enough_in_a_row = 3;
constexpr int enough_beside_reference = 2;
constexpr int bisections = 2;
constexpr int fewest_parts = 16;
// Share of a duration or separation up to which an error does not change it beyond recognition.
constexpr double recognisable = 0.5;
constexpr double grading = 4.0;  // length of far elements over that of those at the strike

struct Family {
  MeshKind mesh;
  double refinement;  // at the strike
  Method method;

  bool operator==(const Family&) const = default;
};

std::vector<Family> families_of(const Case& input) {
  std::vector<Family> families = {{MeshKind::spectral, 1.0, Method::exponential},
                                  {MeshKind::hermite, 1.0, Method::exponential},
                                  {MeshKind::hermite, grading, Method::exponential},
                                  {MeshKind::cells, 1.0, Method::exponential},
                                  {MeshKind::cells, 1.0, Method::central_difference}};
  if (may_yield(input)) {
    families = {{MeshKind::cells, 1.0, Method::central_difference},
                {MeshKind::hermite, 1.0, Method::nystrom},
                {MeshKind::hermite, grading, Method::nystrom}};
  }
  for (Family& family : families) family.method = method_for_damping(input, family.method);
  families.erase(std::unique(families.begin(), families.end()), families.end());
  return families;
}

// The reference, its leading sub-impacts that are certain and within its own tolerance, and the
// horizon in the middle of the separation that follows.
void find_reference(Plan& plan, const Case& input, const WithinOptions& how) {
  Case asked = input;
  asked.model = {};
  asked.model.section = input.model.section;
  asked.model.layers = input.model.layers;
  asked.solver = {};
  asked.parts.mesh = nullptr;
  asked.output.keep_no_rows();
  asked.accuracy.event_times = reference_share * plan.wanted;
  WithinRun run = simulate_within(asked, {}, how);
  Reference& reference = plan.reference;
  reference.input = std::move(run.input);
  reference.result = std::move(run.result);
  const ToleranceOutcome& outcome = reference.result.tolerance.value();
  const auto is_within = [&](const SubImpact& s) { return s.start < outcome.horizon; };
  const auto& all = reference.result.sub_impacts;
  const auto n =
      static_cast<std::size_t>(std::ranges::partition_point(all, is_within) - all.begin());
  set_horizon(reference, n, outcome.reason);
  reference.error = outcome.reached;
  if (plan.interrupted || (n > 0 && (n > 1 || reference.sub_impacts.front().end))) return;
  throw InvalidCase(
      "time.end",
      fmt::format("is {} s, up to which no event time is known to {:.2g} us: {}; use "
                  "a later end, a larger error, or more accuracy.work_limit",
                  input.end_time, 1e6 * reference_share * plan.wanted,
                  outcome.reason.empty() ? "the first contact lasts to the end" : outcome.reason));
}

// Whether the errors of all sub-impacts are small compared with their durations and the separations
// around them, those of the reference included. A tolerance may be larger.
bool are_recognisable(const std::vector<SubImpact>& run, const std::vector<SubImpact>& reference) {
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const SubImpact& s = reference[i];
    double error = std::abs(run[i].start - s.start);
    if (s.end && run[i].end) error = std::max(error, std::abs(*run[i].end - *s.end));
    error += std::max(s.start_error.value_or(0.0), s.end_error.value_or(0.0));
    for (const LengthBeside& beside : lengths_beside(reference, i)) {
      if (error > recognisable * beside.length) return false;
    }
  }
  return true;
}

class Planner {
 public:
  Planner(Plan& plan, const PlanOptions& options) : plan_(plan), options_(options) {}

  void run(const Family& family);
  void bisect();

 private:
  bool run_point(const Case& input);
  double work_of_next(std::size_t first) const;
  bool is_enough(std::size_t first, int in_a_row) const;
  void admit(const Refinement& sequence, std::size_t first);

  Plan& plan_;
  const PlanOptions& options_;
  std::optional<Refinement> sequence_;  // of the cheapest
  std::size_t first_of_sequence_ = 0;
};

// Adds the run; false if interrupted, or refused: a mesh too coarse for the strike.
bool Planner::run_point(const Case& input) {
  PlanPoint point;
  point.input = input;
  point.mesh = mesh_words(input);
  point.setting.method = descriptor_of(input.solver.method).name;
  if (options_.announce)
    options_.announce(point.mesh + ", " + point.setting.method, input.end_time);
  const Result result = run_trial(point, plan_.reference, options_.progress);
  if (result.outcome.kind == OutcomeKind::stopped) plan_.interrupted = true;
  if (plan_.interrupted || point.verdict == Verdict::refused) return false;
  point.counted = counted_work(result);
  point.within = point.verdict == Verdict::right &&
                 point.errors.maximum + plan_.reference.error <= plan_.wanted &&
                 are_recognisable(result.sub_impacts, plan_.reference.sub_impacts);
  plan_.points.push_back(std::move(point));
  return true;
}

// Admits the runs from `first` on that are within together with all finer ones.
void Planner::admit(const Refinement& sequence, std::size_t first) {
  auto& points = plan_.points;
  std::size_t n = points.size();
  while (n > first && points[n - 1].within) --n;
  if (n + 2 > points.size()) return;  // a single run proves nothing
  for (std::size_t i = n; i < points.size(); ++i) points[i].admitted = true;
  if (plan_.cheapest && points[n].counted >= points[*plan_.cheapest].counted) return;
  plan_.cheapest = n;
  sequence_ = sequence;
  first_of_sequence_ = first;
}

// Extrapolated from the work of the last two runs of the sequence that begins at `first`.
double Planner::work_of_next(std::size_t first) const {
  const auto& points = plan_.points;
  const double last = points.back().counted;
  if (points.size() < first + 2) return last;
  return last * std::max(1.0, last / points[points.size() - 2].counted);
}

// Whether the sequence from `first` need not go on: its finest runs are within the wanted error, or
// neither they nor the next can be the cheapest.
bool Planner::is_enough(std::size_t first, int in_a_row) const {
  const PlanPoint& last = plan_.points.back();
  const Case& reference = plan_.reference.input;
  const bool beside_reference = last.input.model.mesh == reference.model.mesh &&
                                last.input.solver.method == reference.solver.method &&
                                last.input.model.strike_refinement == 1.0;
  if (in_a_row >= (beside_reference ? enough_beside_reference : enough_in_a_row)) return true;
  const double cheapest_left =
      in_a_row == 0
          ? work_of_next(first)
          : plan_.points[plan_.points.size() - static_cast<std::size_t>(in_a_row)].counted;
  return cheapest_left >
         (plan_.cheapest ? plan_.points[*plan_.cheapest].counted : reference.accuracy.work_limit);
}

void Planner::run(const Family& family) {
  Case base = plan_.reference.input;
  base.model.mesh = family.mesh;
  base.model.strike_refinement = family.refinement;
  base.solver = {};
  base.solver.method = family.method;
  base.end_time = plan_.reference.horizon;
  const std::size_t first = plan_.points.size();
  const Refinement sequence(base, {});
  std::optional<Case> next = sequence.resized(
      sequence.first(), static_cast<double>(fewest_parts) / mesh_count(sequence.first()));
  for (int in_a_row = 0; next; next = sequence.finer(*next, std::sqrt(2.0))) {
    if (!run_point(*next)) {
      if (plan_.interrupted) return;
      continue;
    }
    in_a_row = plan_.points.back().within ? in_a_row + 1 : 0;
    if (is_enough(first, in_a_row)) break;
  }
  admit(sequence, first);
}

// Tries meshes between the cheapest and the next coarser one of its sequence.
void Planner::bisect() {
  auto& points = plan_.points;
  for (int i = 0; i < bisections && plan_.cheapest && *plan_.cheapest > first_of_sequence_; ++i) {
    const std::size_t finer = *plan_.cheapest;
    const Case& below = points[finer - 1].input;
    const double ratio =
        std::sqrt(static_cast<double>(mesh_count(points[finer].input)) / mesh_count(below));
    const std::optional<Case> between = sequence_->finer(below, ratio);
    if (!between || mesh_count(*between) >= mesh_count(points[finer].input)) return;
    if (!run_point(*between)) return;
    points.back().admitted = points.back().within;
    if (!points.back().within) ++*plan_.cheapest;
    std::rotate(points.begin() + static_cast<std::ptrdiff_t>(finer), points.end() - 1,
                points.end());
  }
}

}  // namespace

Plan plan(const Case& input, double wanted, const PlanOptions& options) {
  Plan result;
  result.asked = input;
  result.wanted = wanted;
  WithinOptions how;
  how.jobs = options.jobs;
  if (options.announce) {
    how.announce = [&](const std::string& what) {
      options.announce("reference: " + what, input.end_time);
    };
  }
  how.progress = [&](double time) {
    if (options.progress && !options.progress(time)) result.interrupted = true;
    return !result.interrupted;
  };
  find_reference(result, input, how);
  if (result.interrupted) return result;
  Planner planner(result, options);
  for (const Family& family : families_of(input)) {
    try {
      planner.run(family);
    } catch (const InvalidCase&) {  // no mesh of the kind suits the scene
    }
    if (result.interrupted) return result;
  }
  planner.bisect();
  return result;
}

}  // namespace subimpact
