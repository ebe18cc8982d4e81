#include "random_scenes/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <nlohmann/json.hpp>

#include "random_scenes/scene_keys.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact::scenes {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Stops a run at a limit of wall clock, and one whose simulated time stands still.
class Watch {
 public:
  Watch(double end_time, double limit) : end_time_(end_time), limit_(limit) {}

  // Called every 512 steps.
  bool go_on(double time) {
    seen_.push_back({seconds_since(start_), time});
    if (seen_.size() > window && !moves_since(seen_[seen_.size() - 1 - window], 1e-11)) {
      stands_still_ = true;
      return false;
    }
    over_limit_ = seen_.back().seconds > limit_;
    return !over_limit_;
  }

  bool over_limit() const { return over_limit_; }
  bool stands_still() const { return stands_still_; }
  double time() const { return seen_.empty() ? 0.0 : seen_.back().time; }

 private:
  struct Seen {
    double seconds, time;
  };
  static constexpr std::size_t window = 64;  // 32768 steps

  bool moves_since(const Seen& then, double share) const {
    return seen_.back().time - then.time > share * end_time_;
  }
  double end_time_, limit_;
  Clock::time_point start_ = Clock::now();
  std::vector<Seen> seen_;
  bool over_limit_ = false;
  bool stands_still_ = false;
};

// As the tables head their columns.
std::string name_of(OutcomeKind kind) {
  if (kind == OutcomeKind::stopped) return "wall clock";
  std::string name(to_string(kind));
  std::replace(name.begin(), name.end(), '-', ' ');
  return name;
}

std::string setting_of(const Case& input) {
  const SolverOptions& solver = input.solver;
  std::string text = solver.step ? "fixed step" : fmt::format("rtol {:.1e}", solver.rtol);
  if (solver.method == Method::central_difference && !solver.step) text = "default step";
  if (solver.table) text += ", " + *solver.table;
  if (solver.max_order) text += fmt::format(", order {}", *solver.max_order);
  for (const char* name : {"solver.events", "solver.reversals"}) {
    if (const auto value = find_case_key(name)->get(input)) {
      text += fmt::format(", {} {}", find_case_key(name)->leaf(), to_text(*value));
    }
  }
  if (!input.study.pair_detection) text += ", no pairs";
  const auto word = [&](const char* name) { return to_text(*find_case_key(name)->get(input)); };
  return text +
         fmt::format("; {} {}, {}, contact {}", word("model.mesh"),
                     input.model.mesh == MeshKind::cells     ? input.model.segments
                     : input.model.mesh == MeshKind::hermite ? input.model.elements
                                                             : 0,
                     word("model.section"), word("contact.law")) +
         scene_keys_of(input);
}

std::string band_of(const SolverOptions& solver) {
  if (solver.step || solver.method == Method::central_difference) return "fixed steps";
  if (solver.rtol > 1e-4) return "looser than 1e-4";
  return solver.rtol > 1e-6 ? "1e-4 to 1e-6" : "1e-6 and tighter";
}

void take_outcome(const Result& result, const Watch& watch, Record& record) {
  record.outcome = name_of(result.outcome.kind);
  if (!result.outcome.completed()) record.message = result.outcome.message;
  record.n_sub_impacts = static_cast<int>(result.sub_impacts.size());
  if (watch.stands_still()) {
    record.outcome = "stood still";
    record.failures.push_back({"time goes on", fmt::format("at {} s, {} sub-impacts", watch.time(),
                                                           result.sub_impacts.size())});
  }
}

void run_checks(const Drawn& drawn, double limit, Record& record) {
  Watch watch(drawn.input.end_time, limit);
  const Result result = simulate(drawn.input, [&](double time) { return watch.go_on(time); });
  take_outcome(result, watch, record);
  record.reached = result.outcome.time / drawn.input.end_time;
  for (const Failure& failure : failures_of(drawn.input, result)) {
    record.failures.push_back(failure);
  }
}

Case reference_case(const Case& input, Method method) {
  Case reference = input;
  reference.solver = {};
  reference.solver.method = method;
  reference.solver.rtol = 1e-10;
  reference.output.keep_no_rows();
  return reference;
}

// Nothing if it did not complete.
std::optional<Result> run_reference(const Case& input, Method method, double limit,
                                    Record& record) {
  const Case reference = reference_case(input, method);
  Watch watch(reference.end_time, limit);
  Result result = simulate(reference, [&](double time) { return watch.go_on(time); });
  if (result.outcome.completed()) return result;
  record.why_not = fmt::format("{} at 1e-10: {}", to_string(method), name_of(result.outcome.kind));
  return std::nullopt;
}

void compare_counts(const Result& run, const Result& reference, Record& record) {
  const auto pairs = match_sub_impacts(run.sub_impacts, reference.sub_impacts);
  const std::size_t n = n_leading_matches(pairs);
  record.wrong_count = run.sub_impacts.size() != reference.sub_impacts.size();
  record.flagged = run.error_estimate && run.error_estimate->first_unresolved &&
                   *run.error_estimate->first_unresolved <= n;
  if (!record.wrong_count || record.flagged) return;
  record.failures.push_back({"wrong counts are flagged",
                             fmt::format("{} sub-impacts, {} in truth, {} alike; {}",
                                         run.sub_impacts.size(), reference.sub_impacts.size(), n,
                                         run.error_estimate && run.error_estimate->first_unresolved
                                             ? fmt::format("unresolved only from {} on",
                                                           *run.error_estimate->first_unresolved)
                                             : "nothing unresolved")});
}

std::vector<Method> reference_methods(const Record& record) {
  std::vector<Method> methods{Method::erk, Method::nystrom};
  if (record.id.purpose == Purpose::scene_keys && record.elastic) {
    methods.push_back(Method::exponential);
  }
  return methods;
}

// Methods disagree on the number of contacts: a judged run must mark where.
void demand_doubt(const Case& input, Record& record) {
  const Case reference = reference_case(input, Method::nystrom);
  const Result judged = simulate_judged(reference, cases_beside_in_time(reference), 1);
  if (judged.error_estimate && judged.error_estimate->first_unresolved) return;
  record.failures.push_back(
      {"counts that methods dispute are marked",
       fmt::format("{} sub-impacts, all resolved", judged.sub_impacts.size())});
}

void run_counts(const Drawn& drawn, double limit, Record& record) {
  const Case& input = drawn.input;
  Watch watch(input.end_time, 2.0 * limit);
  const Result run = simulate_judged(input, cases_beside_in_time(input), 1,
                                     [&](double time) { return watch.go_on(time); });
  take_outcome(run, watch, record);
  record.reached = run.outcome.time / input.end_time;
  for (const Failure& failure : failures_of(input, run)) record.failures.push_back(failure);
  if (!run.outcome.completed()) {
    record.why_not = "the drawn run: " + record.outcome;
    return;
  }
  std::vector<Result> references;
  for (const Method method : reference_methods(record)) {
    auto reference = run_reference(input, method, limit, record);
    if (!reference) return;
    references.push_back(std::move(*reference));
  }
  const auto n_contacts = [](const Result& result) { return result.sub_impacts.size(); };
  if (!std::ranges::all_of(references, [&](const Result& result) {
        return n_contacts(result) == n_contacts(references.front());
      })) {
    record.why_not = "the references at 1e-10 disagree";
    demand_doubt(input, record);
    return;
  }
  record.compared = true;
  compare_counts(run, references.back(), record);
}

}  // namespace

Record describe(const SceneId& id, const Drawn& drawn) {
  Record record;
  record.id = id;
  record.refused = drawn.refused;
  record.too_costly = drawn.too_costly;
  record.guess = drawn.seconds;
  const SolverOptions& solver = drawn.input.solver;
  record.method = to_string(solver.method);
  record.setting = setting_of(drawn.input);
  record.band = band_of(solver);
  record.elastic = drawn.input.model.section == SectionKind::elastic ||
                   drawn.input.model.mesh == MeshKind::rigid ||
                   !std::isfinite(drawn.input.scene.beam.yield_stress);
  record.tight = record.band == "1e-6 and tighter";
  record.plain = !solver.events && !solver.reversals && drawn.input.study.pair_detection;
  return record;
}

Record run_scene(const SceneId& id, double limit) {
  const Drawn drawn = draw(id);
  Record record = describe(id, drawn);
  record.failures = failures_of_file(drawn.input);
  const auto start = Clock::now();
  try {
    if (id.purpose == Purpose::counts || id.purpose == Purpose::scene_keys) {
      run_counts(drawn, limit, record);
    } else {
      run_checks(drawn, limit, record);
    }
  } catch (const InvalidCase& error) {
    record.outcome = "refused";
    record.failures.push_back({"resolve() refuses what simulate() does", error.what()});
  } catch (const std::exception& error) {
    record.outcome = "exception";
    record.failures.push_back({"no exception", error.what()});
  }
  record.seconds = seconds_since(start);
  return record;
}

std::string to_line(const Record& r) {
  nlohmann::json failures = nlohmann::json::array();
  for (const Failure& f : r.failures) failures.push_back({f.check, f.detail});
  const nlohmann::json line = {{"seed", r.id.seed},
                               {"number", r.id.number},
                               {"purpose", r.id.purpose},
                               {"refused", r.refused},
                               {"too_costly", r.too_costly},
                               {"method", r.method},
                               {"setting", r.setting},
                               {"band", r.band},
                               {"outcome", r.outcome},
                               {"message", r.message},
                               {"elastic", r.elastic},
                               {"tight", r.tight},
                               {"plain", r.plain},
                               {"reached", r.reached},
                               {"seconds", r.seconds},
                               {"guess", r.guess},
                               {"n_sub_impacts", r.n_sub_impacts},
                               {"failures", failures},
                               {"compared", r.compared},
                               {"why_not", r.why_not},
                               {"wrong_count", r.wrong_count},
                               {"flagged", r.flagged}};
  return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Record from_line(const std::string& text) {
  const nlohmann::json line = nlohmann::json::parse(text);
  Record r;
  r.id = {line["seed"], line["number"], line["purpose"]};
  r.refused = line["refused"];
  r.too_costly = line["too_costly"];
  r.method = line["method"];
  r.setting = line["setting"];
  r.band = line["band"];
  r.outcome = line["outcome"];
  r.message = line["message"];
  r.elastic = line["elastic"];
  r.tight = line["tight"];
  r.plain = line["plain"];
  r.reached = line["reached"].is_number() ? line["reached"].get<double>() : 0.0;
  r.seconds = line["seconds"];
  r.guess = line["guess"].is_number() ? line["guess"].get<double>() : 0.0;
  r.n_sub_impacts = line["n_sub_impacts"];
  for (const auto& f : line["failures"]) r.failures.push_back({f[0], f[1]});
  r.compared = line["compared"];
  r.why_not = line["why_not"];
  r.wrong_count = line["wrong_count"];
  r.flagged = line["flagged"];
  return r;
}

}  // namespace subimpact::scenes
