#include "subimpact/report/studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "case/case_choices.h"
#include "case/counted.h"
#include "io/csv_columns.h"
#include "io/write_file.h"
#include "report/gnuplot.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

constexpr double us = 1e6;  // per second

// One character a cell of the map.
char letter(Verdict verdict) {
  using V = Verdict;
  constexpr std::pair<Verdict, char> letters[] = {
      {V::right, '+'},  {V::wrong_count, 'w'}, {V::inaccurate, 'i'}, {V::unstable, 'U'},
      {V::failed, 'F'}, {V::refused, 'r'},     {V::not_run, '.'}};
  return std::ranges::find(letters, verdict, &std::pair<Verdict, char>::first)->second;
}

// Writes <name>.csv and draws it by figures/<name>.gp.
template <class Row>
void write_study(const fs::path& directory, const std::string& name, const Columns<Row>& columns,
                 const std::vector<Row>& rows, FigureSize size) {
  write_file(directory / (name + ".csv"), csv_text(columns, rows));
  draw_figure(directory, name, figure_script(name), size);
}

// A point of the chart of work against precision.
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

void draw_costs(const fs::path& directory, const std::string& name,
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

// --- critical steps ------------------------------------------------------------------------------

std::string critical_step_table(const std::vector<CriticalStep>& rows) {
  std::string text =
      fmt::format("{:<22} {:<16} {:>6} {:>9} {:>13} {:>13} {:>10}\n", "method", "theory", "cells",
                  "omega h", "predicted, us", "measured, us", "difference");
  for (const CriticalStep& row : rows) {
    text += fmt::format("{:<22} {:<16} {:>6} {:>9.4f} {:>13.6g} {:>13.6g} {:>8.2f} %\n", row.method,
                        name_of(row.theory), row.segments, row.limit, row.predicted * us,
                        row.measured * us, 100.0 * (row.measured / row.predicted - 1.0));
  }
  std::string method;
  for (const CriticalStep& row : rows) {
    if (row.method == method) continue;
    method = row.method;
    for (const Resonance& range : resonances(method)) {
      text +=
          fmt::format("{}: grows for omega h from {:.4f} to {:.4f} too, by up to {:.1e} per step\n",
                      method, range.from, range.to, range.growth - 1.0);
    }
  }
  return text;
}

void write_critical_steps(const fs::path& directory, const std::vector<CriticalStep>& rows) {
  write_study<CriticalStep>(
      directory, "critical_steps",
      {{"method", &CriticalStep::method},
       {"theory", [](const CriticalStep& row) { return std::string(name_of(row.theory)); }},
       {"segments", &CriticalStep::segments},
       {"highest_frequency_rad_per_s", &CriticalStep::highest_frequency},
       {"limit_omega_h", &CriticalStep::limit},
       {"predicted_s", &CriticalStep::predicted},
       {"measured_s", &CriticalStep::measured}},
      rows, {1180, 560});
}

// --- stiff contact -------------------------------------------------------------------------------

std::string stiff_contact_table(const std::vector<StiffContact>& rows) {
  std::string text = fmt::format("{:>14} {:>14} {:>14} {:>14} {:>10}\n", "spring, N/m",
                                 "beam only, us", "predicted, us", "measured, us", "difference");
  for (const StiffContact& row : rows) {
    text += fmt::format("{:>14.4g} {:>14.6g} {:>14.6g} {:>14.6g} {:>8.2f} %\n", row.stiffness,
                        row.beam_only * us, row.predicted * us, row.measured * us,
                        100.0 * (row.measured / row.predicted - 1.0));
  }
  return text;
}

void write_stiff_contact(const fs::path& directory, const std::vector<StiffContact>& rows) {
  write_study<StiffContact>(directory, "stiff_contact",
                            {{"stiffness_N_per_m", &StiffContact::stiffness},
                             {"beam_only_s", &StiffContact::beam_only},
                             {"predicted_s", &StiffContact::predicted},
                             {"measured_s", &StiffContact::measured}},
                            rows, {760, 500});
}

// --- damping of implicit methods -----------------------------------------------------------------

std::string damping_table(const std::vector<Damping>& rows) {
  std::string text = fmt::format("{:<22} {:>12} {:>12} {:>12} {:>22}\n{:<22} {:>61}\n",
                                 "share of the amplitude", "omega h = 1", "10", "100",
                                 "largest difference", "left by one step", "measured - predicted");
  for (auto first = rows.begin(); first != rows.end();) {
    const std::string& method = first->method;
    const auto end =
        std::find_if(first, rows.end(), [&](const Damping& row) { return row.method != method; });
    double at[3] = {0.0, 0.0, 0.0};
    double largest = 0.0;
    for (; first != end; ++first) {
      largest = std::max(largest, std::abs(first->measured - first->predicted));
      for (int i = 0; i < 3; ++i) {
        if (std::abs(first->angle / std::pow(10.0, i) - 1.0) < 1e-9) at[i] = first->measured;
      }
    }
    text += fmt::format("{:<22} {:>12.5f} {:>12.5f} {:>12.5f} {:>22.1e}\n", method, at[0], at[1],
                        at[2], largest);
  }
  return text;
}

void write_damping(const fs::path& directory, const std::vector<Damping>& rows,
                   const std::vector<MultistepGrowth>& growths) {
  const Columns<MultistepGrowth> growth = {{"order", &MultistepGrowth::order},
                                           {"omega_h", &MultistepGrowth::angle},
                                           {"growth", &MultistepGrowth::growth}};
  write_file(directory / "bdf_growth.csv", csv_text(growth, growths));
  write_study<Damping>(directory, "damping",
                       {{"method", &Damping::method},
                        {"omega_h", &Damping::angle},
                        {"predicted", &Damping::predicted},
                        {"measured", &Damping::measured}},
                       rows, {1150, 520});
}

// --- map of outcomes -----------------------------------------------------------------------------

std::string outcome_table(const OutcomeMap& map) {
  std::string text = fmt::format(
      "reference: {}; {} up to {:.3f} us\n"
      "+ right   w wrong count   i inaccurate   U unstable   F solver failed   r refused   . left "
      "out\n",
      map.reference.description, counted(map.reference.sub_impacts.size(), "sub-impact"),
      map.reference.horizon * us);
  std::string group, row;
  for (const OutcomePoint& point : map.points) {
    if (point.group != group) {
      if (!group.empty()) text += "\n";
      group = point.group;
      row.clear();
      text += fmt::format("\n{:<28}", group == "tolerance" ? "rtol" : "omega_max h");
      for (const OutcomePoint& other : map.points) {
        if (other.group == group && other.row == point.row) text += fmt::format(" {:>6g}", other.x);
      }
    }
    if (point.row != row) {
      row = point.row;
      text += fmt::format("\n{:<28}", row);
    }
    text += fmt::format(" {:>6}", letter(point.verdict));
  }
  return text + "\n";
}

void write_outcomes(const fs::path& directory, const OutcomeMap& map) {
  const auto if_completed = [](const OutcomePoint& point, double value) {
    const bool completed = point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
    return completed ? std::optional(value) : std::nullopt;
  };
  using P = OutcomePoint;
  write_study<P>(directory, "outcomes",
                 {{"group", &P::group},
                  {"row", &P::row},
                  {"omega_h_or_rtol", &P::x},
                  {"verdict", [](const P& p) { return p.verdict; }},
                  {"reference_sub_impacts", [](const P& p) { return p.errors.n_reference; }},
                  {"sub_impacts", [](const P& p) { return p.errors.n_found; }},
                  {"corresponding", [](const P& p) { return p.errors.n_corresponding; }},
                  {"median_error_s", [=](const P& p) { return if_completed(p, p.errors.median); }},
                  {"max_error_s", [=](const P& p) { return if_completed(p, p.errors.maximum); }},
                  {"energy_error", [=](const P& p) { return if_completed(p, p.energy_error); }},
                  {"message", &P::message}},
                 map.points, {1400, 560});
}

// --- sub-impacts within one step -----------------------------------------------------------------

std::string missed_pairs_table(const std::vector<MissedPairs>& rows) {
  if (rows.empty()) return {};
  std::string text =
      fmt::format("{}; shortest sub-impact or separation {:.3g} us\n{:>9} {:>28} {:>28}\n",
                  counted(rows.front().n_runs, "strike"), rows.front().shortest * us, "step, us",
                  "all found, pairs looked for", "all found, ends of steps only");
  for (const MissedPairs& row : rows) {
    text += fmt::format("{:>9.3g} {:>28} {:>28}\n", row.step * us, row.right_with_search,
                        row.right_without);
  }
  return text;
}

void write_missed_pairs(const fs::path& directory, const std::vector<MissedPairs>& rows) {
  write_study<MissedPairs>(directory, "missed_pairs",
                           {{"step_s", &MissedPairs::step},
                            {"runs", &MissedPairs::n_runs},
                            {"right_with_search", &MissedPairs::right_with_search},
                            {"right_without", &MissedPairs::right_without},
                            {"shortest_s", &MissedPairs::shortest}},
                           rows, {760, 500});
}

// --- layers --------------------------------------------------------------------------------------

std::string layer_table(const LayerStudy& study) {
  std::string text = fmt::format("{:>7} {:>11} {:>12} {:>14} {:>12}  \n{:>7} {:>11}\n", "layers",
                                 "sub-impacts", "correspond", "median, us", "largest, us", "exact",
                                 study.exact.sub_impacts.size());
  for (const LayerPoint& point : study.points) {
    text += fmt::format("{:>7} {:>11} {:>12} {:>14.3e} {:>12.3e}  {}\n", point.layers,
                        point.errors.n_found, point.errors.n_corresponding,
                        point.errors.median * us, point.errors.maximum * us,
                        point.errors.unmatched ? point.errors.unmatched->description : "");
  }
  return text;
}

void write_layers(const fs::path& directory, const LayerStudy& study) {
  using P = LayerPoint;
  write_study<P>(directory, "layers",
                 {{"layers", &P::layers},
                  {"sub_impacts", [](const P& p) { return p.errors.n_found; }},
                  {"exact_sub_impacts", [](const P& p) { return p.errors.n_reference; }},
                  {"corresponding", [](const P& p) { return p.errors.n_corresponding; }},
                  {"median_difference_s", [](const P& p) { return p.errors.median; }},
                  {"max_difference_s", [](const P& p) { return p.errors.maximum; }}},
                 study.points, {760, 500});
}

// --- plans, and work against precision -----------------------------------------------------------

void draw_plan(const fs::path& directory, const Plan& plan) {
  if (plan.points.empty()) return;
  draw_figure(directory, "plan",
              figure_script("plan", fmt::format("wanted_us = {}\nreference_us = {}\n",
                                                us * plan.wanted, us * plan.reference_error)),
              {960, 560});
}

void draw_work_precision(const fs::path& directory, const std::vector<WorkPrecision>& studies) {
  draw_costs(directory, "work_precision", studies, "wall time (ms)",
             [](const WorkPrecisionPoint& point) { return 1e3 * point.seconds; });
  draw_costs(directory, "work_precision_evaluations", studies, "evaluations of the right-hand side",
             [](const WorkPrecisionPoint& point) {
               return static_cast<double>(point.work.right_hand_sides);
             });
}

}  // namespace subimpact
