// Moment against curvature of the sections whose bending was kept.

#include <fmt/format.h>

#include <algorithm>

#include "case/problem.h"
#include "report/figure_script.h"

namespace subimpact {
namespace {

std::vector<Point> loop(const Result& result, std::size_t section, std::size_t n_sections,
                        double x_unit, double y_unit) {
  std::vector<Point> line;
  for (std::size_t i = section; i < result.section_history.size(); i += n_sections) {
    const SectionRow& row = result.section_history[i];
    line.push_back({row.curvature / x_unit, row.moment / y_unit});
  }
  return line;
}

}  // namespace

FigureScript bending_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = may_yield(input);
  const std::size_t n = input.output.sections.size();
  const std::size_t n_panels = std::min(n, most_bending_panels);
  const std::size_t n_columns = n_panels > 4 ? 3 : std::min<std::size_t>(n_panels, 2);
  const std::size_t n_rows = (n_panels + n_columns - 1) / n_columns;
  const FigureSize size{n_columns > 2 ? 1100 : 800,
                        n_rows > 1 ? 360 * static_cast<int>(n_rows) : 420};
  FigureScript figure(
      "bending",
      fmt::format("Bending moment against curvature of {} over the whole run{}. Dots: end of the "
                  "run.",
                  n_panels == 1 ? "a section" : "sections",
                  yields ? ", in units of first yield" : ""),
      size);
  if (n > n_panels) {
    figure.mark(fmt::format("left out: sections {} to {} of output.sections", n_panels + 1, n));
  }
  const double x_unit = yields ? beam.yield_curvature() : 1.0;
  const double y_unit = yields ? beam.yield_moment() : 1.0;
  NumberRows sections, loops, ends;
  for (std::size_t k = 0; k < n_panels; ++k) {
    const double number = static_cast<double>(k + 1);
    const std::vector<Point> line = loop(result, k, n, x_unit, y_unit);
    for (const Point& p : thin_for_panel(line, {300, 300})) loops.push_back({number, p.x, p.y});
    const auto [low, high] = std::minmax_element(
        line.begin(), line.end(), [](const Point& a, const Point& b) { return a.x < b.x; });
    sections.push_back({result.section_history[k].position / beam.length, high->x - low->x});
    ends.push_back({number, line.back().x, line.back().y});
  }
  figure.table("sections", "position,extent", sections);
  figure.table("loops", "section,x,y", loops);
  figure.table("ends", "section,x,y", ends);
  figure.set("n_columns", static_cast<double>(n_columns))
      .set("n_rows", static_cast<double>(n_rows));
  figure.set("width", size.width).set("height", size.height).set("yields", yields);
  return figure;
}

}  // namespace subimpact
