// What runs call certain, and the errors they state, beside what finer meshes have, on random
// scenes.
//
//   subimpact_judgement [--seed S] [--scenes N] [--first K] [--budget seconds] [--shear]
//   [--verbose]
//   [--case] [--hammer FILE] [--cost FILE...] [--strike FILE [--set KEY=VALUE]...]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "case/problem.h"
#include "judgement/cost.h"
#include "strikes.h"
#include "study/parallel.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace {

using namespace subimpact;
using strikes::DrawnScene;

constexpr double us = 1e6;
constexpr int chatter = 30;  // contacts

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::ranges::sort(values);
  return values[values.size() / 2];
}

struct Coverage {
  int n = 0, covered = 0;
  std::vector<double> ratios;  // stated over true

  void add(double error, double stated) {
    ++n;
    covered += error <= stated;
    if (error > 0.0) ratios.push_back(stated / error);
  }
  void add(const Coverage& other) {
    n += other.n;
    covered += other.covered;
    ratios.insert(ratios.end(), other.ratios.begin(), other.ratios.end());
  }
  std::string text() const {
    return fmt::format("{} of {} ({:.1f} %) | {:.1f}", covered, n, 100.0 * covered / std::max(n, 1),
                       median(ratios));
  }
};

struct Findings {
  int contacts = 0, certain = 0, judged = 0, wrong = 0;
  int certain_sets = 0, lacking_sets = 0;
  int over = 0, said_over = 0, wrongly_over = 0;
  Coverage times, forces, impulses, velocities;
  std::map<RunTotal, Coverage> totals;
  std::map<RunTotal, std::vector<double>> widths;  // stated errors over the values
  std::vector<double> shares;                      // certain contacts, per scene without chatter
  std::string details;

  void add(const Findings& other) {
    contacts += other.contacts;
    certain += other.certain;
    judged += other.judged;
    wrong += other.wrong;
    certain_sets += other.certain_sets;
    lacking_sets += other.lacking_sets;
    over += other.over;
    said_over += other.said_over;
    wrongly_over += other.wrongly_over;
    times.add(other.times);
    forces.add(other.forces);
    impulses.add(other.impulses);
    velocities.add(other.velocities);
    for (const auto& [name, coverage] : other.totals) totals[name].add(coverage);
    for (const auto& [name, part] : other.widths) {
      widths[name].insert(widths[name].end(), part.begin(), part.end());
    }
    if (other.contacts > 0 && other.contacts <= chatter) {
      shares.push_back(static_cast<double>(other.certain) / other.contacts);
    }
  }
};

// What the two finest meshes have, as far as they agree.
class Truth {
 public:
  explicit Truth(const DrawnScene& scene)
      : share_(std::pow(2.0, scene.order) - 1.0),
        coarse_(judged(scene.finer[scene.finer.size() - 2])),
        fine_(judged(scene.finer.back())),
        in_coarse_(counterparts(fine_.sub_impacts, coarse_.sub_impacts)) {}

  const Result& fine() const { return fine_; }
  bool counts_agree() const { return coarse_.sub_impacts.size() == fine_.sub_impacts.size(); }

  // Whether both meshes have the same number of contacts there, and how many.
  std::optional<int> contacts_within(const SubImpact& s) const {
    const int n = count_within(fine_, s);
    return n == count_within(coarse_, s) ? std::optional(n) : std::nullopt;
  }
  const SubImpact* coarse_of(const SubImpact* fine) const {
    return in_coarse_.of[static_cast<std::size_t>(fine - fine_.sub_impacts.data())];
  }
  double limit(double fine, double coarse) const { return fine + (fine - coarse) / share_; }
  // Nothing if either of the meshes has no such total.
  std::optional<double> total(RunTotal name) const {
    const std::optional<double> fine = total_in(fine_, name), coarse = total_in(coarse_, name);
    return fine && coarse ? std::optional(limit(*fine, *coarse)) : std::nullopt;
  }

 private:
  // With totals, for which a run must be judged by some other one.
  static Result judged(const Case& input) {
    Result run = simulate(input);
    const RunBeside itself{{input, ErrorSource::time, "itself", 1.0}, run};
    judge(input, run, {&itself, 1});
    return run;
  }
  static std::optional<double> total_in(const Result& run, RunTotal name) {
    if (!run.error_estimate) return std::nullopt;
    const auto& totals = run.error_estimate->totals;
    const auto found = std::ranges::find(totals, name, &NamedTotal::name);
    return found == totals.end() ? std::nullopt : std::optional(found->total.value);
  }
  static int count_within(const Result& run, const SubImpact& s) {
    const auto overlaps = [&](const SubImpact& other) {
      return other.start < s.end.value_or(HUGE_VAL) && s.start < other.end.value_or(HUGE_VAL);
    };
    return static_cast<int>(std::ranges::count_if(run.sub_impacts, overlaps));
  }

  double share_;
  Result coarse_, fine_;
  Counterparts in_coarse_;
};

void judge_sub_impact(const Truth& truth, const Result& run, std::size_t i, const SubImpact* fine,
                      Findings& outcome) {
  const SubImpact& here = run.sub_impacts[i];
  const std::optional<int> n_there = truth.contacts_within(here);
  const SubImpact* coarse = fine ? truth.coarse_of(fine) : nullptr;
  if (!n_there || (fine && !coarse)) return;  // the finer meshes do not agree
  ++outcome.judged;
  if (!fine || *n_there > 1) {
    ++outcome.wrong;
    outcome.details +=
        fmt::format("\n    wrong: {} from {:.3f} us, {} there", i + 1, us * here.start, *n_there);
    return;
  }
  const auto add = [&](Coverage& coverage, double value, double in_fine, double in_coarse,
                       const std::optional<double>& stated, const char* what) {
    if (!stated) return;
    const double error = std::abs(value - truth.limit(in_fine, in_coarse));
    coverage.add(error, *stated);
    if (error > *stated) {
      outcome.details +=
          fmt::format("\n    {} of {}: off by {:.2g}, stated {:.2g}", what, i + 1, error, *stated);
    }
  };
  if (i > 0) add(outcome.times, here.start, fine->start, coarse->start, here.start_error, "start");
  if (!here.end || !fine->end || !coarse->end) return;
  add(outcome.times, *here.end, *fine->end, *coarse->end, here.end_error, "end");
  add(outcome.forces, here.peak_force, fine->peak_force, coarse->peak_force, here.peak_force_error,
      "force");
  add(outcome.impulses, here.impulse, fine->impulse, coarse->impulse, here.impulse_error,
      "impulse");
  add(outcome.velocities, here.striker_velocity, fine->striker_velocity, coarse->striker_velocity,
      here.striker_velocity_error, "velocity");
}

// Whether contacts follow the end of a scene, up to three times as late, on a finer mesh.
void judge_end(const DrawnScene& scene, const Result& run, Findings& outcome) {
  Case longer = scene.finer[scene.finer.size() - 2];
  longer.end_time *= 3.0;
  const Result later = simulate(longer);
  const std::vector<SubImpact>& all = later.sub_impacts;
  const bool goes_on = all.empty() || all.back().end.value_or(HUGE_VAL) > scene.input.end_time;
  outcome.over += !goes_on;
  outcome.said_over += !goes_on && run.contact_over;
  outcome.wrongly_over += goes_on && run.contact_over;
  if (goes_on && run.contact_over) outcome.details += "\n    wrong: contact is not over";
}

Findings study(const DrawnScene& scene, const Result& run) {
  const Truth truth(scene);
  Findings outcome;
  outcome.contacts = static_cast<int>(run.sub_impacts.size());
  if (!run.error_estimate) return outcome;
  outcome.certain = static_cast<int>(*run.n_certain());
  const Counterparts in_fine = counterparts(run.sub_impacts, truth.fine().sub_impacts);
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    if (*run.sub_impacts[i].certain) judge_sub_impact(truth, run, i, in_fine.of[i], outcome);
  }
  if (run.all_certain() && truth.counts_agree()) {
    ++outcome.certain_sets;
    outcome.lacking_sets += truth.fine().sub_impacts.size() != run.sub_impacts.size();
  }
  for (const auto& [name, total] : run.error_estimate->totals) {
    if (total.error && total.value != 0.0) {
      outcome.widths[name].push_back(*total.error / std::abs(total.value));
    }
    const std::optional<double> limit = truth.total(name);
    if (limit && total.error) {
      outcome.totals[name].add(std::abs(total.value - *limit), *total.error);
    }
  }
  return outcome;
}

Findings study(const DrawnScene& scene) {
  const Result run = simulate_judged(scene.input, cases_beside(scene.input), 1);
  Findings outcome = study(scene, run);
  judge_end(scene, run, outcome);
  return outcome;
}

// A case as the program runs it, beside 13001 and 26001 cells.
Findings study_strike(const std::string& path, const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  const LoadedCase loaded = read_case_file(path, overrides);
  DrawnScene scene{loaded.value, {}};
  for (const int cells : {13001, 26001}) {
    Case& finer = scene.finer.emplace_back(loaded.value);
    finer.accuracy = {};
    finer.model.mesh = MeshKind::cells;
    finer.model.segments = cells;
    finer.solver.method = Method::central_difference;
  }
  return study(scene, run_as_asked(loaded.value, loaded.given, {}).result);
}

// A hammer at velocities from 2 to 4 m/s: what the program's own choice calls certain, beside twice
// as many elements.
void study_hammer(const std::string& path, int n_velocities) {
  const LoadedCase loaded = read_case_file(path);
  int n_certain = 0, n_over = 0;
  std::vector<double> lacking;
  std::mutex mutex;
  in_parallel(static_cast<std::size_t>(n_velocities), 0, [&](std::size_t i) {
    Case input = loaded.value;
    input.scene.striker.velocity = 2.0 + 2.0 * static_cast<double>(i) / (n_velocities - 1);
    RunRequest request;
    request.jobs = 1;
    const WithinRun asked = run_as_asked(input, loaded.given, std::move(request));
    const Result& run = asked.result;
    Case finer = input;
    finer.model.mesh = MeshKind::spectral;
    finer.model.elements = 2 * asked.input.model.elements;
    finer.model.section = SectionKind::elastic;
    finer.solver.method = Method::exponential;
    finer.solver.rtol = 1e-10;
    const std::size_t n_there = simulate(finer).sub_impacts.size();
    const std::lock_guard lock(mutex);
    n_certain += run.all_certain();
    n_over += run.contact_over;
    if (run.all_certain() && run.sub_impacts.size() != n_there) {
      lacking.push_back(input.scene.striker.velocity);
    }
  });
  fmt::print(
      "{} velocities: {} sets called certain, {} of these not those of twice as many elements; "
      "contact "
      "called over in {}\n",
      n_velocities, n_certain, lacking.size(), n_over);
  for (const double velocity : lacking) fmt::print("  not at {} m/s\n", velocity);
}

void print(const Findings& all, int n_scenes) {
  fmt::print("\n| what | figure |\n|---|---|\n");
  fmt::print("| scenes, contacts | {}, {} |\n", n_scenes, all.contacts);
  fmt::print("| called certain | {} |\n", all.certain);
  fmt::print("| share in the median scene of at most {} contacts | {:.0f} % |\n", chatter,
             100.0 * median(all.shares));
  fmt::print("| of those on which finer meshes agree, exist one to one | {} of {} ({:.2f} %) |\n",
             all.judged - all.wrong, all.judged,
             100.0 * (all.judged - all.wrong) / std::max(all.judged, 1));
  fmt::print("| sets called certain, of these lacking or inventing one | {}, {} |\n",
             all.certain_sets, all.lacking_sets);
  fmt::print("| contact is over, called so, wrongly | {}, {}, {} |\n", all.over, all.said_over,
             all.wrongly_over);
  fmt::print("\n| errors of | covered | median stated/true | median stated/value |\n");
  fmt::print("|---|---|---|---|\n");
  fmt::print(
      "| times | {} | |\n| peak forces | {} | |\n| impulses | {} | |\n"
      "| striker velocities | {} | |\n",
      all.times.text(), all.forces.text(), all.impulses.text(), all.velocities.text());
  for (const auto& [name, coverage] : all.totals) {
    fmt::print("| total `{}` | {} | {:.2g} % |\n", to_string(name), coverage.text(),
               100.0 * median(all.widths.at(name)));
  }
}

int run_program(int argc, char** argv) {
  CLI::App app("What runs call certain beside what finer meshes have, on random scenes.");
  std::uint64_t seed = 16;
  int n_scenes = 300, first = 0;
  std::string hammer;
  bool verbose = false, prints_case = false;
  strikes::Budget budget{3.0};
  strikes::Kind kind{.hard = true, .fewest = 2, .most = 60};
  app.add_option("--seed", seed, "of the scenes");
  app.add_option("--scenes", n_scenes, "how many");
  app.add_option("--first", first, "number of the first");
  app.add_flag("--shear", kind.shears, "all beams of Timoshenko's theory");
  app.add_flag("--verbose", verbose, "print what is not covered");
  app.add_option("--budget", budget.seconds, "seconds that the finest run of a scene may take");
  app.add_flag("--case", prints_case, "print the case file of the first and run nothing");
  app.add_option("--hammer", hammer, "this case at --scenes velocities instead of scenes");
  std::vector<std::string> costs;
  app.add_option("--cost", costs, "what these cases and three elastic scenes cost");
  std::string strike;
  std::vector<std::string> settings;
  app.add_option("--strike", strike, "this case as the program runs it, instead of scenes");
  app.add_option("--set", settings, "with these settings of its case file")->needs("--strike");
  CLI11_PARSE(app, argc, argv);
  if (!costs.empty()) {
    judgement::study_cost(costs);
    return 0;
  }
  if (!hammer.empty()) {
    study_hammer(hammer, n_scenes);
    return 0;
  }
  if (!strike.empty()) {
    const Findings found = study_strike(strike, settings);
    print(found, 1);
    fmt::print("{}\n", found.details);
    return 0;
  }
  if (prints_case) {
    fmt::print("{}", case_file_text(strikes::draw(seed, first, budget, kind).input));
    return 0;
  }
  Findings all;
  int n_studied = 0;
  std::mutex mutex;
  in_parallel(static_cast<std::size_t>(n_scenes), 0, [&](std::size_t i) {
    const int number = first + static_cast<int>(i);
    const Findings outcome = study(strikes::draw(seed, number, budget, kind));
    const std::lock_guard lock(mutex);
    all.add(outcome);
    ++n_studied;
    if (verbose && !outcome.details.empty()) {
      fmt::print("scene {}{}\n", number, outcome.details);
      std::fflush(stdout);
    }
  });
  print(all, n_studied);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& failure) {
    fmt::print(stderr, "subimpact_judgement: {}\n", failure.what());
    return 2;
  }
}
