#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "report/gnuplot.h"
#include "subimpact/report/work_precision_chart.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr int n_colours = 8;
// Of gnuplot: marks that exist filled and hollow.
constexpr int filled_marks[] = {7, 5, 9, 13, 11, 15};
constexpr int hollow_marks[] = {6, 4, 8, 12, 10, 14};
constexpr int n_marks = 6;
constexpr int cross = 2;
// Of the strip at the right edge, as a factor on the error.
constexpr double strip_width = 50.0;

using Cost = std::function<double(const WorkPrecisionPoint&)>;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;

  void include(double value) {
    if (!(value > 0.0)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // To whole decades.
  Range widened() const {
    if (high == 0.0) return {0.1, 10.0};
    return {std::pow(10.0, std::floor(std::log10(low))),
            std::pow(10.0, std::ceil(std::log10(high * 1.0001)))};
  }
};

bool completed(const WorkPrecisionPoint& point) {
  return point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
}

bool broke_down(const WorkPrecisionPoint& point) {
  return point.verdict == Verdict::inaccurate || point.verdict == Verdict::unstable ||
         point.verdict == Verdict::failed;
}

// An error too small to be told from none stands at a tenth of the reference's.
double shown_error(const WorkPrecisionPoint& point, const WorkPrecision& study) {
  return us * std::max(point.errors.overall(), 0.1 * study.reference.error);
}

std::vector<std::string> methods_of(const std::vector<WorkPrecision>& studies) {
  std::vector<std::string> methods;
  for (const WorkPrecision& study : studies) {
    for (const WorkPrecisionPoint& point : study.points) {
      if (std::find(methods.begin(), methods.end(), point.setting.method) == methods.end()) {
        methods.push_back(point.setting.method);
      }
    }
  }
  return methods;
}

std::string block(const std::string& name, const WorkPrecision& study,
                  const std::function<bool(const WorkPrecisionPoint&)>& wanted,
                  const std::function<double(const WorkPrecisionPoint&)>& x, const Cost& y) {
  std::string text = "$" + name + " << EOD\n";
  bool empty = true;
  for (const WorkPrecisionPoint& point : study.points) {
    if (!wanted(point) || !(y(point) > 0.0)) continue;
    text += fmt::format("{:.6g} {:.6g}\n", x(point), y(point));
    empty = false;
  }
  if (empty) text += "NaN NaN\n";
  return text + "EOD\n";
}

class Chart {
 public:
  Chart(const std::vector<WorkPrecision>& studies, const Cost& cost, std::string cost_label)
      : studies_(studies),
        cost_(cost),
        cost_label_(std::move(cost_label)),
        methods_(methods_of(studies)) {
    for (const WorkPrecision& study : studies) {
      for (const WorkPrecisionPoint& point : study.points) {
        if (completed(point)) errors_.include(shown_error(point, study));
        if (completed(point) || broke_down(point)) costs_.include(cost(point));
      }
    }
    errors_ = errors_.widened();
    costs_ = costs_.widened();
    failed_at_ = errors_.high * 3.0;
    errors_.high *= strip_width;
  }

  FigureSize size() const { return {static_cast<int>(120 + 400 * studies_.size() + 250), 560}; }

  std::string script() const {
    std::string text = figure_style();
    for (std::size_t p = 0; p < studies_.size(); ++p) text += panel_data(p);
    const double width = size().width;
    text += "set multiplot\nset logscale xy\nset bmargin screen 0.14\nset tmargin screen 0.9\n";
    text += fmt::format("set xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n", errors_.low,
                        errors_.high, costs_.low, costs_.high);
    text +=
        "set xlabel 'largest error of an event time (us)'\nset format x '10^{%L}'\nset format y "
        "'10^{%L}'\nset mxtics 1\nset mytics 10\n";
    for (std::size_t p = 0; p < studies_.size(); ++p) {
      const double left = (90.0 + 400.0 * static_cast<double>(p)) / width;
      text += fmt::format("set lmargin screen {:.4f}\nset rmargin screen {:.4f}\n", left,
                          left + 350.0 / width);
      text += fmt::format("set title '{}'\n", studies_[p].label);
      text += p == 0 ? fmt::format("set ylabel '{}'\n", cost_label_) : "unset ylabel\n";
      text += panel(p);
    }
    return text + key() + "unset multiplot\n";
  }

 private:
  std::string panel_data(std::size_t p) const {
    std::string text;
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const auto of_method = [&, m](const WorkPrecisionPoint& point) {
        return point.setting.method == methods_[m];
      };
      const auto x = [&, p](const WorkPrecisionPoint& point) {
        return shown_error(point, studies_[p]);
      };
      const auto add = [&](const char* kind, auto condition, auto at) {
        text += block(
            fmt::format("{}_{}_{}", kind, p, m), studies_[p],
            [&](const WorkPrecisionPoint& q) { return of_method(q) && condition(q); }, at, cost_);
      };
      add(
          "line", [](const WorkPrecisionPoint& q) { return completed(q); }, x);
      add(
          "right", [](const WorkPrecisionPoint& q) { return q.verdict == Verdict::right; }, x);
      add(
          "wrong", [](const WorkPrecisionPoint& q) { return q.verdict == Verdict::wrong_count; },
          x);
      add(
          "failed", [](const WorkPrecisionPoint& q) { return broke_down(q); },
          [&](const WorkPrecisionPoint&) { return failed_at_; });
    }
    return text;
  }

  static std::string look(std::size_t m, int mark) {
    return fmt::format("lt {} dt {} pt {} lw 1.5 ps 1.0", m % n_colours + 1,
                       m < n_colours ? "1" : "2", mark);
  }

  std::string panel(std::size_t p) const {
    // The strip at the right edge is for runs that broke down.
    const double strip = errors_.high / strip_width;
    std::string text = fmt::format(
        "unset key\nset object 1 rect from {:g},{:g} to {:g},{:g} fc rgb '#F0F0F0' fs noborder "
        "behind\nset label 1 'failed' at {:g},{:g} center rotate by 90 tc rgb '#606060'\n",
        strip, costs_.low, errors_.high, costs_.high, 18.0 * strip,
        std::sqrt(costs_.low * costs_.high));
    text += "plot ";
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const std::size_t k = m % n_marks;
      text += fmt::format("$line_{}_{} with lines {}, ", p, m, look(m, 1));
      text += fmt::format("$right_{}_{} with points {}, ", p, m, look(m, filled_marks[k]));
      text += fmt::format("$wrong_{}_{} with points {}, ", p, m, look(m, hollow_marks[k]));
      text += fmt::format("$failed_{}_{} with points {}", p, m, look(m, cross));
      text += m + 1 < methods_.size() ? ", \\\n  " : "\n";
    }
    return text;
  }

  std::string key() const {
    const double left = (90.0 + 400.0 * static_cast<double>(studies_.size()) - 20.0) /
                        static_cast<double>(size().width);
    std::string text = fmt::format(
        "unset object 1\nunset label 1\nunset border\nunset tics\nunset xlabel\nunset "
        "ylabel\nunset title\nunset grid\nunset logscale\nset lmargin screen {:.4f}\nset rmargin "
        "screen 0.99\nset xrange [0:1]\nset yrange [0:1]\nset key at graph 0,1 left top Left "
        "reverse samplen 2 spacing 1.25\nplot ",
        left);
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      text += fmt::format("NaN with linespoints {} title '{}', ",
                          look(m, filled_marks[m % n_marks]), methods_[m]);
    }
    return text +
           "NaN with points lt rgb '#404040' pt 7 title 'every sub-impact found', NaN with points "
           "lt rgb '#404040' pt 6 title 'some lost or invented', NaN with points lt rgb '#404040' "
           "pt 2 title 'unstable, or gave up'\n";
  }

  const std::vector<WorkPrecision>& studies_;
  Cost cost_;
  std::string cost_label_;
  std::vector<std::string> methods_;
  Range errors_, costs_;
  double failed_at_ = 0.0;
};

}  // namespace

void draw_work_precision(const std::filesystem::path& directory,
                         const std::vector<WorkPrecision>& studies) {
  const Chart time(
      studies, [](const WorkPrecisionPoint& point) { return 1e3 * point.seconds; },
      "wall time (ms)");
  draw_figure(directory, "work_precision", time.script(), time.size());
  const Chart evaluations(
      studies,
      [](const WorkPrecisionPoint& point) {
        return static_cast<double>(point.work.right_hand_sides);
      },
      "evaluations of the right-hand side");
  draw_figure(directory, "work_precision_evaluations", evaluations.script(), evaluations.size());
}

}  // namespace subimpact
