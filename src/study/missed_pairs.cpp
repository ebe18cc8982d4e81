#include <algorithm>
#include <atomic>

#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/study/stability.h"

namespace subimpact {
namespace {

constexpr double reference_error = 1e-10;  // s
constexpr double steps_us[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
constexpr int n_speeds = 40;

double shortest_of(const std::vector<SubImpact>& sub_impacts, double shortest) {
  for (std::size_t i = 0; i < sub_impacts.size(); ++i) {
    if (sub_impacts[i].end)
      shortest = std::min(shortest, *sub_impacts[i].end - sub_impacts[i].start);
    if (i > 0) shortest = std::min(shortest, sub_impacts[i].start - *sub_impacts[i - 1].end);
  }
  return shortest;
}

}  // namespace

std::vector<MissedPairs> missed_pairs(const Case& input, const Count& progress) {
  std::vector<MissedPairs> rows;
  for (const double step : steps_us) rows.push_back({1e-6 * step, n_speeds, 0, 0, 0.0});
  std::vector<std::vector<MissedPairs>> of_speed(n_speeds, rows);
  std::atomic<std::size_t> done{0};
  in_parallel(n_speeds, [&](std::size_t k) {
    Case scene = with_method(input, "exponential");
    scene.model.section = SectionKind::elastic;
    scene.scene.striker.velocity *= 0.5 + static_cast<double>(k) / (n_speeds - 1);
    const Reference reference = compute_reference(scene, reference_error);
    scene.end_time = reference.horizon;
    for (MissedPairs& row : of_speed[k]) {
      scene.solver.step = row.step;
      for (const bool search : {true, false}) {
        scene.study.pair_detection = search;
        const Result result = simulate(scene);
        const bool right = judge(result, event_errors(result, reference)) == Verdict::right;
        (search ? row.right_with_search : row.right_without) = right ? 1 : 0;
      }
      row.shortest = shortest_of(reference.sub_impacts, reference.horizon);
    }
    if (progress) progress(++done, n_speeds);
  });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].shortest = input.end_time;
    for (const std::vector<MissedPairs>& speed : of_speed) {
      rows[i].right_with_search += speed[i].right_with_search;
      rows[i].right_without += speed[i].right_without;
      rows[i].shortest = std::min(rows[i].shortest, speed[i].shortest);
    }
  }
  return rows;
}

}  // namespace subimpact
