#include <atomic>

#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/study/stability.h"

namespace subimpact {
namespace {

constexpr double reference_error = 1e-10;  // s
constexpr double tolerance = 1e-10;
constexpr int layer_counts[] = {10, 20, 40, 80, 160, 320, 640};

}  // namespace

LayerStudy layers_against_exact(const Case& input, const Count& progress) {
  LayerStudy study;
  Case exact = input;
  exact.model.section = SectionKind::exact;
  study.exact = compute_reference(exact, reference_error);
  for (const int layers : layer_counts) study.points.push_back({layers, {}});
  std::atomic<std::size_t> done{0};
  in_parallel(study.points.size(), [&](std::size_t i) {
    Case trial = with_method(study.exact.input, "nystrom");
    trial.solver.rtol = tolerance;
    trial.model.section = SectionKind::layers;
    trial.model.layers = study.points[i].layers;
    study.points[i].errors = event_errors(simulate(trial), study.exact);
    if (progress) progress(++done, study.points.size());
  });
  return study;
}

}  // namespace subimpact
