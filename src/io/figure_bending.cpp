// Moment against curvature of the sections whose bending was kept.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/figure_script.h"

namespace subimpact {
namespace {

constexpr std::size_t most_panels = 4;

std::vector<Point> loop(const Result& result, std::size_t section, std::size_t n_sections,
                        double x_unit, double y_unit) {
  std::vector<Point> line;
  for (std::size_t i = section; i < result.section_history.size(); i += n_sections) {
    const SectionRow& row = result.section_history[i];
    line.push_back({row.curvature / x_unit, -row.moment / y_unit});
  }
  return line;
}

}  // namespace

FigureScript bending_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = std::isfinite(beam.yield_stress);
  const std::size_t n = input.output.sections.size();
  const std::size_t shown = std::min(n, most_panels);
  const std::size_t n_columns = shown > 1 ? 2 : 1;
  const std::size_t n_rows = (shown + n_columns - 1) / n_columns;
  FigureScript figure(
      "bending",
      fmt::format("Bending moment against curvature of {} over the whole run{}. Dots: end of the "
                  "run.",
                  shown == 1 ? "a section" : "sections", yields ? ", in units of first yield" : ""),
      {800, n_rows == 1 ? 420 : 720});
  const double x_unit = yields ? beam.yield_curvature() : 1.0;
  const double y_unit = yields ? beam.yield_moment() : 1.0;
  for (std::size_t k = 0; k < shown; ++k) {
    const auto column = static_cast<double>(k % n_columns);
    const auto row = static_cast<double>(k / n_columns);
    const double width = 1.0 / static_cast<double>(n_columns);
    const double height = 1.0 / static_cast<double>(n_rows);
    const double edge = n_rows == 1 ? 0.09 : 0.055;
    const Box box{width * column + 0.1, width * (column + 1.0) - 0.025,
                  1.0 - height * (row + 1.0) + 1.9 * edge, 1.0 - height * row - edge};
    const std::vector<Point> line = loop(result, k, n, x_unit, y_unit);
    const std::string data = figure.line(line, box);
    const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    const std::string last = figure.points({line.back()});
    figure.place(box);
    figure << fmt::format("set title 'x = {:.3g} l' offset 0, -0.5\nset xtics {}\n",
                          result.section_history[k].position / beam.length,
                          tic_spacing(high->x - low->x, 5))
           << (yields ? "set xlabel 'curvature, κ/κ_y'\nset ylabel 'moment, -M/M_y' offset 0.5\n"
                      : "set xlabel 'curvature, 1/m'\nset ylabel 'moment, N m' offset 1\n")
           << "set offsets graph 0.05, graph 0.05, graph 0.08, graph 0.08\n"
              "set xzeroaxis lc rgb '#808080'\nset yzeroaxis lc rgb '#808080'\n"
           << fmt::format(
                  "plot {} with lines lc {} lw 1.2 notitle, {} with points lc rgb '#000000' "
                  "pt 7 notitle\n",
                  data, k + 1, last);
  }
  return figure;
}

}  // namespace subimpact
