#include "subimpact/report/plan_chart.h"

#include <fmt/format.h>

#include "report/gnuplot.h"

namespace subimpact {

void draw_plan(const std::filesystem::path& directory, const Plan& plan) {
  constexpr double us = 1e6;  // per second
  if (plan.points.empty()) return;
  draw_figure(directory, "plan",
              figure_script("plan", fmt::format("wanted_us = {}\nreference_us = {}\n",
                                                us * plan.wanted, us * plan.reference_error)),
              {960, 560});
}

}  // namespace subimpact
