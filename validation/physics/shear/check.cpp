// Strikes on a beam that shears: event times by two discretisations, and what they cost.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

// Ends and starts by turns, us, without the first start.
std::vector<double> times_of(const Result& result) {
  std::vector<double> times;
  for (const SubImpact& s : result.sub_impacts) {
    if (!times.empty()) times.push_back(1e6 * s.start);
    if (s.end) times.push_back(1e6 * *s.end);
  }
  return times;
}

using Settings = std::vector<std::string>;

std::vector<double> times_by(Settings settings) {
  settings.emplace_back("output.interval=0");
  return times_of(simulate(case_of("shear", settings)));
}

std::string cells(int n) { return fmt::format("model.segments={}", n); }
std::string elements(int n) { return fmt::format("model.elements={}", n); }

// The limit of fine cells, of second order, and the order seen over three meshes.
struct Limit {
  double time, order;
};
Limit limit_of(const std::vector<std::vector<double>>& times, std::size_t i) {
  const double coarse = times[1][i] - times[0][i];
  const double fine = times[2][i] - times[1][i];
  return {times[2][i] + fine / 3.0, std::log2(coarse / fine)};
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

void add_slow_strike(Outcome& outcome) {
  const double published[] = {424.18, 448.00, 503.00, 578.83, 636.60};
  std::vector<std::vector<double>> on_cells;
  for (const int n : {501, 1001, 2001}) on_cells.push_back(times_by({cells(n)}));
  const std::vector<double> on_elements = times_by({elements(100)});
  for (std::size_t i = 0; i < 5; ++i) {
    const auto [limit, order] = limit_of(on_cells, i);
    const std::string name = fmt::format("0.1 m/s, time {}, us: ", i + 1);
    outcome.rows.push_back({name + "limit of cells", published[i], limit, Bound::absolute, 0.05});
    outcome.rows.push_back({name + "order of the cells", 2.0, order, Bound::absolute, 0.3});
    outcome.rows.push_back(
        {name + "spectral elements", published[i], on_elements.at(i), Bound::absolute, 0.05});
    outcome.rows.push_back({name + "spectral elements against the limit of cells", limit,
                            on_elements.at(i), Bound::absolute, 0.005});
  }
}

void add_fast_strikes(Outcome& outcome) {
  const auto first_end = [](Settings settings) {
    settings.insert(settings.end(), {"striker.velocity=15.9", "time.end=0.28e-3"});
    return times_by(settings).at(0);
  };
  for (const bool yields : {false, true}) {
    const std::string section = yields ? "model.section=exact" : "model.section=elastic";
    std::vector<std::vector<double>> times;
    for (const int n : {1001, 2001, 4001}) times.push_back({first_end({cells(n), section})});
    outcome.rows.push_back({fmt::format("15.9 m/s, {} section, end of the first contact, us",
                                        yields ? "yielding" : "elastic"),
                            yields ? 259.0 : 274.7, limit_of(times, 0).time, Bound::absolute,
                            yields ? 0.5 : 0.05});
  }
}

// The elastic strike at 15.9 m/s up to 2 ms.
void add_cost(Outcome& outcome) {
  struct Setting {
    const char* theory;
    int elements, reference;
  };
  std::string note =
      "What 0.1 us costs: the elastic strike at 15.9 m/s up to 2 ms, `exponential` at rtol 1e-6, "
      "all "
      "event times against a finer mesh at rtol 1e-9; the least wall time of three runs, taken "
      "now.\n\n"
      "| theory | elements | largest error, us | wall time, ms |\n|---|---|---|---|\n";
  double costs[2] = {};
  const Setting settings[] = {{"rayleigh", 330, 600}, {"timoshenko", 100, 240}};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto run = [&](int n, const char* rtol) {
      return simulate(
          case_of("shear", {fmt::format("beam.theory={}", settings[i].theory), elements(n),
                            "striker.velocity=15.9", "time.end=2e-3", "solver.method=exponential",
                            fmt::format("solver.rtol={}", rtol), "output.interval=0"}));
    };
    const std::vector<double> exact = times_of(run(settings[i].reference, "1e-9"));
    double error = 0.0;
    costs[i] = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 3; ++repeat) {
      const Result result = run(settings[i].elements, "1e-6");
      error = largest_difference(times_of(result), exact);
      costs[i] = std::min(costs[i], result.work.wall_seconds);
    }
    outcome.rows.push_back({fmt::format("{}, {} elements, largest error to 2 ms, us",
                                        settings[i].theory, settings[i].elements),
                            0.1, error, Bound::within, 0.0});
    note += fmt::format("| {} | {} | {:.2g} | {:.3g} |\n", settings[i].theory, settings[i].elements,
                        error, 1e3 * costs[i]);
  }
  note += fmt::format(
      "\nShear costs {:.0f} times as much, most of it for the decomposition into "
      "natural modes, which Rayleigh's free beam has in closed form.",
      costs[1] / costs[0]);
  outcome.notes.push_back(note);
}

}  // namespace

Outcome check_shear() {
  Outcome outcome{"two discretisations", {}, {}};
  add_slow_strike(outcome);
  add_fast_strikes(outcome);
  add_cost(outcome);
  return outcome;
}

}  // namespace subimpact::validation
