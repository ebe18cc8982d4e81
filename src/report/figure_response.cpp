// Force and displacements over the whole strike, and the first sub-impact alone.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr Box upper{0.11, 0.97, 0.56, 0.92};
constexpr Box lower{0.11, 0.97, 0.12, 0.48};

std::string band_entry(const char* what) {
  return fmt::format("keyentry with boxes fillstyle solid noborder linecolor rgb '{}' title '{}'",
                     band_colour, what);
}

void mark_instant(FigureScript& figure, double x, double height, const std::string& text) {
  figure << fmt::format(
      "set arrow from first {0:.6g}, graph 0 to first {0:.6g}, graph 1 nohead dashtype 3 lw 1.5 "
      "lc rgb '#404040'\n"
      "set label '{2}' at first {0:.6g}, graph {1} left offset 0.7, 0\n",
      x, height, text);
}

}  // namespace

FigureScript response_figure(const Case&, const Result& result) {
  FigureScript figure("response",
                      "Contact force and displacements over the strike: w_c of the struck point, "
                      "w_m of the striker, f_c = w_c - w(0) the beam's deflection at the struck "
                      "point. Shaded: sub-impacts.",
                      {800, 580});
  const TimeUnit unit = time_unit(result.outcome.time);
  const Unit newton = force_unit(result.max_force);
  const Unit metre = length_unit(std::max(largest(result, &HistoryRow::struck_displacement),
                                          largest(result, &HistoryRow::striker_displacement)));
  const std::string force =
      figure.line(history_line(result, unit, &HistoryRow::force, newton.factor), upper);
  const auto displacement = [&](double HistoryRow::*member) {
    return figure.line(history_line(result, unit, member, metre.factor), lower);
  };
  const std::string struck = displacement(&HistoryRow::struck_displacement);
  const std::string striker = displacement(&HistoryRow::striker_displacement);
  const std::string deflection = displacement(&HistoryRow::struck_deflection);

  const double end = result.outcome.time * unit.per_second;
  figure << fmt::format("set xrange [0:{:.7g}]\nset xtics {}\n", end, tic_spacing(end, 8));
  figure.shade(sub_impact_bands(result, unit));
  figure.place(upper);
  figure << fmt::format("set ylabel 'contact force, {}' offset 0.5\n", newton.name)
         << "set yrange [0:*]\nset format x ''\n"
            "set offsets 0, 0, graph 0.06, 0\nset key at graph 1, graph 1.16 right top horizontal "
            "maxrows 1 samplen 2.5 width -1\n"
         << fmt::format("plot {} with lines lw 1 notitle, {}\n", force, band_entry("sub-impacts"));
  figure.place(lower);
  figure << fmt::format("set ylabel 'displacement, {}'\n", metre.name)
         << "set yrange [*:*]\nset format x '% h'\n"
         << fmt::format("set xlabel 'time, {}'\n", unit.name)
         << fmt::format(
                "plot {} with lines lw 2.5 lc 1 title 'struck point w_c', {} with lines lc 2 "
                "dashtype 2 title 'striker w_m', {} with lines lc 3 title 'deflection f_c'\n",
                struck, striker, deflection);
  return figure;
}

FigureScript first_sub_impact_figure(const Case& input, const Result& result) {
  FigureScript figure(
      "first-sub-impact",
      "Contact force, and stress in the outermost fibre behind the struck point, in "
      "the first sub-impact (shaded). Broken lines: the yield stress and the "
      "instant at which a fibre of the beam first yields.",
      {800, 580});
  const double end = result.sub_impacts.empty()
                         ? result.outcome.time
                         : result.sub_impacts.front().end.value_or(result.outcome.time);
  const double shown = std::min(1.08 * end, result.outcome.time);
  const TimeUnit unit = time_unit(shown);
  const Unit newton = force_unit(result.max_force);
  const auto within = [&](std::vector<Point> line) {
    std::erase_if(line, [&](const Point& p) { return p.x > shown * unit.per_second; });
    return line;
  };
  const std::string force =
      figure.line(within(history_line(result, unit, &HistoryRow::force, newton.factor)), upper);
  const std::string stress =
      figure.line(within(history_line(result, unit, &HistoryRow::back_stress, 1e-6)), lower);

  figure << fmt::format("set xrange [0:{:.7g}]\nset xtics {}\n", shown * unit.per_second,
                        tic_spacing(shown * unit.per_second, 6));
  figure.shade({{0.0, end * unit.per_second, band_colour}});
  const std::optional<double>& yield = result.first_section_yield;
  const bool yield_shown = yield && *yield < shown;
  if (yield_shown) {
    figure << fmt::format(
        "set arrow 1 from first {0:.6g}, graph 0 to first {0:.6g}, graph 1 nohead dashtype 3 "
        "lw 1.5 lc rgb '#404040'\n",
        *yield * unit.per_second);
  }
  figure.place(upper);
  figure << fmt::format("set ylabel 'contact force, {}' offset 0.5\n", newton.name)
         << "set yrange [0:*]\nset offsets 0, 0, graph 0.06, 0\nset format x ''\n"
         << fmt::format("plot {} with lines notitle\n", force);
  figure.place(lower);
  if (yield_shown) {
    mark_instant(figure, *yield * unit.per_second, 0.07,
                 fmt::format("first fibre yields, {:.3g} {}", *yield * unit.per_second, unit.name));
  }
  figure << "set ylabel 'back stress, MPa'\nset yrange [*:*]\nset offsets 0, 0, graph 0.18, "
            "graph 0.18\nset format x '% h'\n"
         << fmt::format("set xlabel 'time, {}'\n", unit.name);
  std::string plot = fmt::format("plot {} with lines lc 2 notitle", stress);
  const double yield_stress = input.scene.beam.yield_stress * 1e-6;
  // Either bound is shown where the stress comes near it.
  for (const double bound : {yield_stress, -yield_stress}) {
    const bool near =
        std::any_of(result.history.begin(), result.history.end(), [&](const HistoryRow& row) {
          return row.time <= shown && row.back_stress * 1e-6 * bound > 0.5 * bound * bound;
        });
    if (!std::isfinite(bound) || !near) continue;
    plot += fmt::format(", {} with lines lc rgb '#404040' dashtype 2 lw 1 notitle", bound);
    figure << fmt::format(
        "set label 'yield stress, {0:.4g} MPa' at graph 0.98, first {0:.7g} right "
        "offset 0, {1}\n",
        bound, bound > 0.0 ? 0.8 : -0.8);
  }
  figure << plot + "\n";
  return figure;
}

}  // namespace subimpact
