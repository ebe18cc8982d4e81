// When sub-impacts begin, how long they last and what they give.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr double left_edge = 0.11;
constexpr double right_edge = 0.98;
constexpr double gap = 0.03;  // between columns
constexpr std::size_t most_columns = 4;
constexpr double edge = 0.022;           // of the width, free on either side of a column
constexpr double least_share = 0.15;     // of a column in the width
constexpr double number_spacing = 0.03;  // of the width, between labelled sub-impacts

struct Column {
  double from, to;  // s
  std::string title;
  double left = 0.0, right = 0.0;  // of the figure's width

  double width() const { return right - left; }
  bool holds(const SubImpact& s) const { return s.start >= from && s.start <= to; }
};

// A column per zone, as wide as the zone lasts; one for all where there are many zones.
std::vector<Column> columns_of(const Result& result) {
  std::vector<Column> columns;
  int zone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const double end = result.end_of(s);
    if (s.zone != zone) columns.push_back({s.start, end, fmt::format("zone {}", s.zone)});
    columns.back().to = end;
    zone = s.zone;
  }
  if (columns.empty()) columns.push_back({0.0, result.outcome.time, "no sub-impact"});
  if (columns.size() > most_columns) {
    columns = {
        {columns.front().from, columns.back().to, fmt::format("zones 1 to {}", columns.size())}};
  }
  double total = 0.0;
  for (const Column& column : columns) total += column.to - column.from;
  std::vector<double> shares;
  double sum = 0.0;
  for (const Column& column : columns) {
    shares.push_back(std::max((column.to - column.from) / total, least_share));
    sum += shares.back();
  }
  const double width = right_edge - left_edge - gap * static_cast<double>(columns.size() - 1);
  double at = left_edge;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k].left = at;
    columns[k].right = at + width * shares[k] / sum;
    at = columns[k].right + gap;
  }
  return columns;
}

double duration_us(const SubImpact& s, const Result& result) {
  return 1e6 * (result.end_of(s) - s.start);
}
double impulse_mNs(const SubImpact& s, const Result&) { return 1e3 * s.impulse; }

// Which sub-impacts of a column have room for their number: those `spacing` (s) after the one that
// was numbered before, unless the number would lie on the stem of a taller neighbour.
std::vector<bool> numbered(const Result& result, const Column& column, double spacing,
                           double (*value)(const SubImpact&, const Result&)) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  std::vector<bool> found(all.size(), false);
  double last = -1e300;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!column.holds(all[i]) || all[i].start - last < spacing) continue;
    found[i] = std::none_of(all.begin(), all.end(), [&](const SubImpact& other) {
      return std::abs(other.start - all[i].start) < 0.5 * spacing &&
             value(other, result) > value(all[i], result);
    });
    if (found[i]) last = all[i].start;
  }
  return found;
}

// us, of the start; 0: exact, or not known.
double error_us(const SubImpact& s) { return 1e6 * s.start_error.value_or(0.0); }
double scatter_us(const SubImpact& s) { return 1e6 * s.start_scatter.value_or(0.0); }

std::string caption_text(const Result& result) {
  std::string text =
      "Every sub-impact at the time it begins: duration and impulse, on logarithmic "
      "axes; numbers count the sub-impacts. Pale with open circles: not decided.";
  const auto any = [&](double (*bar)(const SubImpact&)) {
    return std::any_of(result.sub_impacts.begin(), result.sub_impacts.end(),
                       [&](const SubImpact& s) { return bar(s) > 0.0; });
  };
  if (any(error_us)) text += " Black bars: numerical error of the start.";
  if (any(scatter_us)) text += " Purple bars: its standard deviation by the scatter of the case.";
  return text;
}

}  // namespace

FigureScript timeline_figure(const Case&, const Result& result) {
  FigureScript figure("timeline", caption_text(result), {800, 580});
  const TimeUnit unit = time_unit(result.outcome.time);
  const std::vector<Column> columns = columns_of(result);
  NumberRows panels, sub_impacts;
  const std::size_t n_decided = result.n_decided().value_or(result.sub_impacts.size());
  std::string titles;
  for (const Column& column : columns) {
    const double margin = edge * (column.to - column.from) / column.width();
    const double from = (column.from - margin) * unit.per_second;
    const double to = (column.to + margin) * unit.per_second;
    panels.push_back({from, to, column.left, column.right});
    titles += fmt::format("'{}' ", column.title);
    const double spacing = number_spacing / column.width() * (to - from) / unit.per_second;
    const std::vector<bool> durations = numbered(result, column, spacing, duration_us);
    const std::vector<bool> impulses = numbered(result, column, spacing, impulse_mNs);
    for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
      const SubImpact& s = result.sub_impacts[i];
      if (!column.holds(s)) continue;
      sub_impacts.push_back({static_cast<double>(panels.size()), static_cast<double>(i + 1),
                             s.start * unit.per_second, duration_us(s, result),
                             impulse_mNs(s, result), 1.0 * durations[i], 1.0 * impulses[i],
                             i < n_decided ? 1.0 : 0.0, error_us(s), scatter_us(s)});
    }
  }
  figure.table("columns", "from,to,left,right", panels);
  figure.table("sub_impacts",
               "column,number,start,duration_us,impulse_mNs,label_duration_us,label_impulse_mNs,"
               "decided,error_us,scatter_us",
               sub_impacts);
  const std::optional<Predictability>& found = result.predictability;
  const bool ends = found && found->first_unpredictable;
  figure.set("horizon", ends ? found->horizon * unit.per_second : NAN);
  figure.set("titles", titles).set("time_unit", unit.name);
  return figure;
}

}  // namespace subimpact
