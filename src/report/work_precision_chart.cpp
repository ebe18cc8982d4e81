#include "subimpact/report/work_precision_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/csv_columns.h"
#include "report/gnuplot.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

struct ChartPoint {
  std::size_t panel;  // from 1
  std::string method;
  std::string mark;  // "right", "wrong", "failed"; empty: not shown
  double error;      // us
  double cost;
};

std::string mark_of(Verdict verdict) {
  if (verdict == Verdict::right) return "right";
  if (verdict == Verdict::wrong_count) return "wrong";
  return verdict == Verdict::refused || verdict == Verdict::not_run ? "" : "failed";
}

// An error below a tenth of the reference's cannot be distinguished from none and is shown as that.
double shown_error(const WorkPrecisionPoint& point, const WorkPrecision& study) {
  if (mark_of(point.verdict) == "failed") return std::numeric_limits<double>::quiet_NaN();
  return us * std::max(point.errors.overall(), 0.1 * study.reference.error);
}

void draw(const std::filesystem::path& directory, const std::string& name,
          const std::vector<WorkPrecision>& studies, const char* cost_label,
          double (*cost)(const WorkPrecisionPoint&)) {
  std::vector<ChartPoint> points;
  std::string labels;
  for (std::size_t p = 0; p < studies.size(); ++p) {
    labels += fmt::format("'{}' ", studies[p].label);
    for (const WorkPrecisionPoint& point : studies[p].points) {
      points.push_back({p + 1, point.setting.method, mark_of(point.verdict),
                        shown_error(point, studies[p]), cost(point)});
    }
  }
  std::erase_if(points, [](const ChartPoint& p) { return p.mark.empty() || !(p.cost > 0.0); });
  const Columns<ChartPoint> columns = {{"panel", &ChartPoint::panel},
                                       {"method", &ChartPoint::method},
                                       {"mark", &ChartPoint::mark},
                                       {"error_us", &ChartPoint::error},
                                       {"cost", &ChartPoint::cost}};
  const FigureSize size{static_cast<int>(120 + 400 * studies.size() + 250), 560};
  draw_figure(directory, name,
              figure_script("work_precision",
                            fmt::format("labels = \"{}\"\ncost_label = '{}'\nwidth = {}\n"
                                        "$points << EOD\n{}EOD\n",
                                        labels, cost_label, size.width, csv_text(columns, points))),
              size);
}

}  // namespace

void draw_work_precision(const std::filesystem::path& directory,
                         const std::vector<WorkPrecision>& studies) {
  draw(directory, "work_precision", studies, "wall time (ms)",
       [](const WorkPrecisionPoint& point) { return 1e3 * point.seconds; });
  draw(directory, "work_precision_evaluations", studies, "evaluations of the right-hand side",
       [](const WorkPrecisionPoint& point) {
         return static_cast<double>(point.work.right_hand_sides);
       });
}

}  // namespace subimpact
