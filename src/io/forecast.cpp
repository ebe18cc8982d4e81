#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "io/record.h"
#include "io/uncertain.h"
#include "numerics/units.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

const Record<ForecastRun> run_record = {
    {"level", "its mesh in the order of the search, from 1", &ForecastRun::level},
    {"is_beside", "whether it judges the run of its level", &ForecastRun::is_beside},
    {"mesh", "in words", &ForecastRun::mesh},
    {"method", "as in case files", &ForecastRun::method},
    {"processor_s", "processor time", &ForecastRun::seconds},
    {"is_made", "whether explain has made it to measure this", &ForecastRun::is_made}};

const Record<ForecastCost> cost_record = {
    {"processor_s", "processor time of all", &ForecastCost::processor_seconds},
    {"wall_s", "time by the clock", &ForecastCost::wall_seconds},
    {"runs", "those that run makes", &ForecastCost::runs, run_record}};

const Record<RunForecast> forecast_record = {
    {"jobs", "runs at a time", &RunForecast::jobs},
    {"memory_bytes", "that suffices", &RunForecast::memory},
    {"expected", "what is expected", &RunForecast::expected, cost_record},
    {"least", "if all sub-impacts become certain soon", &RunForecast::least, cost_record},
    {"most", "if they do not before the limit of work", &RunForecast::most, cost_record}};

std::string seconds_text(double seconds) { return duration_text(seconds); }

}  // namespace

std::string forecast_json(const RunForecast& forecast) {
  return json_of(forecast_record, forecast).dump(2) + "\n";
}

std::string forecast_text(const RunForecast& forecast) {
  const ForecastCost& cost = forecast.expected;
  std::string text;
  const auto line = [&](const char* label, const std::string& value) {
    text += fmt::format("  {:<21} {}\n", label, value);
  };
  line("time", fmt::format("about {}, and {} of processor time: {} at a time",
                           seconds_text(cost.wall_seconds), seconds_text(cost.processor_seconds),
                           counted(forecast.jobs, "run")));
  line("memory", fmt::format("about {:.2g} MB", MB * forecast.memory));
  text += fmt::format("\n  level                 {:<28} {:<20} {:>10}\n", "mesh", "method", "time");
  for (const ForecastRun& run : cost.runs) {
    text += fmt::format("  {:<21} {:<28} {:<20} {:>10}{}\n",
                        run.is_beside ? "  beside it" : fmt::format("{}", run.level), run.mesh,
                        run.method, seconds_text(run.seconds), run.is_made ? "  made just now" : "");
  }
  return text;
}

}  // namespace subimpact
