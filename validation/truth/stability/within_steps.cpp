#include "stability/within_steps.h"

#include <algorithm>

#include "study/method_choice.h"
#include "study/parallel.h"

namespace subimpact {
namespace {

constexpr double reference_error = 1e-10;  // s
constexpr double steps_us[] = {0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
constexpr int n_speeds = 40;
constexpr double tolerance_of_layers = 1e-10;
constexpr int layer_counts[] = {10, 20, 40, 80, 160, 320, 640};

double shortest_of(const std::vector<SubImpact>& sub_impacts, double shortest) {
  for (std::size_t i = 0; i < sub_impacts.size(); ++i) {
    for (const LengthBeside& beside : lengths_beside(sub_impacts, i)) {
      shortest = std::min(shortest, beside.length);
    }
  }
  return shortest;
}

}  // namespace

std::vector<MissedPairs> missed_pairs(const Case& input) {
  std::vector<MissedPairs> rows;
  for (const double step : steps_us) rows.push_back({1e-6 * step, 0, 0, 0, input.end_time});
  std::vector<std::vector<MissedPairs>> of_speed(n_speeds);
  const auto run_speed = [&](std::size_t k) {
    of_speed[k] = rows;
    Case scene = with_method(input, "exponential");
    scene.model.section = SectionKind::elastic;
    scene.scene.striker.velocity *= 0.5 + static_cast<double>(k) / (n_speeds - 1);
    const Reference reference = compute_reference(scene, reference_error, {}, 1);
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
  };
  in_parallel(n_speeds, 0, run_speed);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::vector<MissedPairs>& speed : of_speed) {
      ++rows[i].n_runs;
      rows[i].right_with_search += speed[i].right_with_search;
      rows[i].right_without += speed[i].right_without;
      rows[i].shortest = std::min(rows[i].shortest, speed[i].shortest);
    }
  }
  return rows;
}

LayerStudy layers_against_exact(const Case& input) {
  LayerStudy study;
  Case exact = input;
  exact.model.section = SectionKind::exact;
  study.exact = compute_reference(exact, reference_error);
  study.points.resize(std::size(layer_counts));
  const auto run_layers = [&](std::size_t i) {
    Case trial = with_method(study.exact.input, "nystrom");
    trial.solver.rtol = tolerance_of_layers;
    trial.model.section = SectionKind::layers;
    trial.model.layers = layer_counts[i];
    study.points[i] = {layer_counts[i], event_errors(simulate(trial), study.exact)};
  };
  in_parallel(study.points.size(), 0, run_layers);
  return study;
}

}  // namespace subimpact
