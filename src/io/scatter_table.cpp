#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/counted.h"
#include "io/uncertain.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr int most_decimals = 4;

// "217.1 +- 1.6": a time with its standard deviation.
std::string scattered(const std::optional<double>& time, const std::optional<double>& scatter) {
  if (!time) return "(open)";
  if (!scatter) return fmt::format("{:.0f} ?", us * *time);
  if (*scatter == 0.0) return fmt::format("{:g}", us * *time);
  const auto rounding = rounding_of(us * *scatter, most_decimals);
  if (!rounding) return fmt::format("{:.0f} ?", us * *time);
  return fmt::format("{} +- {}", with_decimals(us * *time, rounding->decimals), rounding->error);
}

std::string zone_line(const Predictability::Zone& zone, const ZoneSummary& summary) {
  std::string text = fmt::format("{:>6} {:>22} {:>22}", fmt::format("zone {}", summary.zone),
                                 scattered(summary.start, zone.start_scatter),
                                 scattered(summary.end, zone.end_scatter));
  if (zone.impulse_scatter) {
    const auto rounding = rounding_of(*zone.impulse_scatter, most_decimals + 2);
    text += fmt::format("  impulse {} +- {} N s",
                        with_decimals(summary.impulse, rounding->decimals), rounding->error);
  }
  return text + "\n";
}

}  // namespace

std::string predictability_words(const Result& result) {
  const Predictability& found = *result.predictability;
  const std::size_t n_all = result.sub_impacts.size();
  const std::size_t n = std::min(found.first_unpredictable.value_or(n_all), n_all);
  const std::string scatter =
      fmt::format("times scatter by up to {}", error_text(found.largest_scatter));
  if (!found.first_unpredictable) {
    return fmt::format("all {}; {}", counted(n_all, "sub-impact"), scatter);
  }
  if (n == 0) return "no sub-impact: " + found.reason;
  return fmt::format("{} of {}, up to {}; {}; beyond: {}", n, counted(n_all, "sub-impact"),
                     duration_text(found.horizon), scatter, found.reason);
}

std::string scatter_table(const Result& result) {
  const Predictability& found = *result.predictability;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "standard deviations by the scatter of the case\n{:>6} {:>22} {:>22}\n",
                 "no.", "start, us", "end, us");
  for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
    if (found.first_unpredictable == i) {
      fmt::format_to(out, "from here on not predictable: {}\n", found.reason);
    }
    const SubImpact& s = result.sub_impacts[i];
    fmt::format_to(out, "{:>6} {:>22} {:>22}\n", i + 1, scattered(s.start, s.start_scatter),
                   scattered(s.end, s.end_scatter));
  }
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  for (std::size_t z = 0; z < std::min(zones.size(), found.zones.size()); ++z) {
    text.append(zone_line(found.zones[z], zones[z]));
  }
  if (found.striker_velocity_scatter) {
    const double scatter = *found.striker_velocity_scatter;
    const auto rounding = rounding_of(scatter, most_decimals + 2);
    fmt::format_to(out, "striker, at the end: {} +- {} m/s\n",
                   with_decimals(result.striker_velocity, rounding->decimals), rounding->error);
  }
  return fmt::to_string(text);
}

}  // namespace subimpact
