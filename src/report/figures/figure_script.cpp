#include "report/figures/figure_script.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "io/records/run_tables.h"

namespace subimpact {
namespace {

constexpr double line_tolerance = 0.15;  // pixels
constexpr int mark_height = 26;          // pixels

double distance_from_segment(Point p, Point a, Point b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double length_squared = dx * dx + dy * dy;
  double share = 0.0;  // of the segment, up to the point nearest to p
  if (length_squared > 0.0) {
    share = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length_squared, 0.0, 1.0);
  }
  return std::hypot(p.x - (a.x + share * dx), p.y - (a.y + share * dy));
}

// Indices of the first and last point and of the smallest and largest coordinates, in order.
std::set<std::size_t> extremes(const std::vector<Point>& line) {
  std::set<std::size_t> found{0, line.size() - 1};
  for (double Point::*coordinate : {&Point::x, &Point::y}) {
    const auto [low, high] = std::ranges::minmax_element(line, {}, coordinate);
    for (const auto& extreme : {low, high}) {
      found.insert(static_cast<std::size_t>(extreme - line.begin()));
    }
  }
  return found;
}

// The points that a panel shows; all of them if it would show none.
std::vector<Point> shown_points(const std::vector<Point>& points,
                                const std::optional<AxisRange>& x_range) {
  if (!x_range) return points;
  std::vector<Point> shown = points;
  std::erase_if(shown, [&](const Point& p) { return p.x < x_range->from || p.x > x_range->to; });
  return shown.empty() ? points : shown;
}

double extent(const std::vector<Point>& points, double Point::*coordinate) {
  const auto [low, high] = std::ranges::minmax_element(points, {}, coordinate);
  return (*high).*coordinate - (*low).*coordinate;
}

}  // namespace

std::vector<Point> thin_out(const std::vector<Point>& line, double x_scale, double y_scale,
                            double tolerance) {
  if (line.size() < 3) return line;
  const auto scaled = [&](std::size_t i) {
    return Point{line[i].x / x_scale, line[i].y / y_scale};
  };
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  std::set<std::size_t> kept = extremes(line);
  for (auto at = kept.begin(); std::next(at) != kept.end(); ++at) {
    spans.push_back({*at, *std::next(at)});
  }
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double largest = tolerance;
    std::size_t furthest = first;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double distance = distance_from_segment(scaled(i), scaled(first), scaled(last));
      if (distance <= largest) continue;
      largest = distance;
      furthest = i;
    }
    if (furthest == first) continue;
    kept.insert(furthest);
    spans.push_back({first, furthest});
    spans.push_back({furthest, last});
  }
  std::vector<Point> thinned;
  for (const std::size_t i : kept) thinned.push_back(line[i]);
  return thinned;
}

std::vector<Point> thin_for_panel(const std::vector<Point>& line, FigureSize panel,
                                  const std::optional<AxisRange>& x_range) {
  if (line.empty()) return line;
  const std::vector<Point> shown = shown_points(line, x_range);
  const double x_extent = x_range ? x_range->to - x_range->from : extent(shown, &Point::x);
  const double x_scale = x_extent / panel.width;
  const double y_scale = extent(shown, &Point::y) / panel.height;
  return thin_out(line, x_scale > 0.0 ? x_scale : 1.0, y_scale > 0.0 ? y_scale : 1.0,
                  line_tolerance);
}

FigureSize FigureScript::size() const {
  return {panels.width, panels.height + mark_height * static_cast<int>(marks.size())};
}

std::string FigureScript::text(const std::filesystem::path& scripts) const {
  // A newline between marks, as gnuplot writes it within double quotes.
  const std::string above =
      marks.empty() ? "" : fmt::format("{{/:Bold {}}}", fmt::join(marks, "}\\n{/:Bold "));
  return fmt::format(
      "# {}\n{}", caption,
      figure_script(name,
                    settings + fmt::format("panels = {:#.6g}\nmarks = \"{}\"\n",
                                           1.0 * panels.height / size().height, above),
                    scripts));
}

FigureScript& FigureScript::set(const std::string& variable, double value) {
  // "8.000000": never an integer; gnuplot has a NaN, but no infinity.
  settings += std::isfinite(value) ? fmt::format("{} = {:#.7g}\n", variable, value)
                                   : fmt::format("{} = NaN\n", variable);
  return *this;
}

void FigureScript::table(const std::string& name, const std::string& columns,
                         const NumberRows& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "${} << EOD\n{}\n", name, columns);
  for (const std::vector<double>& row : rows) {
    fmt::format_to(out, "{:.7g}\n", fmt::join(row, ","));
  }
  // A table without rows is an error to gnuplot; this row draws nothing.
  if (rows.empty()) {
    const auto n = 1 + std::count(columns.begin(), columns.end(), ',');
    fmt::format_to(out, "{}\n",
                   fmt::join(std::vector<const char*>(static_cast<std::size_t>(n), "NaN"), ","));
  }
  settings += fmt::to_string(text) + "EOD\n";
}

void FigureScript::line(const std::string& name, const std::vector<Point>& points, FigureSize panel,
                        const std::optional<AxisRange>& x_range) {
  NumberRows rows;
  for (const Point& p : thin_for_panel(points, panel, x_range)) rows.push_back({p.x, p.y});
  table(name, "x,y", rows);
}

void FigureScript::history(std::initializer_list<const char*> columns,
                           const std::vector<HistoryRow>& rows, FigureSize panel) {
  for (const char* name : columns) {
    const auto column =
        std::ranges::find(run_table<HistoryRow>().columns, name, &Column<HistoryRow>::name);
    line(name, line_of(rows, &HistoryRow::time, column->member), panel);
  }
}

}  // namespace subimpact
