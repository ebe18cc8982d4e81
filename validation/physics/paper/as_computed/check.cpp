// The run of Rong, Yin, Yang and Shen as they computed it: every printed number to its last digit.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "outcome.h"
#include "paper/account.h"
#include "subimpact/case/simulate.h"
#include "subimpact/io/results.h"

namespace subimpact::validation {
namespace {

using Settings = std::vector<std::string>;

constexpr double us = 1e6;
constexpr double ms = 1e3;
constexpr double mm = 1e3;

// The case with other settings; methods with error control choose their own steps.
Result run(Settings settings, bool with_history = false) {
  if (!with_history) settings.insert(settings.begin(), "output.interval=0");
  Case input = case_of("paper/as_computed", settings);
  if (input.solver.method != Method::central_difference) input.solver.step.reset();
  return simulate(input);
}

Result by_method(const std::string& method) {
  return run({"solver.method=" + method, "study.striker_update=central"});
}

// A printed number, met within a unit of its last digit or not.
struct Printed {
  const char* quantity;
  double value;
  double unit;  // of the last printed digit
};

constexpr Printed printed_times[] = {{"first sub-impact lasts, us", 203.0, 1.0},
                                     {"zone 1 ends, ms", 1.757, 0.001},
                                     {"zone 2 begins, ms", 5.178, 0.001},
                                     {"zone 2 ends, the entire strike, ms", 7.031, 0.001},
                                     {"separation of the zones, ms", 3.42, 0.01}};

// In the order of printed_times.
std::vector<double> times_of(const Result& result) {
  const auto zones = summarise_zones(result.sub_impacts);
  const double end = zones.at(0).end.value();
  return {result.sub_impacts.at(0).end.value() * us, end * ms, zones.at(1).start * ms,
          zones.at(1).end.value() * ms, (zones.at(1).start - end) * ms};
}

// Largest difference from the printed times, in units of their last digits.
double largest_difference(const Result& result) {
  const std::vector<double> times = times_of(result);
  double largest = 0.0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    largest =
        std::max(largest, std::abs(times[i] - printed_times[i].value) / printed_times[i].unit);
  }
  return largest;
}

// When the n-th layer from the surface begins to flow at the struck section, s: its middle lies
// (n - 1/2) layers below the surface.
double layer_yield(int n) {
  const Case input = case_of("paper/as_computed",
                             {"output.sections=[0.5]", "output.interval=1e-8", "time.end=2e-5"});
  const Result result = simulate(input);
  const double layers = input.model.layers;
  const double limit = result.used.yield_curvature * layers / (layers + 1.0 - 2.0 * n);
  const auto& rows = result.section_history;
  const auto after = std::find_if(rows.begin(), rows.end(), [&](const SectionRow& row) {
    return std::abs(row.curvature) >= limit;
  });
  if (after == rows.begin() || after == rows.end()) return NAN;
  const auto before = std::prev(after);
  const double share = (limit - std::abs(before->curvature)) /
                       (std::abs(after->curvature) - std::abs(before->curvature));
  return before->time + share * (after->time - before->time);
}

std::string table_of_updates() {
  std::string text =
      "The scheme: central differences with two updates of the striker, and the accurate "
      "solution.\n\n" +
      runs_head();
  const auto add = [&](const std::string& name, const Settings& settings) {
    text += runs_row(name, run(settings));
  };
  add("step 0.1 us, force on the striker constant over a step", {});
  add("step 0.1 us, striker by central differences", {"study.striker_update=central"});
  add("step 0.0999 us, striker by central differences",
      {"study.striker_update=central", "solver.step=9.99e-8"});
  add("nystrom, rtol 1e-11",
      {"solver.method=nystrom", "solver.rtol=1e-11", "study.striker_update=central"});
  return text;
}

std::string table_of_meshes() {
  std::string text =
      "The mesh: the same scheme on neighbours of the paper's mesh. The times of the zones "
      "determine its length.\n\n" +
      runs_head();
  const auto add = [&](const std::string& name, const Settings& settings) {
    text += runs_row(name, run(settings));
  };
  for (const char* spacing : {"points", "cells"}) {
    for (const int segments : {499, 501, 503}) {
      add(fmt::format("{} {}", segments, spacing),
          {fmt::format("model.segments={}", segments), fmt::format("model.spacing={}", spacing)});
    }
  }
  add("501 points, shorter by 0.02 %", {"beam.length=0.71105776"});
  add("501 points, longer by 0.02 %", {"beam.length=0.71134224"});
  return text;
}

// What small changes of the velocity do to the counts.
std::string table_of_velocities() {
  std::string text =
      "The counts: the same run with the velocity changed, six times up and six times down by "
      "equal parts.\n\n| velocity changed by up to | 57 in all | 18 in zone 1 | sub-impacts | "
      "first "
      "separation, us | zone 1 ends, ms | zone 2 begins, ms |\n|---|---|---|---|---|---|---|\n";
  for (const double most : {1e-5, 1e-3}) {
    int n_57 = 0, n_18 = 0;
    std::vector<std::size_t> counts;
    std::vector<std::vector<double>> times(std::size(printed_times));
    for (int i = -6; i <= 6; ++i) {
      if (i == 0) continue;
      const Result result =
          run({fmt::format("striker.velocity={:.17g}", 15.9 * (1.0 + most * i / 6.0))});
      counts.push_back(result.sub_impacts.size());
      n_57 += counts.back() == 57;
      n_18 += summarise_zones(result.sub_impacts).at(0).n_sub_impacts == 18;
      const std::vector<double> found = times_of(result);
      for (std::size_t k = 0; k < found.size(); ++k) times[k].push_back(found[k]);
    }
    const auto range = [](const auto& values) {
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      return std::pair(*low, *high);
    };
    const auto [fewest, most_found] = range(counts);
    const auto [first_low, first_high] = range(times[0]);
    const auto [end_low, end_high] = range(times[1]);
    const auto [start_low, start_high] = range(times[2]);
    text += fmt::format(
        "| {:.0e} | {} of 12 | {} of 12 | {} to {} | {:.2f} to {:.2f} | {:.4f} to {:.4f} | {:.4f} "
        "to "
        "{:.4f} |\n",
        most, n_57, n_18, fewest, most_found, first_low, first_high, end_low, end_high, start_low,
        start_high);
  }
  return text;
}

// How near the contact comes to opening between 202 and 205 us, where the paper's first sub-impact
// ends.
std::string table_of_openings() {
  std::string text =
      "The opening near 203 us (nystrom): how far the indentation stays above the residual one, or "
      "for how long the contact is open.\n\n| mesh | smallest excess, um | force there, N | open "
      "for, us |\n|---|---|---|---|\n";
  const std::pair<const char*, Settings> meshes[] = {
      {"501 cells", {"model.spacing=cells"}},
      {"501 points", {}},
      {"1001 cells", {"model.spacing=cells", "model.segments=1001"}}};
  for (const auto& [name, settings] : meshes) {
    Settings all = settings;
    all.insert(all.end(), {"solver.method=nystrom", "study.striker_update=central",
                           "time.end=2.1e-4", "output.interval=1e-8"});
    const Result result = run(all, true);
    const double residual = result.max_indentation - result.used.yield_indentation;
    double excess = INFINITY, force = 0.0;
    for (const HistoryRow& row : result.history) {
      if (row.time < 200e-6 || row.time > 205e-6) continue;
      if (row.indentation - residual < excess) {
        excess = row.indentation - residual;
        force = row.force;
      }
    }
    const auto& found = result.sub_impacts;
    const bool opens = found.size() > 1;
    text += fmt::format(
        "| {} | {} | {} | {} |\n", name, opens ? "" : fmt::format("{:.3f}", excess * us),
        opens ? "" : fmt::format("{:.1f}", force),
        opens ? fmt::format("{:.2f}", (found[1].start - *found[0].end) * us) : "never");
  }
  return text;
}

}  // namespace

Outcome check_paper_as_computed() {
  Outcome outcome{"Rong, Yin, Yang, Shen", {}, {}};
  const Result ours = run({}, true);
  const auto zones = summarise_zones(ours.sub_impacts);
  const std::vector<double> times = times_of(ours);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Printed& printed = printed_times[i];
    outcome.rows.push_back(
        {printed.quantity, printed.value, times[i], Bound::absolute, printed.unit});
  }
  const auto exactly = [&](const char* quantity, double published, auto found) {
    outcome.rows.push_back({quantity, published, static_cast<double>(found), Bound::absolute, 0.0});
  };
  exactly("sub-impacts", 57.0, ours.sub_impacts.size());
  exactly("sub-impacts in zone 1", 18.0, zones.at(0).n_sub_impacts);
  exactly("sub-impacts in zone 2", 39.0, zones.at(1).n_sub_impacts);
  exactly("zones", 2.0, zones.size());
  exactly("sub-zones in zone 1", 2.0, zones[0].n_subzones);
  outcome.rows.insert(
      outcome.rows.end(),
      {{"indentation at first contact yield, mm (cut to 0.015)", 0.015,
        ours.used.yield_indentation * mm, Bound::absolute, 0.001},
       {"first largest indentation, mm (cut to 0.169)", 0.169,
        ours.sub_impacts[0].max_indentation * mm, Bound::absolute, 0.001},
       {"back stress reaches Y in the layer next to the outermost, us", 9.9, layer_yield(2) * us,
        Bound::absolute, 0.1},
       {"back stress reaches Y in the outermost layer, us", 9.9, layer_yield(1) * us,
        Bound::absolute, 0.1, "the layer next to it meets the paper's 9.9"}});
  add_energies(outcome, ours);

  std::string methods =
      "Every method on the paper's mesh, at rtol 1e-8 or, central differences, at 0.1 us.\n\n" +
      runs_head();
  for (const char* method :
       {"central-difference", "erk", "nystrom", "exponential", "dirk", "adams", "bdf"}) {
    const Result result = by_method(method);
    outcome.rows.push_back({fmt::format("all times by {}: largest difference, in units of the last "
                                        "printed digit",
                                        method),
                            1.0, largest_difference(result), Bound::within, 0.0});
    methods += runs_row(method, result);
  }
  outcome.notes = {methods, table_of_updates(), table_of_meshes(), table_of_velocities(),
                   table_of_openings()};
  return outcome;
}

}  // namespace subimpact::validation
