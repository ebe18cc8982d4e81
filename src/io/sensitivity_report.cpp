#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/counted.h"
#include "io/study_columns.h"
#include "io/uncertain.h"
#include "io/write_file.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"
#include "subimpact/io/sensitivity.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;              // per second
constexpr double us_per_percent = 1e4;  // of d/d ln p in seconds
constexpr int most_decimals = 6;
constexpr int most_decimals_of_scatter = 4;
constexpr std::size_t narrowest = 9;

using Row = SensitivityRow;

auto by_key(std::size_t key, double Derivative::*member) {
  return [=](const Row& row) {
    return row.by_key[key] ? std::optional((*row.by_key[key]).*member) : std::nullopt;
  };
}

// "1.654", as many digits as the error allows; a question mark where it allows none.
std::string per_percent(const std::optional<Derivative>& derivative) {
  if (!derivative) return "-";
  const auto rounding = rounding_of(us_per_percent * derivative->error, most_decimals);
  if (!rounding) return "?";
  return with_decimals(us_per_percent * derivative->value, rounding->decimals);
}

bool is_time(const Row& row) {
  return row.quantity == EventQuantity::start || row.quantity == EventQuantity::end;
}

struct Line {
  std::vector<std::string> cells;
  std::string flag;
};

Line line_of(const Row& row) {
  Line line{{fmt::format("{}", row.sub_impact + 1),
             row.quantity == EventQuantity::start ? "start" : "end",
             fmt::format("{:.4f}", us * row.value)},
            row.flag};
  for (const auto& derivative : row.by_key) line.cells.push_back(per_percent(derivative));
  return line;
}

// "217.1 +- 1.6": a time with its standard deviation.
std::string scattered(const std::optional<double>& time, const std::optional<double>& scatter) {
  if (!time) return "(open)";
  if (!scatter) return fmt::format("{:.0f} ?", us * *time);
  if (*scatter == 0.0) return fmt::format("{:g}", us * *time);
  const auto rounding = rounding_of(us * *scatter, most_decimals_of_scatter);
  if (!rounding) return fmt::format("{:.0f} ?", us * *time);
  return fmt::format("{} +- {}", with_decimals(us * *time, rounding->decimals), rounding->error);
}

// Another number, in its own unit.
std::string with_scatter(double value, const std::optional<double>& scatter) {
  const auto rounding = rounding_of(scatter.value_or(HUGE_VAL), most_decimals_of_scatter + 2);
  if (!rounding) return with_digits(value, 2) + " ?";
  return fmt::format("{} +- {}", with_decimals(value, rounding->decimals), rounding->error);
}

std::string zone_line(const Predictability::Zone& zone, const ZoneSummary& summary) {
  std::string text = fmt::format("{:>6} {:>22} {:>22}", fmt::format("zone {}", summary.zone),
                                 scattered(summary.start, zone.start_scatter),
                                 scattered(summary.end, zone.end_scatter));
  return text +
         fmt::format("  impulse {} N s\n", with_scatter(summary.impulse, zone.impulse_scatter));
}

}  // namespace

Columns<SensitivityRow> sensitivity_columns(const std::vector<std::string>& keys) {
  Columns<Row> columns = {{"quantity", [](const Row& row) { return row.quantity; }},
                          {"sub_impact", [](const Row& row) { return row.sub_impact + 1; }},
                          {"value", &Row::value}};
  for (std::size_t key = 0; key < keys.size(); ++key) {
    columns.push_back({"d_" + keys[key], by_key(key, &Derivative::value)});
    columns.push_back({"error_" + keys[key], by_key(key, &Derivative::error)});
  }
  columns.push_back({"flag", &Row::flag});
  return columns;
}

std::string sensitivity_csv(const Sensitivity& study) {
  return csv_text(sensitivity_columns(study.keys), study.rows);
}

void write_sensitivity(const std::filesystem::path& directory, const Sensitivity& study) {
  write_file(directory / "sensitivity.csv", sensitivity_csv(study));
}

std::string sensitivity_table(const Sensitivity& study) {
  std::vector<Line> lines = {{{"", "", ""}, ""}, {{"no.", "", "us"}, ""}};
  for (const std::string& name : study.keys) {
    const CaseKey& key = *find_case_key(name);
    lines[0].cells.push_back(key.table() + ".");
    lines[1].cells.push_back(key.leaf());
  }
  for (const Row& row : study.rows) {
    const bool is_zero_of_time = row.value == 0.0;  // the first touch
    if (is_time(row) && !is_zero_of_time) lines.push_back(line_of(row));
  }
  std::vector<std::size_t> widths(lines[0].cells.size(), narrowest);
  widths[0] = 4;
  widths[1] = 5;
  for (const Line& line : lines) {
    for (std::size_t k = 0; k < widths.size(); ++k) {
      widths[k] = std::max(widths[k], line.cells[k].size());
    }
  }
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{}, {}; change of event times in us per 1 % more of\n", study.base.used.mesh,
                 to_string(study.input.solver.method));
  for (const Line& line : lines) {
    for (std::size_t k = 0; k < widths.size(); ++k) {
      fmt::format_to(out, "{}{:>{}}", k == 0 ? "" : " ", line.cells[k], widths[k]);
    }
    fmt::format_to(out, "{}{}\n", line.flag.empty() ? "" : "  ! ", line.flag);
  }
  for (const std::string& remark : study.remarks) fmt::format_to(out, "{}\n", remark);
  return fmt::to_string(text);
}

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
  fmt::format_to(out,
                 "standard deviations by the scatter of the case (?: not known, or more than is "
                 "possible: derivatives do not hold that far)\n{:>6} {:>22} {:>22}\n",
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
  fmt::format_to(out, "striker, at the end: {} m/s\n",
                 with_scatter(result.striker_velocity, found.striker_velocity_scatter));
  return fmt::to_string(text);
}

}  // namespace subimpact
