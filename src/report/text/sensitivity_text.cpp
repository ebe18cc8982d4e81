#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "io/directory/listed_files.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

constexpr double us_per_percent = 1e4;  // of d/d ln p in seconds
constexpr int most_decimals = 6;
constexpr int most_decimals_of_scatter = 4;
constexpr std::size_t narrowest = 9;

using Row = SensitivityRow;

struct {
  const char* column;
  const char* name;
  Measure measure;
} constexpr sampled_totals[] = {{"sub_impacts", "sub-impacts", as_ratio},
                                {"restitution", "restitution", as_ratio},
                                {"peak_force_N", "force", as_force},
                                {"impulse_Ns", "impulse", as_impulse},
                                {"dent_m", "dent", as_length},
                                {"permanent_set_m", "set", as_length},
                                {"striker_velocity_m_per_s", "velocity", as_velocity}};

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

bool is_start(const Row& row) { return row.quantity == EventQuantity::start; }
bool is_time(const Row& row) { return is_start(row) || row.quantity == EventQuantity::end; }

// "217.1 +- 1.6": a time with its standard deviation.
std::string scattered(const std::optional<double>& time, const std::optional<double>& scatter) {
  if (!time) return "(open)";
  if (!scatter) return fmt::format("{:.0f} ?", us * *time);
  if (*scatter == 0.0) return fmt::format("{:g}", us * *time);
  const auto rounding = rounding_of(us * *scatter, most_decimals_of_scatter);
  if (!rounding) return fmt::format("{:.0f} ?", us * *time);
  return fmt::format("{} +- {}", with_decimals(us * *time, rounding->decimals), rounding->error);
}

std::string with_scatter(double value, const std::optional<double>& scatter) {
  const auto rounding = rounding_of(scatter.value_or(HUGE_VAL), most_decimals_of_scatter + 2);
  if (!rounding) return with_digits(value, 2) + " ?";
  return fmt::format("{} +- {}", with_decimals(value, rounding->decimals), rounding->error);
}

std::string line(const std::string& label, const std::string& start, const std::string& end) {
  return fmt::format("{:>6} {:>22} {:>22}", label, start, end);
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
  std::vector<Row> rows = study.rows;
  // The first touch, where time begins, has no derivative.
  std::erase_if(rows, [](const Row& row) { return !is_time(row) || row.value == 0.0; });
  StudyColumns<Row> columns = {
      {"", [](const Row& row) { return row.sub_impact + 1; }, {"no.", ">4"}},
      {"", [](const Row& row) { return is_start(row) ? "start" : "end"; }, {"", ">5"}}};
  const auto add = [&](const std::string& heading, std::size_t width, auto cell) {
    for (const Row& row : rows) width = std::max(width, cell(row).size());
    columns.push_back({"", cell, {heading, fmt::format(">{}", width)}});
  };
  add("us", narrowest, [](const Row& row) { return fmt::format("{:.4f}", us * row.value); });
  for (std::size_t k = 0; k < study.keys.size(); ++k) {
    const CaseKey& key = *find_case_key(study.keys[k]);
    add(key.table() + ".\n" + key.leaf(),
        std::max({narrowest, key.table().size() + 1, key.leaf().size()}),
        [k](const Row& row) { return per_percent(row.by_key[k]); });
  }
  const auto flag = [](const Row& row) {
    return row.flag.empty() ? std::nullopt : std::optional(" ! " + row.flag);
  };
  columns.push_back({"", flag, {"", "<"}});
  std::string text =
      fmt::format("{}, {}; change of event times in us per 1 % more of\n{}", study.base.used.mesh,
                  to_string(study.input.solver.method), printed_table(columns, rows));
  for (const std::string& remark : study.remarks) text += remark + '\n';
  return text;
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

std::vector<LabelledText> scatter_answers(const Result& result) {
  const Predictability& found = *result.predictability;
  std::vector<LabelledText> answers;
  for (const auto& [column, name, measure] : sampled_totals) {
    const auto total = std::ranges::find(found.totals, column, &Predictability::Sampled::name);
    if (total == found.totals.end()) continue;
    if (total->mean == 0.0 && total->deviation == 0.0) continue;  // no dent, no set
    const ReadUnit unit =
        unit_for(std::max(std::abs(total->quantile_5), std::abs(total->quantile_95)), measure);
    const auto number = [&](double value) { return with_digits(unit.per_si * value, 3); };
    const std::string mean = total->deviation > 0.0 ? with_scatter(unit.per_si * total->mean,
                                                                   unit.per_si * total->deviation)
                                                    : with_digits(unit.per_si * total->mean, 6);
    answers.push_back({fmt::format("scatter: {}", name), with_unit(mean, unit),
                       fmt::format("nine of ten from {} to {}", number(total->quantile_5),
                                   number(total->quantile_95))});
  }
  if (!answers.empty()) {
    answers.front().note += fmt::format("; mean +- standard deviation of {} runs on {}",
                                        found.n_samples, found.samples_mesh);
  }
  return answers;
}

std::string scatter_table(const Result& result) {
  const Predictability& found = *result.predictability;
  std::string text =
      "standard deviations by the scatter of the case (?: not known, or more than is possible: "
      "derivatives do not hold that far)\n" +
      line("no.", "start, us", "end, us") + '\n';
  for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
    if (found.first_unpredictable == i) {
      text += fmt::format("from here on not predictable: {}\n", found.reason);
    }
    const SubImpact& s = result.sub_impacts[i];
    text += line(std::to_string(i + 1), scattered(s.start, s.start_scatter),
                 scattered(s.end, s.end_scatter)) +
            '\n';
  }
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  for (std::size_t z = 0; z < std::min(zones.size(), found.zones.size()); ++z) {
    const Predictability::Zone& zone = found.zones[z];
    text +=
        line(fmt::format("zone {}", zones[z].zone), scattered(zones[z].start, zone.start_scatter),
             scattered(zones[z].end, zone.end_scatter)) +
        fmt::format("  impulse {} N s\n", with_scatter(zones[z].impulse, zone.impulse_scatter));
  }
  for (const LabelledText& answer : scatter_answers(result)) {
    text += fmt::format("{} {}: {}\n", answer.label, answer.text, answer.note);
  }
  return text;
}

}  // namespace subimpact
