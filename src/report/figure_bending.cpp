// Moment against curvature of the sections whose bending was kept.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

// Panels side by side and below each other; lengths in pixels.
struct Grid {
  explicit Grid(std::size_t panels)
      : n_panels(panels),
        n_columns(panels > 4 ? 3 : std::min<std::size_t>(panels, 2)),
        n_rows((panels + n_columns - 1) / n_columns) {}

  FigureSize size() const {
    return {n_columns > 2 ? 1100 : 800, n_rows > 1 ? 360 * static_cast<int>(n_rows) : 420};
  }

  // Of the axes of a panel; room is left for tics and titles.
  Box box(std::size_t panel) const {
    const double width = size().width;
    const double height = size().height;
    const double left = width * static_cast<double>(panel % n_columns) / columns();
    const double top = height * (1.0 - static_cast<double>(panel / n_columns) / rows());
    return {(left + 86.0) / width, (left + width / columns() - 20.0) / width,
            (top - height / rows() + 74.0) / height, (top - 39.0) / height};
  }

  std::size_t n_panels, n_columns, n_rows;

 private:
  double columns() const { return static_cast<double>(n_columns); }
  double rows() const { return static_cast<double>(n_rows); }
};

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
  const Grid grid(std::min(n, most_bending_panels));
  FigureScript figure(
      "bending",
      fmt::format("Bending moment against curvature of {} over the whole run{}. Dots: end of the "
                  "run.",
                  grid.n_panels == 1 ? "a section" : "sections",
                  yields ? ", in units of first yield" : ""),
      grid.size());
  if (n > grid.n_panels) {
    figure.mark(
        fmt::format("left out: sections {} to {} of output.sections", grid.n_panels + 1, n));
  }
  const double x_unit = yields ? beam.yield_curvature() : 1.0;
  const double y_unit = yields ? beam.yield_moment() : 1.0;
  for (std::size_t k = 0; k < grid.n_panels; ++k) {
    const Box box = grid.box(k);
    const std::vector<Point> line = loop(result, k, n, x_unit, y_unit);
    const std::string data = figure.line(line, box);
    const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    const std::string last = figure.points({line.back()});
    figure.place(box);
    figure << fmt::format("set title 'x = {:.3g} l' offset 0, -0.5\nset xtics {}\n",
                          result.section_history[k].position / beam.length,
                          tic_spacing(high->x - low->x, 5))
           << (yields ? "set xlabel 'curvature, κ/κ_y'\nset ylabel 'moment, -M/M_y' offset 1\n"
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
