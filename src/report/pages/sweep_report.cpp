#include "subimpact/report/pages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "case/counted.h"
#include "report/pages/page.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

constexpr std::size_t most_sub_impacts = 80'000;  // on a page, which stays below 6 MB or so

struct Shown {
  const char* column;
  const char* label;
  const char* unit;
  double factor;
};
constexpr Shown shown_results[] = {
    {"n_sub_impacts", "sub-impacts", "", 1.0},
    {"n_zones", "zones", "", 1.0},
    {"n_certain", "sub-impacts certain", "", 1.0},
    {"all_certain", "all certain (1: yes)", "", 1.0},
    {"time_s", "time reached", "ms", 1e3},
    {"wish_met", "tolerance met (1: yes)", "", 1.0},
    {"horizon_s", "horizon of the tolerance", "µs", 1e6},
    {"first_separation_s", "end of the first contact", "µs", 1e6},
    {"first_separation_error_s", "error of the end of the first contact", "µs", 1e6},
    {"first_section_yield_s", "first yield of a section", "µs", 1e6},
    {"first_contact_yield_s", "first yield of the contact", "µs", 1e6},
    {"max_force_N", "largest force", "N", 1.0},
    {"max_force_time_s", "time of the largest force", "µs", 1e6},
    {"max_indentation_m", "largest indentation", "mm", 1e3},
    {"residual_indentation_m", "dent", "mm", 1e3},
    {"permanent_set_m", "permanent set", "mm", 1e3},
    {"impulse_Ns", "impulse", "N s", 1.0},
    {"striker_velocity_m_per_s", "striker, at the end", "m/s", 1.0},
    {"beam_mean_velocity_m_per_s", "beam (mean), at the end", "m/s", 1.0},
    {"restitution", "restitution", "", 1.0},
    {"striker_energy_share", "part of its energy that the striker keeps", "", 1.0},
    {"bending_plastic_J", "energy of plastic bending", "J", 1.0},
    {"contact_plastic_J", "energy of the dent", "J", 1.0},
    {"beam_damping_J", "energy lost to damping", "J", 1.0},
    {"contact_over", "contact over (1: proven)", "", 1.0},
    {"max_energy_error", "largest error of the energy, relative", "", 1.0}};

Shown shown(const SweptRuns::Column& column) {
  const auto found = std::ranges::find(shown_results, column.name, &Shown::column);
  if (found != std::end(shown_results)) return *found;
  const CaseKey* key = column.is_key ? find_case_key(column.name) : nullptr;
  return {column.name.c_str(), column.name.c_str(), key ? key->unit.c_str() : "", 1.0};
}

Json words_json(const std::vector<std::string>& words) {
  std::map<std::string, int> places;
  Json different = Json::array(), indices = Json::array();
  for (const std::string& word : words) {
    const auto [place, is_new] = places.emplace(word, static_cast<int>(places.size()));
    if (is_new) different.push_back(word);
    indices.push_back(place->second);
  }
  return {{"words", different}, {"indices", indices}};
}

Json column_json(const SweptRuns::Column& column) {
  const Shown how = shown(column);
  const CaseKey* key = column.is_key ? find_case_key(column.name) : nullptr;
  return {{"name", column.name},
          {"label", how.label},
          {"unit", how.unit},
          {"factor", how.factor},
          {"is_key", column.is_key},
          {"is_flag", key != nullptr && key->type == KeyType::flag},
          {"values", !column.words.empty() ? words_json(column.words)
                     : column.is_key       ? packed<double>(column.numbers)
                                           : packed<float>(column.numbers)}};
}

// The sub-impacts of all runs, one after another, and how many each run has; -1: left out.
Json sub_impacts_json(const SweptRuns& runs, std::size_t& n_left_out) {
  std::vector<SubImpact> rows;
  Json counts = Json::array();
  for (const std::vector<SubImpact>& of_run : runs.sub_impacts) {
    const bool fits = rows.size() + of_run.size() <= most_sub_impacts;
    counts.push_back(fits ? static_cast<int>(of_run.size()) : -1);
    n_left_out += fits ? 0 : 1;
    if (fits) rows.insert(rows.end(), of_run.begin(), of_run.end());
  }
  return {{"counts", counts},
          {"start", packed<double>(rows, &SubImpact::start)},
          {"end", packed<double>(rows, &SubImpact::end)},
          {"start_error", packed<float>(rows, &SubImpact::start_error)},
          {"end_error", packed<float>(rows, &SubImpact::end_error)},
          {"start_scatter", packed<float>(rows, &SubImpact::start_scatter)},
          {"end_scatter", packed<float>(rows, &SubImpact::end_scatter)},
          {"peak_time", packed<float>(rows, &SubImpact::peak_time)},
          {"peak_force", packed<float>(rows, &SubImpact::peak_force)},
          {"impulse", packed<float>(rows, &SubImpact::impulse)},
          {"max_indentation", packed<float>(rows, &SubImpact::max_indentation)},
          {"striker_velocity", packed<float>(rows, &SubImpact::striker_velocity)}};
}

std::map<std::string, std::size_t> outcomes(const SweptRuns& runs) {
  std::map<std::string, std::size_t> counts;
  for (const std::string& outcome : runs.find("outcome")->words) ++counts[outcome];
  return counts;
}

Json headlines(const SweptRuns& runs) {
  Json list = Json::array();
  if (const SweptRuns::Column* certain = runs.find("all_certain")) {
    const auto n_certain = std::ranges::count(certain->numbers, 1.0);
    const auto n_uncertain = std::ranges::count(certain->numbers, 0.0);
    if (n_certain > 0) {
      list.push_back(headline(true, fmt::format("count and order of the sub-impacts in {} of {}.",
                                                n_certain, counted(runs.numbers.size(), "run"))));
    }
    if (n_uncertain > 0) {
      list.push_back(
          headline(false, fmt::format("the counts of {}, which the map marks with a cross; a "
                                      "pattern among them may be that of their errors.",
                                      counted(n_uncertain, "run"))));
    }
  } else {
    list.push_back(headline(false,
                            "counts, times and order of sub-impacts: the sweep was made without "
                            "error bars, so that no run states how far they can be trusted."));
  }
  for (const auto& [outcome, count] : outcomes(runs)) {
    if (outcome == "completed") continue;
    list.push_back(headline(
        false, fmt::format("{} with the outcome \"{}\".", counted(count, "run"), outcome)));
  }
  return list;
}

std::string range_text(const SweptRuns::Column& column) {
  if (!column.words.empty()) {
    const std::set<std::string> different(column.words.begin(), column.words.end());
    return fmt::format("{} different texts", different.size());
  }
  std::set<double> different;
  for (const double x : column.numbers) {
    if (!std::isnan(x)) different.insert(x);
  }
  const Shown how = shown(column);
  return fmt::format("{} different, {:.6g} to {:.6g} {}", different.size(),
                     how.factor * *different.begin(), how.factor * *different.rbegin(), how.unit);
}

Json key_list(const SweptRuns& runs) {
  Json list = Json::array();
  for (const SweptRuns::Column& column : runs.columns) {
    if (!column.is_key) continue;
    const CaseKey* key = find_case_key(column.name);
    list.push_back({{"key", column.name},
                    {"meaning", key ? key->meaning : ""},
                    {"values", range_text(column)}});
  }
  return list;
}

Json tiles(const SweptRuns& runs) {
  const std::size_t n = runs.numbers.size();
  Json list = {{{"value", n}, {"label", noun_after(n, "run")}},
               {{"value", outcomes(runs)["completed"]}, {"label", "completed"}}};
  const SweptRuns::Column* counts = runs.find("n_sub_impacts");
  if (counts != nullptr && counts->words.empty()) {
    std::vector<double> known = counts->numbers;
    std::erase_if(known, [](double x) { return std::isnan(x); });
    const auto [least, most] = std::ranges::minmax(known);
    list.push_back(
        {{"value", fmt::format("{} to {}", least, most)}, {"label", "sub-impacts per run"}});
  }
  return list;
}

}  // namespace

std::string sweep_report(const SweptRuns& runs, const std::string& name,
                         const std::string& case_file) {
  std::size_t n_left_out = 0;
  const Json data = {{"numbers", runs.numbers},
                     {"case_file", case_file},
                     {"columns", list_of(runs.columns, column_json)},
                     {"sub_impacts", sub_impacts_json(runs, n_left_out)}};
  const std::string note = fmt::format(
      "To keep the page small the sub-impacts of {} are left out; sub_impacts.csv has them.",
      counted(n_left_out, "run"));
  const Json page = {{"title", "Sweep: " + name},   {"note", n_left_out == 0 ? "" : note},
                     {"data", within_script(data)}, {"headlines", headlines(runs)},
                     {"tiles", tiles(runs)},        {"keys", key_list(runs)}};
  return whole_page("pages/web/sweep.html", page, {},
                    {"pages/web/data.js", "pages/web/axes.js", "pages/web/panels.js",
                     "pages/web/swept_runs.js", "pages/web/shade.js", "pages/web/sweep_map.js",
                     "pages/web/run_panel.js", "pages/web/sweep.js"});
}

}  // namespace subimpact
