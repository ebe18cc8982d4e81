// Wishes for event times on random scenes: whether every time before the stated horizon is within
// the wish, how far the horizon reaches, and what all runs together cost beside the cheapest
// setting that would have done.
//
//   subimpact_within [--seed S] [--scenes N] [--budget seconds] [--work-limit W]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "case/problem.h"
#include "error_bars/scenes.h"
#include "numerics/richardson.h"
#include "study/parallel.h"
#include "subimpact/study/match.h"
#include "subimpact/study/mesh_error_bars.h"
#include "subimpact/study/within.h"

namespace {

using namespace subimpact;

constexpr double us = 1e6;
constexpr double wishes[] = {10e-6, 1e-6, 0.1e-6, 0.01e-6};
// Errors of the reference itself, over the wish, up to which it can judge.
constexpr double reference_share = 0.3;

// Event times in the limit of fine meshes, and how far each is known.
struct Reference {
  std::vector<SubImpact> sub_impacts;
  std::vector<double> uncertainty;  // s
};

double larger_difference(const SubImpact& a, const SubImpact& b) {
  const double start = std::abs(a.start - b.start);
  return a.end && b.end ? std::max(start, std::abs(*a.end - *b.end)) : start;
}

// From meshes two and four times as fine as the finest that was chosen; of elements, twice.
Reference reference_of(const Case& finest, const Result& here, bool yields) {
  const Result doubled = simulate_with_companion(on_other_mesh(finest, 2.0)->input, 1);
  Reference reference;
  const Result* best = &doubled;
  std::optional<Result> fourfold;
  if (yields) {
    fourfold = simulate_with_companion(on_other_mesh(finest, 4.0)->input, 1);
    best = &*fourfold;
  }
  const Result& below = yields ? doubled : here;
  reference.sub_impacts = best->sub_impacts;
  const std::size_t n =
      std::min(best->error_estimate->first_unresolved.value_or(best->sub_impacts.size()),
               n_leading_matches(match_sub_impacts(best->sub_impacts, below.sub_impacts)));
  const double order = yields ? 2.0 : 4.0;
  for (std::size_t i = 0; i < n; ++i) {
    SubImpact& s = reference.sub_impacts[i];
    const SubImpact& coarse = below.sub_impacts[i];
    reference.uncertainty.push_back(larger_difference(s, coarse) / (std::pow(2.0, order) - 1.0));
    if (i > 0) s.start = richardson_limit(coarse.start, s.start, 2.0, order);
    if (s.end && coarse.end) s.end = richardson_limit(*coarse.end, *s.end, 2.0, order);
  }
  return reference;
}

// Leading sub-impacts that the reference knows well enough to judge a wish.
std::size_t n_judged(const Reference& reference, double wish) {
  std::size_t n = 0;
  while (n < reference.uncertainty.size() && reference.uncertainty[n] <= reference_share * wish)
    ++n;
  return n;
}

// Largest error of the leading `n` sub-impacts; infinite if one is missing.
double error_of(const std::vector<SubImpact>& run, const Reference& reference, std::size_t n) {
  if (n_leading_matches(match_sub_impacts(reference.sub_impacts, run)) < n) return INFINITY;
  double error = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    error = std::max(error, larger_difference(run[i], reference.sub_impacts[i]));
  }
  return error;
}

std::size_t n_before(const std::vector<SubImpact>& all, double horizon) {
  return static_cast<std::size_t>(
      std::count_if(all.begin(), all.end(), [&](const SubImpact& s) { return s.start < horizon; }));
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
};

struct JudgedScene {
  int number = 0;
  bool yields = false;
  Case input;
  std::vector<Wished> wished;
};

// The run of one setting of a sequence.
struct SequenceRun {
  double work = 0.0;
  std::vector<SubImpact> sub_impacts;
};

std::vector<SequenceRun> sequence_of(const Case& finest, double end_time) {
  std::vector<SequenceRun> runs;
  for (double factor = 1.5; mesh_count(finest) * factor > 24; factor /= std::sqrt(2.0)) {
    auto sized = on_other_mesh(finest, factor);
    if (!sized) break;
    sized->input.end_time = end_time;
    const Result result = simulate(sized->input);
    runs.push_back({counted_work(result), result.sub_impacts});
  }
  return runs;  // fine to coarse
}

// The coarsest setting that meets the wish together with all finer ones.
double cheapest_work(const std::vector<SequenceRun>& runs, const Reference& reference,
                     std::size_t n, double wish) {
  double work = 0.0;
  for (const SequenceRun& run : runs) {
    if (!(error_of(run.sub_impacts, reference, n) <= wish)) break;
    work = run.work;
  }
  return work;
}

JudgedScene judge(int number, std::uint64_t seed, const error_bars::Budget& budget,
                  double work_limit) {
  JudgedScene scene;
  scene.number = number;
  scene.input = error_bars::draw(seed, number, budget).input;
  const SectionKind section = scene.input.model.section;
  const int layers = scene.input.model.layers;
  scene.input.model = {};
  scene.input.model.section = section;
  scene.input.model.layers = layers;
  scene.input.solver = {};
  scene.input.accuracy.work_limit = work_limit;
  for (const double wish : wishes) {
    Wished wished;
    wished.wish = wish;
    scene.input.accuracy.event_times = wish;
    WithinOptions options;
    options.finished = [&](const Result& result) { wished.work += counted_work(result); };
    wished.run = simulate_within(scene.input, {}, options);
    scene.wished.push_back(std::move(wished));
  }
  const WithinRun& finest =
      std::max_element(scene.wished.begin(), scene.wished.end(),
                       [](const Wished& a, const Wished& b) {
                         return mesh_count(a.run.input) < mesh_count(b.run.input);
                       })
          ->run;
  scene.yields = finest.input.model.mesh == MeshKind::cells;
  Reference reference;
  try {
    reference = reference_of(finest.input, finest.result, scene.yields);
  } catch (const InvalidCase&) {  // no finer mesh is allowed: nothing can be judged
  }
  const std::vector<SequenceRun> runs = sequence_of(finest.input, scene.input.end_time);
  for (Wished& wished : scene.wished) {
    const auto& all = wished.run.result.sub_impacts;
    wished.n = n_before(all, wished.run.result.wish->horizon);
    wished.n_possible = n_judged(reference, wished.wish);
    wished.n_known = std::min(wished.n, wished.n_possible);
    wished.error = error_of(all, reference, wished.n_known);
    if (wished.n_known > 0) {
      wished.cheapest = cheapest_work(runs, reference, wished.n_known, wished.wish);
    }
  }
  return scene;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int report(const std::vector<JudgedScene>& scenes) {
  fmt::print(
      "| scene | beam | wish, us | chosen | sub-impacts | before horizon | judged | largest "
      "error, us | work over cheapest | why not all "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::size_t events = 0, misses = 0, wrong = 0, far = 0, requests = 0;
  std::vector<double> ratios;
  for (const JudgedScene& scene : scenes) {
    for (const Wished& wished : scene.wished) {
      const Result& result = wished.run.result;
      const double ratio = wished.cheapest > 0.0 ? wished.work / wished.cheapest : 0.0;
      ++requests;
      if (ratio > 0.0) ratios.push_back(ratio);
      events += 2 * wished.n_known;
      if (std::isinf(wished.error)) {
        ++wrong;
      } else if (wished.error > wished.wish) {
        ++misses;
      }
      if (wished.n >= wished.n_possible || !result.wish->reason.empty()) ++far;
      fmt::print("| {} | {} | {:g} | {} {} | {} | {} | {} | {:.3g} | {:.2f} | {} |\n", scene.number,
                 scene.yields ? "yields" : "elastic", us * wished.wish,
                 mesh_count(wished.run.input), scene.yields ? "cells" : "elements",
                 result.sub_impacts.size(), wished.n, wished.n_known, us * wished.error, ratio,
                 result.wish->reason);
    }
  }
  fmt::print(
      "\n{} requests on {} scenes; {} event times judged: {} requests with an error above "
      "the wish, {} with a wrong count; horizon as far as the reference decides, or the "
      "reason named: {}; work of all runs over the cheapest setting, median: {:.2f}\n",
      requests, scenes.size(), events, misses, wrong, far, median(ratios));
  return misses + wrong > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Wishes for event times on random scenes");
  std::uint64_t seed = 2026;
  int n_scenes = 20;
  double budget = 1.0;
  double work_limit = 1e8;
  program.add_option("--seed", seed);
  program.add_option("--scenes", n_scenes);
  program.add_option("--budget", budget, "Seconds of a run of four times as many cells");
  program.add_option("--work-limit", work_limit, "accuracy.work_limit of every request");
  CLI11_PARSE(program, argc, argv);
  std::vector<JudgedScene> scenes(static_cast<std::size_t>(n_scenes));
  in_parallel(scenes.size(), [&](std::size_t i) {
    scenes[i] = judge(static_cast<int>(i), seed, {budget}, work_limit);
    fmt::print(stderr, "scene {} done\n", i);
  });
  return report(scenes);
}
