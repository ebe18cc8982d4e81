// When sub-impacts begin, how long they last and what they give.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr double left = 0.11;
constexpr double right = 0.98;
constexpr double gap = 0.03;  // between columns
constexpr std::size_t most_columns = 4;
constexpr double edge = 0.022;           // of the width, free on either side of a column
constexpr double least_share = 0.15;     // of a column in the width
constexpr double number_spacing = 0.03;  // of the width, between labelled sub-impacts

struct Column {
  double from, to;  // s
  std::string title;
  Box box;  // left and right only
};

// A column a zone, as wide as the zone lasts; one for all where there are many zones.
std::vector<Column> columns_of(const Result& result) {
  std::vector<Column> columns;
  int zone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const double end = s.end.value_or(result.outcome.time);
    if (s.zone != zone) columns.push_back({s.start, end, fmt::format("zone {}", s.zone), {}});
    columns.back().to = end;
    zone = s.zone;
  }
  if (columns.empty()) columns.push_back({0.0, result.outcome.time, "no sub-impact", {}});
  if (columns.size() > most_columns) {
    columns = {{columns.front().from,
                columns.back().to,
                fmt::format("zones 1 to {}", columns.size()),
                {}}};
  }
  double total = 0.0;
  for (const Column& column : columns) total += column.to - column.from;
  std::vector<double> shares;
  double sum = 0.0;
  for (const Column& column : columns) {
    shares.push_back(std::max((column.to - column.from) / total, least_share));
    sum += shares.back();
  }
  const double width = right - left - gap * static_cast<double>(columns.size() - 1);
  double at = left;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k].box.left = at;
    columns[k].box.right = at + width * shares[k] / sum;
    at = columns[k].box.right + gap;
  }
  return columns;
}

// A range for a logarithmic axis: half a decade more than the values take.
std::string log_range(const Result& result, double (*value)(const SubImpact&, const Result&)) {
  double low = 1e300;
  double high = 0.0;
  for (const SubImpact& s : result.sub_impacts) {
    if (!(value(s, result) > 0.0)) continue;
    low = std::min(low, value(s, result));
    high = std::max(high, value(s, result));
  }
  if (high == 0.0) return "[0.1:10]";
  return fmt::format("[{:.6g}:{:.6g}]", low / 2.0, high * 3.0);
}

double duration_us(const SubImpact& s, const Result& result) {
  return 1e6 * (s.end.value_or(result.outcome.time) - s.start);
}
double impulse_mNs(const SubImpact& s, const Result&) { return 1e3 * s.impulse; }

}  // namespace

FigureScript timeline_figure(const Case&, const Result& result) {
  FigureScript figure(
      "timeline",
      "Every sub-impact at the time it begins: duration and impulse, on logarithmic "
      "axes; numbers count the sub-impacts.",
      {800, 560});
  const TimeUnit unit = time_unit(result.outcome.time);
  const std::vector<Column> columns = columns_of(result);
  struct Row {
    const char* label;
    double (*value)(const SubImpact&, const Result&);
    double bottom, top;
    int colour;
  };
  const Row rows[] = {{"duration, µs", duration_us, 0.55, 0.93, 1},
                      {"impulse, mN s", impulse_mNs, 0.12, 0.50, 2}};
  figure << "set logscale y\nset format y '%g'\nunset key\n";
  for (const Row& row : rows) {
    const bool top_row = row.bottom > 0.5;
    figure << fmt::format("set yrange {}\n", log_range(result, row.value))
           << (top_row ? "set format x ''\n" : "set format x '% h'\n");
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const Column& column = columns[k];
      const double margin = edge * (column.to - column.from) / (column.box.right - column.box.left);
      const double from = (column.from - margin) * unit.per_second;
      const double to = (column.to + margin) * unit.per_second;
      std::vector<Point> points;
      double last_label = -1e300;
      // A number would lie on the stem of a taller neighbour.
      const double reach = 0.5 * number_spacing / (column.box.right - column.box.left) *
                           (to - from) / unit.per_second;
      const auto overlooked = [&](std::size_t i) {
        return std::any_of(
            result.sub_impacts.begin(), result.sub_impacts.end(), [&](const SubImpact& other) {
              return std::abs(other.start - result.sub_impacts[i].start) < reach &&
                     row.value(other, result) > row.value(result.sub_impacts[i], result);
            });
      };
      figure << "unset label\n";
      for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
        const SubImpact& s = result.sub_impacts[i];
        if (s.start < column.from || s.start > column.to) continue;
        const double x = s.start * unit.per_second;
        const double y = row.value(s, result);
        points.push_back({x, y});
        const double where =
            column.box.left + (x - from) / (to - from) * (column.box.right - column.box.left);
        if (where - last_label < number_spacing || overlooked(i)) continue;
        last_label = where;
        figure << fmt::format("set label '{}' at {:.7g}, {:.7g} center offset 0, 0.8 font ',11'\n",
                              i + 1, x, y);
      }
      const std::string data = figure.points(points);
      Box box = column.box;
      box.bottom = row.bottom;
      box.top = row.top;
      figure.place(box);
      figure
          << fmt::format("set xrange [{:.7g}:{:.7g}]\nset xtics {}\n", from, to,
                         tic_spacing(to - from, 5))
          << (top_row ? fmt::format("set title '{}' offset 0, -0.5\n", column.title)
                      : std::string("unset title\n"))
          << (k == 0 ? fmt::format("set ylabel '{}'\nset format y '%g'\n", row.label)
                     : std::string("unset ylabel\nset format y ''\n"))
          << (top_row ? std::string("unset xlabel\n")
                      : fmt::format("set xlabel 'start, {}'\n", unit.name))
          << fmt::format(
                 "plot {0} with impulses lc {1} lw 2 notitle, {0} with points lc {1} pt 7 ps 0.8 "
                 "notitle\n",
                 data, row.colour);
    }
  }
  return figure;
}

}  // namespace subimpact
