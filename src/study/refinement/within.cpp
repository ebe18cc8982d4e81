#include "subimpact/study/run_as_asked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "study/judgement/mesh_resolution.h"
#include "study/method_choice.h"
#include "study/refinement/refinement.h"

namespace subimpact {
namespace {

constexpr double tolerance_of_rigid_bodies = 1e-10;
constexpr const char* kinks_bound_the_error =
    "sections yield, so that kinks, not the order of a method, bound the error";

// Why elements, and mostly natural modes, suit a beam of which no section yields.
std::string elastic_reason(const Case& chosen) {
  if (chosen.solver.method != Method::exponential) return "the beam bends elastically";
  return may_yield(chosen) ? "no section yields, so that free flight is exact in natural modes; "
                             "contact, in which one might, is integrated by nystrom"
                           : "the beam bends elastically, so that natural modes are exact in time";
}

// Meshes finer by less than this are not worth a run; a larger step than the usual one would rely
// on errors of too coarse a mesh.
constexpr double least_refinement = 1.25;
constexpr double usual_refinement = 2.0;
constexpr double largest_refinement = 4.0;  // while less than half of the sub-impacts are certain
// Factor on the refinement that follows from the stated error.
constexpr double margin = 1.1;
// Evaluations of a method that explicit contact takes per step, and the phase of the highest
// frequency that one covers.
constexpr double evaluations_per_explicit_step = 8.0;
constexpr double phase_per_explicit_step = 2.0;
// A level that takes this share of the work allowed keeps rows, rather than to be run again.
constexpr double share_of_costly_level = 0.1;

// Of a run and those beside it, as far as it is known beforehand: of fixed steps, or of those that
// the mesh leaves to explicit methods where a section might yield; else nothing.
double work_of_steps(const Case& input) {
  constexpr double share_taken = 0.25;  // by explicit methods: measured
  const ResolvedSettings used = resolve(input).settings();
  const Method method = input.solver.method;
  double evaluations = 0.0;
  if (used.step) {
    evaluations = input.end_time / *used.step;
  } else if (may_yield(input) && (method == Method::erk || method == Method::nystrom)) {
    evaluations = share_taken * input.end_time * used.highest_frequency *
                  evaluations_per_explicit_step / phase_per_explicit_step;
  }
  return work_with_others * evaluation_cost(input) * evaluations *
         static_cast<double>(used.n_unknowns);
}

// The same with natural modes.
double work_known(const Case& input) {
  return work_of_steps(input) + work_with_others * resolve(input).settings().decomposition;
}

double work_limit_of(const Case& input) {
  return input.accuracy.event_times ? input.accuracy.work_limit : default_work_limit;
}

// The coarsest mesh worth a run or, where that would take more work than is allowed, a coarser one.
Case affordable_first(const Refinement& refinement, double work_limit) {
  const Case& first = refinement.first();
  const double work = work_known(first);
  if (refinement.fixed_key() || work <= work_limit) return first;
  return refinement.resized(first, std::pow(work_limit / work, 1.0 / usual_growth)).value_or(first);
}

double default_tolerance(const Refinement& refinement) {
  return default_share_of_contact * refinement.contact_time();
}

double largest_time_error(const SubImpact& s) {
  return std::max(s.start_error.value_or(HUGE_VAL), s.end ? s.end_error.value_or(HUGE_VAL) : 0.0);
}

using Level = WithinRun;

class Search {
 public:
  Search(const Case& input, const OpenChoices& open, const WithinOptions& options)
      : input_(input), open_(open), options_(options) {
    options_.make = maker_of(options);
    choose(may_yield(input));
    tolerance_ = input.accuracy.event_times.value_or(default_tolerance(*refinement_));
    work_limit_ = work_limit_of(input);
  }

  WithinRun run() {
    std::optional<Case> next = affordable_first(*refinement_, work_limit_);
    while (next) {
      Level level = level_of(*next, is_last(*next));
      if (level.result.outcome.kind == OutcomeKind::stopped) return ended_early(std::move(level));
      if (!level.result.outcome.completed() && best_) {
        obstacle_ = {Reason::Kind::failed_run, level.result.outcome.message};
        break;
      }
      const bool grows = best_ && level.result.n_certain() > best_->result.n_certain();
      if (best_) grew_ = grows;
      best_ = std::move(level);
      if (!input_.accuracy.event_times) {
        work_limit_ = grows ? work_limit_while_certainty_grows : default_work_limit;
      }
      if (change_model()) {
        next = affordable_first(*refinement_, work_limit_);
        continue;
      }
      if (!best_->result.outcome.completed() || is_met()) break;
      next = finer_case();
    }
    if (!has_rows_) run_again();
    WithinRun found = std::move(*best_);
    describe(found);
    return found;
  }

 private:
  void choose(bool yields) {
    yields_ = yields;
    model_ = choose_model(input_, open_, yields);
    refinement_.emplace(model_.input, open_);
  }

  // `keeps_rows`: whether no level after this one is to be expected. Where no section yields, which
  // makes extremes along the beam cheap, the runs beside take them in any case: the level may be
  // the last.
  Level level_of(const Case& input, bool keeps_rows) {
    if (options_.announce) {
      options_.announce(mesh_words(input) + ", " + descriptor_of(input.solver.method).name);
    }
    Level level{input, {}, {}};
    if (!keeps_rows) level.input.output.keep_no_rows();
    has_rows_ = keeps_rows;
    options_.make(level.input, cases_beside(yields_ ? level.input : input), rows_if(keeps_rows),
                  level.result, level.beside);
    level.input.output = input.output;
    work_ += counted_work(level.input, level.result);
    if (options_.finished) options_.finished(level.input, level.result);
    for (const RunBeside& other : level.beside) {
      work_ += counted_work(other.of.input, other.result);
      if (options_.finished) options_.finished(other.of.input, other.result);
    }
    return level;
  }

  RowSink* rows_if(bool keeps_rows) const {
    return keeps_rows && options_.rows ? options_.rows() : nullptr;
  }

  // The best run once more, for its rows and fields; the runs beside it too if they lack extremes.
  void run_again() {
    if (yields_) {
      Level again = level_of(best_->input, true);
      if (again.result.outcome.kind != OutcomeKind::stopped) best_ = std::move(again);
      return;
    }
    Result again;
    options_.make(best_->input, {}, rows_if(true), again, best_->beside);
    if (again.outcome.kind == OutcomeKind::stopped) return;
    best_->result = std::move(again);
    if (options_.finished) options_.finished(best_->input, best_->result);
  }

  // The result after an interruption: the last level that ended, else the current one.
  WithinRun ended_early(Level level) {
    if (!best_) return level;
    obstacle_ = {Reason::Kind::stopped_search};
    WithinRun found = std::move(*best_);
    describe(found);
    found.result.outcome = {OutcomeKind::stopped,
                            found.result.outcome.time,
                            "stopped on request; these are the results of the last mesh that was "
                            "finished, without a history",
                            {}};
    return found;
  }

  // Whether the beam turned out to bend elastically though it could yield, or the other way round.
  bool change_model() {
    if (!may_change_model_ || !open_.mesh || !open_.method || !may_yield(input_)) return false;
    const bool yielded = best_->result.n_yielded_sections > 0;
    if (yielded == yields_ || !best_->result.outcome.completed()) return false;
    may_change_model_ = yields_;  // back at most once
    choose(yielded);
    if (!yielded && work_ + work_of_contact_beside_modes() > work_limit_) {
      choose(true);
      return false;
    }
    best_.reset();
    grew_.reset();
    return true;
  }

  // Natural modes move free flight alone where a section might yield: contacts as long as those of
  // the best run take explicit steps, which the stiffest of the elements limits.
  double work_of_contact_beside_modes() const {
    double in_contact = 0.0;
    for (const SubImpact& s : best_->result.sub_impacts) {
      in_contact += s.end.value_or(best_->result.outcome.time) - s.start;
    }
    const Case& first = refinement_->first();
    const ResolvedSettings used = resolve(first).settings();
    const double steps = in_contact * used.joined_frequency / phase_per_explicit_step;
    return work_with_others *
           (used.decomposition + evaluation_cost(first) * steps * evaluations_per_explicit_step *
                                     static_cast<double>(used.n_unknowns));
  }

  double largest_error() const {
    return best_->result.error_estimate ? best_->result.error_estimate->largest_error : HUGE_VAL;
  }
  bool is_met() const { return best_->result.all_certain() && largest_error() <= tolerance_; }

  // Exponent with which work grows with the number of cells or elements: between the best run and
  // the coarsest one beside it. Where contact limits the steps of a coarse mesh, the next mesh
  // does.
  double growth_of_work() const {
    if (best_->beside.empty()) return usual_growth;
    const RunBeside& other = best_->beside.back();
    const double sizes = static_cast<double>(mesh_count(best_->input)) / mesh_count(other.of.input);
    if (!(sizes > 1.0)) return usual_growth;
    const double works =
        counted_work(best_->input, best_->result) / counted_work(other.of.input, other.result);
    return std::clamp(std::log(works) / std::log(sizes), 2.0, 4.0);
  }

  // Work of a level on a mesh finer by `ratio` than the best one, with the runs beside it.
  double work_of_next(double ratio) const {
    const double with_others =
        refinement_->order() > 2.0 ? work_with_others : work_with_others_if_fine;
    return with_others * counted_work(best_->input, best_->result) *
           std::pow(ratio, growth_of_work());
  }

  // The refinement that takes all the work that is left.
  double affordable_ratio() const {
    const double left = std::max(work_limit_ - work_, 0.0);
    return std::pow(left / work_of_next(1.0), 1.0 / growth_of_work());
  }

  // Whether no level is affordable after this one, or none is to be expected.
  bool is_last(const Case& next) const {
    if (refinement_->fixed_key()) return true;
    if (!best_) {
      const double with_next = 1.0 + std::pow(least_refinement, usual_growth);
      return with_next * work_known(next) > work_limit_;
    }
    const double ratio = static_cast<double>(mesh_count(next)) / mesh_count(best_->input);
    const double work = work_of_next(ratio);
    const double after = work_ + work + work_of_next(least_refinement * ratio);
    if (after > work_limit_ || work > share_of_costly_level * work_limit_) return true;
    const double falls = std::pow(ratio, refinement_->order());
    return best_->result.all_certain() && largest_error() / falls <= tolerance_;
  }

  // The refinement that the largest error requires; the usual one, or a larger one, while
  // sub-impacts are uncertain.
  double ratio_wanted() const {
    const Result& best = best_->result;
    if (2 * best.n_certain().value_or(0) < best.sub_impacts.size()) return largest_refinement;
    if (!best.all_certain()) return usual_refinement;
    const double asked =
        margin * std::pow(largest_error() / tolerance_, 1.0 / refinement_->order());
    return std::clamp(asked, least_refinement, usual_refinement);
  }

  std::optional<Case> finer_case() {
    if (const char* key = refinement_->fixed_key()) {
      return refuse(key, {Reason::Kind::fixed_key, key});
    }
    const double affordable = affordable_ratio();
    if (affordable < least_refinement) {
      using enum Reason::Kind;
      const auto kind = input_.accuracy.event_times ? work_limit : default_work_limit;
      const double work = work_ + work_of_next(least_refinement);
      return refuse("accuracy.work_limit", {kind, {}, work_, work, work_limit_});
    }
    // Where sub-impacts are uncertain, the last mesh is as fine as is affordable.
    double ratio = std::min(ratio_wanted(), affordable);
    const bool is_last =
        work_of_next(ratio) + work_of_next(usual_refinement * ratio) > work_limit_ - work_;
    if (!best_->result.all_certain() && is_last) ratio = affordable;
    std::optional<Case> finer = refinement_->finer(best_->input, ratio);
    if (!finer) return refuse(refinement_->size_key(), {Reason::Kind::finest_mesh});
    try {
      check_memory(resolve(*finer).settings());
    } catch (const InvalidCase& error) {
      return refuse(error.key, {Reason::Kind::memory, error.what()});
    }
    return finer;
  }

  std::nullopt_t refuse(const std::string& key, const Reason& obstacle) {
    key_ = key;
    obstacle_ = obstacle;
    return std::nullopt;
  }

  void describe(WithinRun& run) const {
    Result& result = run.result;
    result.certainty_grew = grew_;
    result.choice = model_.reason + (obstacle_ ? "; " + words_of(obstacle_) : "");
    if (!input_.accuracy.event_times) return;
    ToleranceOutcome& outcome = result.tolerance.emplace();
    outcome.asked = tolerance_;
    outcome.horizon = result.outcome.time;
    outcome.reached = result.error_estimate ? result.error_estimate->largest_error : HUGE_VAL;
    outcome.met =
        result.outcome.completed() && result.all_certain() && outcome.reached <= tolerance_;
    if (outcome.met) return;
    const auto beyond = std::ranges::find_if(result.sub_impacts, [&](const SubImpact& s) {
      return s.certain.value_or(false) && largest_time_error(s) > tolerance_;
    });
    outcome.obstacle = obstacle_;
    outcome.key = key_;
    using Kind = Reason::Kind;
    if (!result.outcome.completed()) {
      outcome.reason = {Kind::in_words, result.outcome.message};
    } else if (beyond != result.sub_impacts.end()) {
      outcome.reason = {.kind = Kind::error_of_times, .error = largest_time_error(*beyond)};
      outcome.reason->sub_impact = beyond - result.sub_impacts.begin();
    } else if (!result.error_estimate) {
      outcome.reason = {Kind::no_run_beside};
    } else {
      outcome.reason = result.error_estimate->reason;
      if (outcome.reason) outcome.reason->sub_impact = result.error_estimate->first_unresolved;
    }
    if (beyond != result.sub_impacts.end()) outcome.horizon = beyond->start;
  }

  Case input_;
  OpenChoices open_;
  WithinOptions options_;
  double tolerance_ = 0.0;  // s
  double work_limit_ = 0.0;
  bool yields_ = false;
  bool may_change_model_ = true;
  bool has_rows_ = false;     // the last run
  std::optional<bool> grew_;  // Result::certainty_grew
  ChosenModel model_;
  std::optional<Refinement> refinement_;
  std::optional<Level> best_;       // the last one that ended
  double work_ = 0.0;               // of all runs so far
  std::optional<Reason> obstacle_;  // why no finer mesh is run
  std::string key_;                 // that prevents meeting the tolerance
};

}  // namespace

JudgedRunMaker maker_of(const WithinOptions& options) {
  if (options.make) return options.make;
  return [jobs = options.jobs, progress = options.progress](
             const Case& input, const std::vector<CaseBeside>& cases, RowSink* rows, Result& run,
             std::vector<RunBeside>& beside) {
    std::ranges::move(simulate_beside(input, cases, jobs, progress, rows, run),
                      std::back_inserter(beside));
    judge(input, run, beside);
  };
}

ChosenModel choose_model(const Case& input, const OpenChoices& open, bool yields) {
  ChosenModel chosen{input, {}};
  ModelOptions& model = chosen.input.model;
  SolverOptions& solver = chosen.input.solver;
  const bool own_mesh = input.parts.mesh != nullptr;
  const bool bends = own_mesh || descriptor_of(model.mesh).bends;
  if (!bends) {
    if (open.method) solver.method = possible_method(input, Method::nystrom);
    if (open.tolerance) solver.rtol = tolerance_of_rigid_bodies;
    chosen.reason = "a rigid body has no mesh to refine";
    return chosen;
  }
  const bool central = !open.method && solver.method == Method::central_difference;
  const bool shears = input.scene.beam.shears();
  if (open.mesh && !own_mesh) {
    const bool prefers_cells = yields || central;
    model.mesh = prefers_cells ? default_mesh(input)
                 : shears      ? MeshKind::spectral
                               : MeshKind::hermite;
    if (!takes_strike(chosen.input)) model.mesh = default_mesh(input);
    if (model.mesh == MeshKind::cells && !shears && input.accuracy.event_times) {
      // Otherwise the error of free ends, of first order, falls last.
      model.spacing = CellSpacing::whole;
    }
  }
  if (open.method && !yields) solver.method = Method::exponential;
  if (open.method && yields) {
    const bool cells = !own_mesh && model.mesh == MeshKind::cells;
    solver.method = cells && central_differences_suit(chosen.input) ? Method::central_difference
                                                                    : Method::nystrom;
  }
  if (open.method) solver.method = possible_method(input, solver.method);
  const bool fixed = !open.method && !open.mesh;
  chosen.reason = fixed    ? "the case fixes mesh and method"
                  : yields ? kinks_bound_the_error
                           : elastic_reason(chosen.input);
  return chosen;
}

ChosenModel first_choice(const Case& input, const OpenChoices& open) {
  ChosenModel chosen = choose_model(input, open, may_yield(input));
  const Refinement refinement(chosen.input, open);
  const std::optional<double>& tolerance = input.accuracy.event_times;
  const double work_limit = work_limit_of(input);
  chosen.input = affordable_first(refinement, work_limit);
  if (const char* key = refinement.fixed_key()) {
    chosen.reason += fmt::format("; {} is fixed by the case", key);
    return chosen;
  }
  chosen.reason += fmt::format(
      "; refined until every event time is within {:.3g} us{} of the limit of fine meshes, or the "
      "counted work reaches {:.1e}",
      1e6 * tolerance.value_or(default_tolerance(refinement)), tolerance ? "" : " (the default)",
      work_limit);
  if (may_yield(input) && open.mesh && open.method) {
    chosen.reason += "; elements in natural modes instead if no section yields";
  }
  return chosen;
}

WorkRange work_expected(const Case& first, const std::optional<OpenChoices>& open) {
  const double level = work_known(first);
  if (open && Refinement(first, *open).fixed_key() == nullptr) {
    const double most =
        first.accuracy.event_times ? first.accuracy.work_limit : work_limit_while_certainty_grows;
    return {level, std::max(level, most)};
  }
  return {level, work_of_steps(first) > 0.0 ? std::optional(level) : std::nullopt};
}

WithinRun simulate_within(const Case& input, const OpenChoices& open,
                          const WithinOptions& options) {
  return Search(input, open, options).run();
}

}  // namespace subimpact
