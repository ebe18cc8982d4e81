// Tolerances on event times, on random scenes: whether every time before the stated horizon is
// within it, how far the horizon reaches, and what all runs together cost compared with the
// cheapest setting that would have sufficed.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "study/parallel.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"
#include "within/judging.h"

namespace subimpact::wishes {
namespace {

constexpr double us = 1e6;
constexpr double wishes[] = {10e-6, 1e-6, 0.1e-6, 0.01e-6};

std::size_t n_before(const std::vector<SubImpact>& all, double horizon) {
  return static_cast<std::size_t>(
      std::ranges::count_if(all, [&](const SubImpact& s) { return s.start < horizon; }));
}

struct Wished {
  double wish = 0.0;
  WithinRun run;
  double work = 0.0;           // counted, of all runs
  std::size_t n = 0;           // sub-impacts before the horizon
  std::size_t n_known = 0;     // of these that the reference knows well enough
  std::size_t n_possible = 0;  // that the reference knows well enough, in all
  double error = 0.0;          // s, true one, of these
  double cheapest = 0.0;       // counted work of the cheapest setting; 0: none found
  std::string trace;           // all runs
};

struct JudgedScene {
  int number = 0;
  bool yields = false;
  std::vector<Wished> wished;
};

Wished run_wish(Case input, double wish) {
  Wished wished;
  wished.wish = wish;
  input.accuracy.event_times = wish;
  WithinOptions options;
  options.announce = [&](const std::string& what) { wished.trace += "\n  " + what + ":"; };
  options.finished = [&](const Case& run, const Result& result) {
    const double work = counted_work(run, result);
    wished.work += work;
    wished.trace += fmt::format(" {:.2e}", work);
  };
  wished.run = simulate_within(input, {}, options);
  return wished;
}

void judge(Wished& wished, const Reference& reference, const std::vector<SequenceRun>& runs) {
  const auto& all = wished.run.result.sub_impacts;
  wished.n = n_before(all, wished.run.result.tolerance->horizon);
  wished.n_possible = n_judged(reference, wished.wish);
  wished.n_known = std::min(wished.n, wished.n_possible);
  wished.error = error_of(all, reference, wished.n_known);
  if (wished.n_known > 0 && wished.n_known == wished.n) {
    wished.cheapest = cheapest_work(runs, reference, wished.n_known, wished.wish);
  }
}

JudgedScene judge(int number, const WishStudy& study) {
  JudgedScene scene;
  scene.number = number;
  const Case input = open_scene(study.seed, number, study.budget, study.work_limit);
  for (const double wish : wishes) scene.wished.push_back(run_wish(input, wish));
  const auto count = [](const Wished& wished) { return mesh_count(wished.run.input); };
  const WithinRun& finest = std::ranges::max_element(scene.wished, {}, count)->run;
  scene.yields = finest.input.model.mesh == MeshKind::cells;
  const Reference reference = reference_of(finest.input, scene.yields ? 4.0 : 2.0);
  const std::vector<SequenceRun> runs = sequence_of(finest.input, input.end_time);
  for (Wished& wished : scene.wished) {
    judge(wished, reference, runs);
    if (study.trace) {
      fmt::print(stderr, "scene {} {:g} us, error {:.3g}, {:.1e} over {:.1e}{}\n", number,
                 us * wished.wish, us * wished.error, wished.work, wished.cheapest, wished.trace);
    }
  }
  return scene;
}

void print_row(const JudgedScene& scene, const Wished& wished, double ratio) {
  const Result& result = wished.run.result;
  fmt::print("| {} | {} | {:g} | {} {} | {} | {} | {} | {:.3g} | {} | {} |\n", scene.number,
             scene.yields ? "yields" : "elastic", us * wished.wish, mesh_count(wished.run.input),
             scene.yields ? "cells" : "elements", result.sub_impacts.size(), wished.n,
             wished.n_known, us * wished.error, ratio > 0.0 ? fmt::format("{:.2f}", ratio) : "",
             words_of(result.tolerance->reason));
}

}  // namespace

int study_wishes(const WishStudy& study) {
  std::vector<JudgedScene> scenes(static_cast<std::size_t>(study.n_scenes));
  in_parallel(scenes.size(), study.jobs, [&](std::size_t i) {
    scenes[i] = judge(static_cast<int>(i), study);
    fmt::print(stderr, "scene {} done\n", i);
  });
  fmt::print(
      "| scene | beam | tolerance, us | chosen | sub-impacts | before horizon | judged | largest "
      "error, us | work over cheapest | why not all "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t events = 0, misses = 0, wrong = 0, far = 0, requests = 0, met = 0;
  std::vector<double> ratios, ratios_of_met;
  for (const JudgedScene& scene : scenes) {
    for (const Wished& wished : scene.wished) {
      const ToleranceOutcome& outcome = *wished.run.result.tolerance;
      const double ratio = wished.cheapest > 0.0 ? wished.work / wished.cheapest : 0.0;
      ++requests;
      met += outcome.met;
      if (ratio > 0.0) ratios.push_back(ratio);
      if (ratio > 0.0 && outcome.met) ratios_of_met.push_back(ratio);
      events += 2 * wished.n_known;
      if (std::isinf(wished.error)) {
        ++wrong;
      } else if (wished.error > wished.wish) {
        ++misses;
      }
      if (wished.n >= wished.n_possible || outcome.reason) ++far;
      print_row(scene, wished, ratio);
    }
  }
  fmt::print(
      "\n{} requests on {} scenes, {} met to the end; {} event times judged: {} requests with an "
      "error above the tolerance, {} with a wrong count; horizon as far as the reference decides, "
      "or "
      "the reason named: {}; work of all runs over the cheapest setting, median: {:.2f}, of those "
      "met to the end: {:.2f}\n",
      requests, scenes.size(), met, events, misses, wrong, far, median(ratios),
      median(ratios_of_met));
  return misses + wrong > 0 ? 1 : 0;
}

}  // namespace subimpact::wishes
