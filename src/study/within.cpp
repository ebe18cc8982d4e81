#include "subimpact/study/within.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/methods.h"
#include "study/error_part.h"
#include "study/refinement.h"
#include "study/run_beside.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

// Meshes finer by less than this are not worth a run. After a doubling the last run is the
// companion of the next; a larger step would rely on the stated error of too coarse a mesh.
constexpr double least_refinement = 1.25;
constexpr double usual_refinement = 2.0;
constexpr double half_refinement = 1.4142135623730951;
// An error that a finer mesh leaves larger than this share of what it was is not the mesh's.
constexpr double stalled = 0.8;
// Of the refinement that the stated error asks for.
constexpr double margin = 1.05;
// Of the time scale of the shortest contacts, where nothing is wished.
constexpr double default_share_of_contact = 0.1;

// A step that moves every mode in closed form takes as long as these evaluations.
constexpr double evaluations_per_step_in_modes = 3.0;

double default_wish(const Case& input) {
  return default_share_of_contact * resolve(input).settings().contact_time;
}

struct Level {
  Case input;
  Result result;
};

// How many leading sub-impacts are decided and within an error, and what ends them.
struct Reach {
  std::size_t n_within = 0;
  double error_within = 0.0;   // s, the largest stated one of these
  double error_beyond = 0.0;   // s, of the first decided one that is not within; 0: there is none
  double error_decided = 0.0;  // s, of all that are decided
  bool all_decided = false;
  std::string reason;  // empty if all are within the error
};

Reach reach_of(const Result& result, double wish) {
  Reach reach;
  const auto& all = result.sub_impacts;
  const std::size_t n_decided = result.n_decided().value_or(0);
  reach.all_decided = result.all_decided();
  bool within = true;
  for (std::size_t i = 0; i < n_decided; ++i) {
    const double error = std::max(all[i].start_error.value_or(0.0), all[i].end_error.value_or(0.0));
    reach.error_decided = std::max(reach.error_decided, error);
    if (within && error > wish) {
      within = false;
      reach.error_beyond = error;
      reach.reason = fmt::format("the error of sub-impact {} is {:.2g} us", i + 1, 1e6 * error);
    }
    if (!within) continue;
    reach.n_within = i + 1;
    reach.error_within = reach.error_decided;
  }
  if (within && !reach.all_decided) {
    reach.reason = result.error_estimate ? result.error_estimate->reason
                                         : "no coarser run is possible that would show the error";
  }
  return reach;
}

class Ladder {
 public:
  Ladder(const Case& input, const OpenChoices& open, const WithinOptions& options)
      : input_(input), open_(open), options_(options) {}

  WithinRun climb();

 private:
  void choose(bool yields);
  bool run(const Case& next);
  void retire_level();
  const Level* known(const Case& input) const;
  void count(const Result& result);
  bool try_other_model();
  std::optional<Case> finer_case();
  double work_of_next(double ratio) const;
  double observed_order() const;
  double ratio_towards_wish() const;
  bool is_out_of_reach();
  double horizon(const Result& result) const;
  void report(WithinRun& run) const;

  Case input_;
  OpenChoices open_;
  WithinOptions options_;
  double wish_ = 0.0;  // s
  double work_limit_ = 0.0;
  bool yields_ = false;
  bool may_change_model_ = true;
  ChosenModel model_;
  std::optional<Refinement> refinement_;
  std::optional<Level> level_;
  std::deque<Level> earlier_;       // without rows; companions, and levels that may become ones
  const Level* coarser_ = nullptr;  // the companion of the level
  Reach reach_;
  double work_ = 0.0;        // of all runs so far
  double last_error_ = 0.0;  // s, of the decided events of the level before
  int last_count_ = 0;       // cells or elements of that level
  std::string obstacle_;     // why no finer mesh is run
  std::string key_;          // that stands in the way
};

void Ladder::choose(bool yields) {
  yields_ = yields;
  model_ = choose_model(input_, open_, yields);
  refinement_.emplace(model_.input, open_);
}

void Ladder::count(const Result& result) {
  work_ += counted_work(result);
  if (options_.finished) options_.finished(result);
}

// Runs the case and its companion; false if stopped.
bool Ladder::run(const Case& next) {
  const std::optional<Companion> companion = companion_of(next);
  if (options_.announce) {
    options_.announce(resolve(next).settings().mesh + ", " +
                      descriptor_of(next.solver.method).name);
  }
  retire_level();
  coarser_ = companion ? known(companion->input) : nullptr;
  RunPair pair =
      run_beside(next, companion && !coarser_ ? &companion->input : nullptr, options_.jobs,
                 options_.progress, options_.rows ? options_.rows() : nullptr);
  const bool stopped = pair.run.outcome.kind == OutcomeKind::stopped;
  count(pair.run);
  if (pair.other) {
    count(*pair.other);
    earlier_.push_back({companion->input, std::move(*pair.other)});
    coarser_ = &earlier_.back();
  }
  if (companion && !stopped) add_companion_errors(pair.run, next, *companion, coarser_->result);
  level_ = Level{next, std::move(pair.run)};
  return !stopped;
}

void Ladder::retire_level() {
  if (!level_) return;
  level_->result.history.clear();
  level_->result.section_history.clear();
  earlier_.push_back(std::move(*level_));
  level_.reset();
}

// The run of a setting, if there was one.
const Level* Ladder::known(const Case& input) const {
  const auto is_same = [&](const Level& level) {
    return level.result.outcome.completed() && Refinement::is_same_setting(level.input, input);
  };
  const auto found = std::ranges::find_if(earlier_, is_same);
  return found == earlier_.end() ? nullptr : &*found;
}

// Whether the beam turned out to bend elastically though it could yield, or the other way round.
bool Ladder::try_other_model() {
  if (!may_change_model_ || !open_.mesh || !open_.method || !may_yield(input_)) return false;
  const bool yielded = level_->result.n_yielded_sections > 0;
  if (yielded == yields_ || !level_->result.outcome.completed()) return false;
  may_change_model_ = yields_;  // back at most once
  choose(yielded);
  return true;
}

// As the counted work of the last two runs grows; the companion's is a quarter.
double Ladder::work_of_next(double ratio) const {
  double exponent = 2.0;
  if (coarser_) {
    const double sizes = static_cast<double>(mesh_count(level_->input)) /
                         static_cast<double>(mesh_count(coarser_->input));
    if (sizes > 1.0) {
      exponent =
          std::log(counted_work(level_->result) / counted_work(coarser_->result)) / std::log(sizes);
    }
  }
  exponent = std::clamp(exponent, 1.0, 4.0);
  const double companion = std::abs(ratio - 2.0) < 0.01 ? 0.0 : std::pow(0.5, exponent);
  return counted_work(level_->result) * std::pow(ratio, exponent) * (1.0 + companion);
}

// At which stated errors fall; the order of the mesh where there is no saying.
double Ladder::observed_order() const {
  if (!(last_error_ > 0.0 && reach_.error_decided > 0.0)) return refinement_->order();
  const double sizes = static_cast<double>(mesh_count(level_->input)) / last_count_;
  if (sizes < least_refinement) return refinement_->order();
  return std::log(last_error_ / reach_.error_decided) / std::log(sizes);
}

// What the stated error asks for; a doubling where that costs no more, as it needs no companion of
// its own.
double Ladder::ratio_towards_wish() const {
  const double order = refinement_->order();
  const double falls = std::clamp(observed_order(), 0.5 * order, order);
  const double asked = margin * std::pow(reach_.error_decided / wish_, 1.0 / falls);
  const double ratio = std::clamp(asked, least_refinement, usual_refinement);
  return work_of_next(usual_refinement) <= work_of_next(ratio) ? usual_refinement : ratio;
}

// Whether not even the first sub-impact beyond the horizon can come within the wish. Errors of two
// levels must have shown how they fall.
bool Ladder::is_out_of_reach() {
  if (!(last_error_ > 0.0) || !(reach_.error_beyond > wish_)) return false;
  const double order = std::max(observed_order(), refinement_->order());
  const double work = work_ + work_of_next(std::pow(reach_.error_beyond / wish_, 1.0 / order));
  if (work <= work_limit_) return false;
  key_ = "accuracy.work_limit";
  obstacle_ = fmt::format(
      "a mesh on which it is within the wish would take the counted work from {:.1e} to some "
      "{:.1e}, above the limit of {:.1e}",
      work_, work, work_limit_);
  return true;
}

std::optional<Case> Ladder::finer_case() {
  if (const char* key = refinement_->fixed_key()) {
    key_ = key;
    obstacle_ = fmt::format("{} is fixed by the case", key);
    return std::nullopt;
  }
  if (!open_.tolerance && last_error_ > 0.0 && reach_.error_decided > stalled * last_error_) {
    key_ = level_->input.solver.step ? "solver.step" : "solver.rtol";
    obstacle_ =
        fmt::format("the error no longer falls with the mesh, and {} is fixed by the case", key_);
    return std::nullopt;
  }
  if (is_out_of_reach()) return std::nullopt;
  double ratio = usual_refinement;
  if (reach_.error_decided <= wish_) {
    // The run may be right, and its companion too coarse to show it. Of the next but one this run
    // is the companion.
    ratio = half_refinement;
  } else if (reach_.all_decided) {
    ratio = ratio_towards_wish();
  }
  last_error_ = reach_.error_decided;
  last_count_ = mesh_count(level_->input);
  ratio = std::clamp(ratio, least_refinement, usual_refinement);
  while (work_ + work_of_next(ratio) > work_limit_ && ratio > least_refinement) {
    ratio = std::max(least_refinement, 0.9 * ratio);
  }
  if (work_ + work_of_next(ratio) > work_limit_) {
    key_ = "accuracy.work_limit";
    obstacle_ = fmt::format(
        "a finer mesh would take the counted work from {:.1e} to {:.1e}, above "
        "the limit of {:.1e}",
        work_, work_ + work_of_next(ratio), work_limit_);
    return std::nullopt;
  }
  const std::optional<Case> finer = refinement_->finer(level_->input, ratio);
  if (!finer) {
    key_ = refinement_->size_key();
    obstacle_ = "the mesh is the finest that is allowed";
    return std::nullopt;
  }
  try {
    check_memory(resolve(*finer).settings());
  } catch (const InvalidCase& error) {
    key_ = error.key;
    obstacle_ = fmt::format("on a finer mesh {} {}", error.key, error.what());
    return std::nullopt;
  }
  return finer;
}

WithinRun Ladder::climb() {
  choose(may_yield(input_));
  const std::optional<double>& wish = input_.accuracy.event_times;
  wish_ = wish.value_or(default_wish(model_.input));
  work_limit_ = wish ? input_.accuracy.work_limit : default_work_limit;
  Case next = refinement_->first();
  std::optional<Case> sound;  // the last level that completed
  while (run(next)) {
    if (!level_->result.outcome.completed() && sound) {
      obstacle_ =
          fmt::format("the run on the next mesh failed ({})", level_->result.outcome.message);
      if (run(*sound)) reach_ = reach_of(level_->result, wish_);
      break;
    }
    if (level_->result.outcome.completed()) sound = level_->input;
    if (try_other_model()) {
      next = refinement_->first();
      sound.reset();
      continue;
    }
    reach_ = reach_of(level_->result, wish_);
    if (reach_.reason.empty()) break;
    const std::optional<Case> finer = finer_case();
    if (!finer) break;
    next = *finer;
  }
  WithinRun run{std::move(level_->input), std::move(level_->result)};
  report(run);
  return run;
}

// Up to where event times are within the wish: the first start beyond it or, where a run compared
// with has a sub-impact after the last one here, the end of the last.
double Ladder::horizon(const Result& result) const {
  const auto& all = result.sub_impacts;
  if (reach_.n_within < all.size()) return all[reach_.n_within].start;
  if (result.all_decided()) return result.outcome.time;
  return all.empty() ? 0.0 : result.end_of(all.back());
}

void Ladder::report(WithinRun& run) const {
  Result& result = run.result;
  result.choice = model_.reason;
  if (!obstacle_.empty() && !input_.accuracy.event_times) result.choice += "; " + obstacle_;
  if (!input_.accuracy.event_times) return;
  WishOutcome outcome;
  outcome.wished = wish_;
  outcome.met = result.outcome.completed() && reach_.reason.empty();
  outcome.reached = reach_.error_within;
  outcome.horizon = horizon(result);
  if (!result.outcome.completed()) {
    outcome.reason = result.outcome.message;
  } else if (!outcome.met) {
    outcome.reason = reach_.reason + "; " + obstacle_;
    outcome.key = key_;
  }
  result.wish = outcome;
}

}  // namespace

double counted_work(const Result& result) {
  const Work& work = result.work;
  auto evaluations = static_cast<double>(work.right_hand_sides);
  if (result.given.solver.method == Method::exponential) {
    evaluations +=
        evaluations_per_step_in_modes * static_cast<double>(work.steps + work.rejected_steps);
  }
  return evaluations * static_cast<double>(std::max<std::size_t>(result.used.n_unknowns, 1)) +
         result.used.decomposition;
}

ChosenModel first_choice(const Case& input, const OpenChoices& open) {
  ChosenModel chosen = choose_model(input, open, may_yield(input));
  const Refinement refinement(chosen.input, open);
  chosen.input = refinement.first();
  const std::optional<double>& wish = input.accuracy.event_times;
  if (const char* key = refinement.fixed_key()) {
    chosen.reason += fmt::format("; {} is fixed by the case", key);
    return chosen;
  }
  chosen.reason += fmt::format(
      "; refined until every event time is within {:.3g} us{} of the limit of fine meshes, or the "
      "counted work reaches {:.1e}",
      1e6 * wish.value_or(default_wish(chosen.input)), wish ? "" : " (the default)",
      wish ? input.accuracy.work_limit : default_work_limit);
  if (may_yield(input) && open.mesh && open.method) {
    chosen.reason += "; elements in natural modes instead if no section yields";
  }
  return chosen;
}

WithinRun simulate_within(const Case& input, const OpenChoices& open,
                          const WithinOptions& options) {
  return Ladder(input, open, options).climb();
}

}  // namespace subimpact
