// Stated errors of event times beside true ones on random scenes, meshes from coarse to fine: how
// many of the errors are covered, and how many counts are wrong without a sign.
//
//   subimpact_error_bars [--seed S] [--scenes N] [--budget seconds] [--shear]
//   subimpact_error_bars --cost [--seed S] [--scenes N] [--budget seconds]    what they cost

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <optional>
#include <string>
#include <vector>

#include "case/problem.h"
#include "error_bars/scenes.h"
#include "numerics/richardson.h"
#include "study/error_part.h"
#include "study/parallel.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/companion.h"
#include "subimpact/study/match.h"
#include "subimpact/study/mesh_error_bars.h"
#include "subimpact/study/within.h"

namespace {

using namespace subimpact;
using error_bars::DrawnScene;

constexpr double us = 1e6;
constexpr double factors[] = {0.2, 0.35, 0.5, 0.7, 1.0, 1.5};
constexpr double shown_factor = 1.0;
constexpr int pairs = 5;

// Smallest and largest order that an extrapolation takes from three meshes.
constexpr double lowest_order = 0.8;
constexpr double highest_order = 3.0;

// Times of a scene as finer meshes have them.
struct Truth {
  std::vector<SubImpact> all;  // of the finest mesh
  std::size_t n_known = 0;     // leading ones on which the finest meshes agree, extrapolated
};

struct Judged {
  int number = 0;
  DrawnScene scene;
  Result run, companion;
  Truth truth;
  double seconds = 0.0;
};

double extrapolated(std::optional<double> t1, double t2, double t3, double order) {
  const double last = t3 - t2;
  if (last == 0.0) return t3;
  if (t1) {
    const double observed = observed_order(*t1, t2, t3, 2.0);
    if (observed >= lowest_order && observed <= highest_order) order = observed;
  }
  return richardson_limit(t2, t3, 2.0, order);
}

Truth truth_of(const DrawnScene& scene, const Result& run) {
  std::vector<Result> runs;
  for (const Case& finer : scene.finer) runs.push_back(simulate(finer));
  const Result& below = runs[runs.size() - 2];
  Result finest = runs.back();
  // Where even the finest two leave a count in doubt, nothing is known.
  set_error_bars(finest, {compare_events(finest, below, "mesh", "", 1.0 / 3.0)});
  Truth truth;
  truth.all = finest.sub_impacts;
  truth.n_known = finest.error_estimate->first_unresolved.value_or(truth.all.size());
  const Result* first = runs.size() > 2 ? &runs.front() : scene.same_mesh ? &run : nullptr;
  const std::size_t n_first =
      first ? n_leading_matches(match_sub_impacts(truth.all, first->sub_impacts)) : 0;
  const auto limit = [&](std::size_t i, auto time) {
    std::optional<double> coarse;
    if (i < n_first) coarse = time(first->sub_impacts[i]);
    return extrapolated(coarse, *time(below.sub_impacts[i]), *time(truth.all[i]), scene.order);
  };
  for (std::size_t i = 0; i < truth.n_known; ++i) {
    const auto start = [](const SubImpact& s) { return std::optional(s.start); };
    const auto end = [](const SubImpact& s) { return s.end; };
    const double limit_of_start = limit(i, start);
    if (truth.all[i].end && below.sub_impacts[i].end) truth.all[i].end = limit(i, end);
    truth.all[i].start = limit_of_start;
  }
  return truth;
}

Case coarser_of(const Case& input) {
  Case coarser = on_other_mesh(input, 0.5)->input;
  coarser.solver.step.reset();
  if (input.solver.method != Method::central_difference) coarser.solver.rtol *= 100.0;
  return coarser;
}

Judged judge(int number, std::uint64_t seed, const error_bars::Budget& budget,
             error_bars::Kind kind) {
  Judged judged;
  judged.number = number;
  judged.scene = error_bars::draw(seed, number, budget, kind);
  const auto start = std::chrono::steady_clock::now();
  judged.run = simulate(judged.scene.input);
  judged.companion = simulate(coarser_of(judged.scene.input));
  judged.truth = truth_of(judged.scene, judged.run);
  judged.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return judged;
}

// Events of one scene, or of several, at one factor.
struct Coverage {
  int known = 0;    // events that the truth has
  int matched = 0;  // of them in sub-impacts that correspond
  int decided = 0;  // of them before the first undecided sub-impact
  int covered = 0;  // of these with a true error below the stated one
  int scenes = 0;
  int wrong_counts = 0;  // scenes with a decided sub-impact that the truth does not have, or not
  std::vector<double> ratios;  // stated over true

  void add(const Coverage& other) {
    known += other.known;
    matched += other.matched;
    decided += other.decided;
    covered += other.covered;
    scenes += other.scenes;
    wrong_counts += other.wrong_counts;
    ratios.insert(ratios.end(), other.ratios.begin(), other.ratios.end());
  }
  double median() const {
    if (ratios.empty()) return 0.0;
    std::vector<double> sorted = ratios;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};

Coverage coverage(const Judged& judged, double factor, std::string* reason = nullptr) {
  Result run = judged.run;
  ErrorPart part = compare_events(run, judged.companion, "mesh", "", factor);
  include_free_ends(part, judged.scene.input, run);
  set_error_bars(run, {part});
  const auto& here = run.sub_impacts;
  const Truth& truth = judged.truth;
  const std::size_t n_decided = run.error_estimate->first_unresolved.value_or(here.size());
  const std::size_t n_matched = n_leading_matches(match_sub_impacts(here, truth.all));
  if (reason) *reason = run.error_estimate->reason;
  Coverage counts;
  counts.scenes = 1;
  counts.wrong_counts = n_matched < std::min(n_decided, truth.n_known);
  for (std::size_t i = 0; i < truth.n_known; ++i) {
    const bool decided = i < n_decided && i < n_matched;
    const auto one = [&](double true_time, double time, double stated) {
      ++counts.known;
      counts.matched += i < n_matched;
      if (!decided) return;
      ++counts.decided;
      const double error = std::abs(time - true_time);
      counts.covered += error <= stated;
      if (error > 0.0) counts.ratios.push_back(stated / error);
    };
    if (i > 0)
      one(truth.all[i].start, decided ? here[i].start : 0.0,
          here.size() > i ? here[i].start_error.value_or(0.0) : 0.0);
    if (truth.all[i].end) {
      one(*truth.all[i].end, decided ? here[i].end.value_or(0.0) : 0.0,
          here.size() > i ? here[i].end_error.value_or(0.0) : 0.0);
    }
  }
  return counts;
}

std::string kind_of(const Case& input) {
  return fmt::format("{}, {}", input.model.mesh == MeshKind::cells ? "cells" : "elements",
                     may_yield(input) ? "yielding" : "elastic");
}

std::string row_of(const Judged& judged) {
  const Case& input = judged.scene.input;
  const auto letter = [](EndSupport end) {
    return end == EndSupport::free ? 'f' : end == EndSupport::pinned ? 'p' : 'c';
  };
  const auto& ends = input.scene.beam.ends;
  std::string reason;
  const Coverage counts = coverage(judged, shown_factor, &reason);
  double largest = 0.0;
  for (const double ratio : counts.ratios) largest = std::max(largest, 1.0 / ratio);
  return fmt::format(
      "{:3} {:18} {:4} {}{} {:15} at {:.2f} {:5.0f} us {:5.1f} s: known {:3} matched {:3} decided "
      "{:3} covered "
      "{:3} "
      "median {:5.1f} worst true/stated {:5.2f}{} {}",
      judged.number, kind_of(input),
      input.model.mesh == MeshKind::cells ? input.model.segments : input.model.elements,
      letter(ends[0]), letter(ends[1]), to_text(*find_case_key("beam.theory")->get(input)),
      input.scene.striker.position, us * input.end_time, judged.seconds, counts.known,
      counts.matched, counts.decided, counts.covered, counts.median(), largest,
      counts.wrong_counts > 0 ? " WRONG COUNT" : "", reason);
}

void print_totals(const std::vector<Judged>& all) {
  fmt::print(
      "\n| runs | factor | scenes | known events | corresponding | decided | covered | median "
      "stated/true | "
      "wrong counts |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& kind :
       {std::string("all"), std::string("cells, elastic"), std::string("cells, yielding"),
        std::string("elements, elastic"), std::string("elements, yielding")}) {
    for (const double factor : factors) {
      Coverage total;
      for (const Judged& judged : all) {
        if (kind != "all" && kind_of(judged.scene.input) != kind) continue;
        total.add(coverage(judged, factor));
      }
      if (total.scenes == 0) continue;
      fmt::print("| {} | {} | {} | {} | {} | {} ({:.0f} %) | {} ({:.1f} %) | {:.1f} | {} |\n", kind,
                 factor, total.scenes, total.known, total.matched, total.decided,
                 100.0 * total.decided / std::max(total.known, 1), total.covered,
                 100.0 * total.covered / std::max(total.decided, 1), total.median(),
                 total.wrong_counts);
    }
  }
}

// What error bars cost, over a run without: the companion's counted work, and wall and processor
// time of alternated pairs on two cores.
struct Cost {
  double work = 1.0, wall = 1.0, processor = 1.0;
};

struct Times {
  double wall = 0.0, processor = 0.0;  // s
};

template <class Task>
Times time_of(Task task) {
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t before = std::clock();
  task();
  const std::clock_t after = std::clock();
  const auto end = std::chrono::steady_clock::now();
  return {std::chrono::duration<double>(end - start).count(),
          static_cast<double>(after - before) / CLOCKS_PER_SEC};
}

double middle(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

Cost cost_of(const Case& input) {
  Cost cost;
  const Result alone = simulate(input);
  if (const auto companion = companion_of(input)) {
    cost.work += counted_work(simulate(companion->input)) / counted_work(alone);
  }
  std::vector<double> wall, processor;
  for (int i = 0; i < pairs; ++i) {
    const Times off = time_of([&] { simulate(input); });
    const Times on = time_of([&] { simulate_with_companion(input, 2); });
    wall.push_back(on.wall / off.wall);
    processor.push_back(on.processor / off.processor);
  }
  cost.wall = middle(wall);
  cost.processor = middle(processor);
  return cost;
}

void print_costs(std::uint64_t seed, int first, int n_scenes, const error_bars::Budget& budget,
                 error_bars::Kind kind) {
  fmt::print(
      "| scene | run | counted work | wall time | processor time |\n|---|---|---|---|---|\n");
  std::vector<double> work, wall, processor;
  const auto row = [](const std::string& scene, const std::string& run, const Cost& cost) {
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} |\n", scene, run, cost.work, cost.wall,
               cost.processor);
    std::fflush(stdout);
  };
  for (int i = first; i < first + n_scenes; ++i) {
    const Case input = error_bars::draw(seed, i, budget, kind).input;
    const Cost cost = cost_of(input);
    row(fmt::format("{}", i), fmt::format("{}, {}", kind_of(input), mesh_count(input)), cost);
    work.push_back(cost.work);
    wall.push_back(cost.wall);
    processor.push_back(cost.processor);
  }
  row("median", "", {middle(work), middle(wall), middle(processor)});
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Stated errors of event times beside true ones, on random scenes.");
  std::uint64_t seed = 15;
  int n_scenes = 50;
  int first = 0;
  error_bars::Budget budget;
  error_bars::Kind kind;
  app.add_option("--seed", seed, "of the scenes");
  app.add_option("--scenes", n_scenes, "how many");
  app.add_option("--first", first, "number of the first");
  app.add_flag("--shear", kind.shears, "all beams of Timoshenko's theory");
  app.add_option("--budget", budget.seconds, "seconds that the finest run of a scene may take");
  bool cost = false;
  app.add_flag("--cost", cost, "what error bars cost, instead of what they cover");
  CLI11_PARSE(app, argc, argv);
  if (cost) {
    print_costs(seed, first, n_scenes, budget, kind);
    return 0;
  }

  std::vector<Judged> all(static_cast<std::size_t>(n_scenes));
  in_parallel(all.size(), [&](std::size_t i) {
    all[i] = judge(first + static_cast<int>(i), seed, budget, kind);
    fmt::print("{}\n", row_of(all[i]));
    std::fflush(stdout);
  });
  print_totals(all);
}
