#include "report/stability_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/gnuplot.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr int n_colours = 8;

template <class Row, class Wanted, class Line>
std::string block(const std::string& name, const std::vector<Row>& rows, Wanted wanted, Line line) {
  std::string text = "$" + name + " << EOD\n";
  for (const Row& row : rows) {
    if (wanted(row)) text += line(row) + "\n";
  }
  return text + "EOD\n";
}

template <class Row, class Key>
auto distinct(const std::vector<Row>& rows, Key key) {
  std::vector<decltype(key(rows.front()))> keys;
  for (const Row& row : rows) {
    if (std::find(keys.begin(), keys.end(), key(row)) == keys.end()) keys.push_back(key(row));
  }
  return keys;
}

std::string line_type(std::size_t i) {
  return fmt::format("lt {} dt {}", i % n_colours + 1, i / n_colours + 1);
}

}  // namespace

std::string critical_step_figure(const std::vector<CriticalStep>& rows) {
  std::string text = figure_style();
  const auto methods = distinct(rows, [](const CriticalStep& row) { return row.method; });
  text +=
      "set multiplot layout 1,2 margins 0.1,0.79,0.13,0.92 spacing 0.08\nset logscale xy\nset "
      "xlabel 'cells'\nset format y '%g'\nset xtics (101,201,401,801)\nset key at screen 0.8,0.92 "
      "left top Left reverse samplen 1.5 spacing 1.2\nset xrange [80:1000]\n";
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const bool first = theory == BeamTheory::rayleigh;
    std::string plot = "plot ";
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::string name = fmt::format("d{}{}", first ? "r" : "e", m);
      text += block(
          name, rows,
          [&](const CriticalStep& row) { return row.method == methods[m] && row.theory == theory; },
          [](const CriticalStep& row) {
            return fmt::format("{} {:.6g} {:.6g}", row.segments, row.predicted * us,
                               row.measured * us);
          });
      plot += fmt::format("${} u 1:2 w lines {} notitle, ${} u 1:3 w points {} pt 7 {}{}", name,
                          line_type(m), name, line_type(m),
                          first ? "notitle" : "title '" + methods[m] + "'",
                          m + 1 < methods.size() ? ", " : "\n");
    }
    text += fmt::format("set title '{}'\nset ylabel '{}'\n",
                        first ? "Rayleigh: lines predicted, points measured"
                              : "Euler-Bernoulli (no rotary inertia)",
                        first ? "largest stable step (us)" : "");
    text += plot;
  }
  return text + "unset multiplot\n";
}

std::string stiff_contact_figure(const std::vector<StiffContact>& rows) {
  std::string text = figure_style();
  text += block(
      "d", rows, [](const StiffContact&) { return true; },
      [](const StiffContact& row) {
        return fmt::format("{:.6g} {:.6g} {:.6g} {:.6g}", row.stiffness, row.beam_only * us,
                           row.predicted * us, row.measured * us);
      });
  return text +
         "set logscale xy\nset xlabel 'contact stiffness (N/m)'\nset ylabel 'largest stable step "
         "(us)'\nset format x '10^{%L}'\nset format y '%g'\nset key bottom "
         "left\nplot $d u 1:2 w lines lt 7 dt 2 title 'beam alone', $d u 1:3 w lines lt 1 title "
         "'beam, contact and striker: predicted', $d u 1:4 w points lt 2 pt 7 title 'measured'\n";
}

std::string damping_figure(const std::vector<Damping>& rows,
                           const std::vector<MultistepGrowth>& growths) {
  std::string text = figure_style();
  const auto methods = distinct(rows, [](const Damping& row) { return row.method; });
  text +=
      "set multiplot layout 1,2 margins 0.085,0.985,0.14,0.91 spacing 0.09\nset logscale x\nset "
      "xlabel '{/Symbol w} h'\nset format x '%g'\n";
  std::string plot = "plot ";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    text += block(
        fmt::format("d{}", m), rows, [&](const Damping& row) { return row.method == methods[m]; },
        [](const Damping& row) {
          return fmt::format("{:.6g} {:.6g} {:.6g}", row.angle, row.predicted, row.measured);
        });
    plot += fmt::format(
        "$d{} u 1:2 w lines {} title '{}', $d{} u 1:3 w points {} pt 7 ps 0.6 "
        "notitle{}",
        m, line_type(m), methods[m].substr(methods[m].find(':') + 1), m, line_type(m),
        m + 1 < methods.size() ? ", " : "\n");
  }
  text +=
      "set title 'implicit tables: lines predicted, points measured'\nset ylabel 'amplitude left "
      "by "
      "one step'\nset yrange [0:1.05]\nset xrange [0.1:100]\nset key bottom left samplen 2 "
      "spacing 0.9\n" +
      plot;
  plot = "plot 1 w lines lt rgb '#808080' dt 2 notitle, ";
  for (int order = 1; order <= 5; ++order) {
    text += block(
        fmt::format("b{}", order), growths,
        [&](const MultistepGrowth& row) { return row.order == order; },
        [](const MultistepGrowth& row) {
          return fmt::format("{:.6g} {:.6g}", row.angle, row.growth);
        });
    plot += fmt::format("$b{} u 1:2 w lines lt {} title 'order {}'{}", order, order, order,
                        order < 5 ? ", " : "\n");
  }
  return text +
         "set title 'BDF: above 1 an oscillation grows'\nset ylabel 'growth a "
         "step'\nset yrange [0.7:1.15]\nset key top right\n" +
         plot + "unset multiplot\n";
}

std::string outcome_figure(const OutcomeMap& map) {
  std::string text = figure_style();
  text +=
      "unset grid\nset multiplot layout 1,2 margins 0.19,0.99,0.26,0.93 spacing 0.18\nset style "
      "fill solid 1 noborder\nset border 0\nset tics scale 0\n";
  struct Look {
    Verdict verdict;
    const char* colour;
    const char* title;
  };
  const Look looks[] = {{Verdict::right, "#009E73", "right"},
                        {Verdict::wrong_count, "#E69F00", "wrong count"},
                        {Verdict::inaccurate, "#CC79A7", "inaccurate"},
                        {Verdict::unstable, "#D55E00", "unstable"},
                        {Verdict::failed, "#7A0019", "solver failed"},
                        {Verdict::refused, "#56B4E9", "refused"},
                        {Verdict::not_run, "#D0D0D0", "left out"}};
  // The key, below both panels.
  for (std::size_t k = 0; k < std::size(looks); ++k) {
    const double x = 0.12 + 0.125 * static_cast<double>(k);
    text += fmt::format(
        "set object {} rect from screen {:.3f},0.02 to screen {:.3f},0.06 fc rgb '{}' fs solid 1 "
        "noborder\nset label {} '{}' at screen {:.3f},0.04 left\n",
        k + 1, x, x + 0.015, looks[k].colour, k + 1, looks[k].title, x + 0.022);
  }
  for (const char* group : {"fixed step", "tolerance"}) {
    std::vector<OutcomePoint> points;
    std::copy_if(map.points.begin(), map.points.end(), std::back_inserter(points),
                 [&](const OutcomePoint& p) { return p.group == group; });
    if (points.empty()) continue;
    const auto rows = distinct(points, [](const OutcomePoint& p) { return p.row; });
    const auto columns = distinct(points, [](const OutcomePoint& p) { return p.x; });
    const auto place = [](const auto& list, const auto& item) {
      return std::find(list.begin(), list.end(), item) - list.begin();
    };
    const bool steps = std::string(group) == "fixed step";
    std::string plot = "plot ";
    for (std::size_t k = 0; k < std::size(looks); ++k) {
      const std::string name = fmt::format("{}{}", steps ? "s" : "t", k);
      std::string data = block(
          name, points, [&](const OutcomePoint& p) { return p.verdict == looks[k].verdict; },
          [&](const OutcomePoint& p) {
            return fmt::format("{} {} 0.46 0.44", place(columns, p.x), place(rows, p.row));
          });
      if (data.find('\n') + 1 == data.find("EOD\n"))
        data.insert(data.find('\n') + 1, "NaN NaN 0 0\n");
      text += data;
      plot += fmt::format("${} u 1:2:3:4 w boxxyerror lc rgb '{}' title '{}'{}", name,
                          looks[k].colour, looks[k].title, k + 1 < std::size(looks) ? ", " : "\n");
    }
    std::string ticks = "set xtics rotate by 45 right (";
    for (std::size_t i = 0; i < columns.size(); ++i) {
      ticks += fmt::format("{}'{:g}' {}", i > 0 ? ", " : "", columns[i], i);
    }
    ticks += ")\nset ytics (";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ticks += fmt::format("{}'{}' {}", i > 0 ? ", " : "", rows[i], i);
    }
    text += ticks + ")\n";
    text += fmt::format("set xrange [-0.6:{}.6]\nset yrange [{}.6:-0.6]\n", columns.size() - 1,
                        rows.size() - 1);
    text += fmt::format("set title '{}'\nset xlabel '{}'\n", steps ? "fixed step" : "error control",
                        steps ? "{/Symbol w}_{max} h" : "relative tolerance");
    text += "unset key\n";
    text += plot;
  }
  return text + "unset multiplot\n";
}

std::string missed_pairs_figure(const std::vector<MissedPairs>& rows) {
  std::string text = figure_style();
  text += block(
      "d", rows, [](const MissedPairs&) { return true; },
      [](const MissedPairs& row) {
        return fmt::format("{:.6g} {} {}", row.step * us, row.right_with_search, row.right_without);
      });
  const double shortest = rows.empty() ? 0.0 : rows.front().shortest * us;
  const int n = rows.empty() ? 0 : rows.front().n_runs;
  return text +
         fmt::format(
             "set logscale x\nset xlabel 'step (us)'\nset ylabel 'strikes (of {}) wholly "
             "found'\nset format x '%g'\nset yrange [0:{}]\nset arrow from "
             "{:.4g}, graph 0 to {:.4g}, graph 1 nohead dt 2 lc rgb '#808080'\nset label "
             "'shortest sub-impact or separation' at {:.4g}, graph 0.97 right rotate by 90 offset "
             "-1,0 tc rgb '#606060'\nset key bottom left\nplot $d u 1:2 w linespoints lt 1 "
             "title 'pairs within a step looked for', $d u 1:3 w linespoints lt 2 title "
             "'ends of steps only'\n",
             n, 1.1 * n, shortest, shortest, shortest);
}

std::string layer_figure(const LayerStudy& study) {
  std::string text = figure_style();
  const auto data = [&](const char* name, bool all) {
    std::string lines = block(
        name, study.points, [&](const LayerPoint& p) { return p.errors.all_correspond() == all; },
        [](const LayerPoint& p) {
          return fmt::format("{} {:.6g} {:.6g}", p.layers, p.errors.overall() * us,
                             p.errors.median * us);
        });
    if (lines.find('\n') + 1 == lines.find("EOD\n"))
      lines.insert(lines.find('\n') + 1, "NaN NaN NaN\n");
    return lines;
  };
  text += data("all", true) + data("odd", false);
  const LayerPoint& last = study.points.back();
  return text +
         fmt::format(
             "set logscale xy\nset xlabel 'layers'\nset ylabel 'event times, layers - exact "
             "(us)'\nset format y '10^{{%L}}'\nset xtics "
             "(10,20,40,80,160,320,640)\nset xrange [8:800]\nset key top right\nplot "
             "{:.6g}*({}./x)**2 w lines lt rgb '#808080' dt 2 title 'falling as 1/layers^2', "
             "$all u 1:2 w points lt 1 pt 7 title 'largest', $odd u 1:2 w points lt 1 pt 6 "
             "title 'largest, some sub-impacts lost or invented', $all u 1:3 w points lt 2 pt "
             "5 title 'median', $odd u 1:3 w points lt 2 pt 4 title 'median of those that "
             "correspond'\n",
             last.errors.maximum * us, last.layers);
}

}  // namespace subimpact
