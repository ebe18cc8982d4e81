// Force and displacements over the whole strike, and the first sub-impact alone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr FigureSize panel{690, 210};

}  // namespace

FigureScript response_figure(const Case&, const Result& result) {
  FigureScript figure("response",
                      "Contact force and displacements over the strike: w_c of the struck point, "
                      "w_m of the striker, f_c = w_c − w(0) the beam's deflection at the struck "
                      "point. Shaded: sub-impacts, hatched where they are not decided.",
                      {800, 580});
  const TimeUnit unit = time_unit(result.outcome.time);
  const Unit newton = force_unit(result.max_force);
  const Unit metre = length_unit(std::max(largest(result, &HistoryRow::struck_displacement),
                                          largest(result, &HistoryRow::striker_displacement)));
  const auto line = [&](const char* name, double HistoryRow::*member, double factor) {
    figure.line(name, history_line(result, unit, member, factor), panel);
  };
  line("force", &HistoryRow::force, newton.factor);
  line("struck", &HistoryRow::struck_displacement, metre.factor);
  line("striker", &HistoryRow::striker_displacement, metre.factor);
  line("deflection", &HistoryRow::struck_deflection, metre.factor);
  add_sub_impact_bands(figure, "bands", result, unit);
  figure.set("end", result.outcome.time * unit.per_second).set("time_unit", unit.name);
  figure.set("force_unit", newton.name).set("length_unit", metre.name);
  return figure;
}

FigureScript first_sub_impact_figure(const Case& input, const Result& result) {
  FigureScript figure(
      "first-sub-impact",
      "Contact force, and stress in the outermost fibre behind the struck point, in "
      "the first sub-impact (shaded). Broken lines: the yield stress and the "
      "instant at which a fibre of the beam first yields.",
      {800, 580});
  const double end =
      result.sub_impacts.empty() ? result.outcome.time : result.end_of(result.sub_impacts.front());
  const double shown = std::min(1.08 * end, result.outcome.time);
  const TimeUnit unit = time_unit(shown);
  const Unit newton = force_unit(result.max_force);
  const auto line = [&](const char* name, double HistoryRow::*member, double factor) {
    std::vector<Point> points = history_line(result, unit, member, factor);
    std::erase_if(points, [&](const Point& p) { return p.x > shown * unit.per_second; });
    figure.line(name, points, panel);
  };
  line("force", &HistoryRow::force, newton.factor);
  line("stress", &HistoryRow::back_stress, 1e-6);
  figure.table("bands", "from,to", {{0.0, end * unit.per_second}});
  figure.set("end", shown * unit.per_second).set("time_unit", unit.name);
  figure.set("force_unit", newton.name);
  const std::optional<double>& yield = result.first_section_yield;
  if (yield && *yield < shown) figure.set("yields_at", *yield * unit.per_second);
  std::string bounds;
  const double yield_stress = input.scene.beam.yield_stress * 1e-6;
  // Either bound is shown where the stress comes near it.
  for (const double bound : {yield_stress, -yield_stress}) {
    const bool near =
        std::any_of(result.history.begin(), result.history.end(), [&](const HistoryRow& row) {
          return row.time <= shown && row.back_stress * 1e-6 * bound > 0.5 * bound * bound;
        });
    if (std::isfinite(bound) && near) bounds += fmt::format("{:.4g} ", bound);
  }
  figure.set("bounds", bounds);
  return figure;
}

}  // namespace subimpact
