#include "study/mesh_limits.h"

#include <algorithm>
#include <cmath>

#include "numerics/richardson.h"
#include "subimpact/study/match.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

constexpr double order_uncertainty = 0.35;  // of the ratio of differences for an order

}  // namespace

void set_mesh_limits(const Case& input, Result& run, std::span<const RunBeside> beside) {
  if (beside.size() < 3 || !mesh_order(input)) return;
  const double order = *mesh_order(input), h = 1.0 / mesh_count(input);
  const double middle_h = 1.0 / mesh_count(beside[1].of.input);
  const double expected =
      ratio_of_differences(1.0 / mesh_count(beside[2].of.input), middle_h, h, order);
  const auto limit = [&](double coarse, double middle, double fine) -> std::optional<double> {
    const double found = (coarse - middle) / (middle - fine);
    if (!(std::abs(found / expected - 1.0) <= order_uncertainty)) return std::nullopt;
    return richardson_limit(middle, fine, middle_h / h, order);
  };
  const Counterparts in_middle = counterparts(run.sub_impacts, beside[1].result.sub_impacts);
  const Counterparts in_coarse = counterparts(run.sub_impacts, beside[2].result.sub_impacts);
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& here = run.sub_impacts[i];
    const SubImpact* middle = in_middle.of[i];
    const SubImpact* coarse = in_coarse.of[i];
    if (!middle || !coarse) continue;
    if (i > 0) here.start_mesh_limit = limit(coarse->start, middle->start, here.start);
    if (here.end && middle->end && coarse->end) {
      here.end_mesh_limit = limit(*coarse->end, *middle->end, *here.end);
    }
    if (!here.start_mesh_limit && !here.end_mesh_limit) continue;
    const double of_start = std::abs(here.start_mesh_limit.value_or(here.start) - here.start);
    const double of_end =
        here.end ? std::abs(here.end_mesh_limit.value_or(*here.end) - *here.end) : 0.0;
    here.mesh_limit_error = std::max({here.error_time.value_or(0.0), of_start, of_end});
  }
}

}  // namespace subimpact
