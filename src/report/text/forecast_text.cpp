#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case/counted.h"
#include "io/records/record.h"
#include "numerics/units.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

const Record<ForecastRun> run_record = {
    {"level", "its mesh in the order of the search, from 1", &ForecastRun::level},
    {"is_beside", "whether it judges the run of its level", &ForecastRun::is_beside},
    {"mesh", "in words", &ForecastRun::mesh},
    {"method", "as in case files", &ForecastRun::method},
    {"processor_s", "processor time", &ForecastRun::seconds},
    {"is_made", "whether explain has made it to measure this", &ForecastRun::is_made},
    {"runs", "of which this is the time of all", &ForecastRun::n_runs}};

const Record<ForecastCost> cost_record = {
    {"processor_s", "processor time of all", &ForecastCost::processor_seconds},
    {"wall_s", "time by the clock", &ForecastCost::wall_seconds},
    {"runs", "those that run makes", &ForecastCost::runs, run_record}};

const Record<RunForecast> forecast_record = {
    {"jobs", "runs at a time", &RunForecast::jobs},
    {"memory_bytes", "that suffices for the process", &RunForecast::memory},
    {"expected", "what is expected", &RunForecast::expected, cost_record},
    {"least", "if the next level meets the tolerance", &RunForecast::least, cost_record},
    {"most", "if no more sub-impacts become certain", &RunForecast::most, cost_record}};

// The shortest over the longest time, above which no range is stated.
constexpr double certain_within = 0.9;

// With two digits.
std::string rough(double seconds) {
  return duration_text(std::stod(fmt::format("{:.2g}", seconds)));
}

}  // namespace

std::string forecast_json(const RunForecast& forecast) {
  return json_of(forecast_record, forecast).dump(2) + "\n";
}

std::string forecast_text(const RunForecast& forecast) {
  const auto& [runs, processor, wall] = forecast.expected;
  const ForecastCost &least = forecast.least, &most = forecast.most;
  std::string text;
  const auto line = [&](const char* label, const std::string& value) {
    text += fmt::format("  {:<21} {}\n", label, value);
  };
  line("time", fmt::format("about {}; of the processor {}", rough(wall), rough(processor)));
  line("memory", fmt::format("at most about {:.0f} MB", std::ceil(MB * forecast.memory)));
  int n_runs = 0;
  for (const ForecastRun& run : runs) n_runs += run.n_runs;
  line("runs", fmt::format("{} on {}, up to {} at a time", n_runs,
                           counted(runs.back().level, "level"), forecast.jobs));
  if (least.processor_seconds < certain_within * most.processor_seconds) {
    line("range", fmt::format("{} to {}, the longer the fewer sub-impacts become certain",
                              rough(least.wall_seconds), rough(most.wall_seconds)));
  }
  if (const int strikes = forecast.first.input.strikes; strikes > 1)
    line("without", fmt::format("strikes 2 to {}, which each take about as long", strikes));
  std::size_t width = 30;
  for (const ForecastRun& run : runs) width = std::max(width, run.mesh.size());
  const auto row = [&](const std::string& role, const std::string& mesh, const std::string& method,
                       const std::string& time) {
    text += fmt::format("  {:<21} {:<{}} {:<20} {}\n", role, mesh, width + 1, method, time);
  };
  row("level", "mesh", "method", "time of the processor");
  int level = 0;
  for (const ForecastRun& run : runs) {
    const std::string role = run.n_runs > 1       ? fmt::format("  scatter, {} runs", run.n_runs)
                             : run.is_beside      ? "  beside it"
                             : run.level == level ? "  again, for its rows"
                                                  : fmt::format("{}", run.level);
    level = run.level;
    row(role, run.mesh, run.method,
        rough(run.seconds) + (run.is_made ? ", measured just now" : ""));
  }
  return text;
}

}  // namespace subimpact
