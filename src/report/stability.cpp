#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "io/directory/listed_files.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "subimpact/report/studies.h"

namespace subimpact {
namespace {

template <auto number>
constexpr auto errors = [](const auto& row) { return row.errors.*number; };

std::string difference(const auto& row) {
  return fmt::format("{:.2f} %", 100.0 * (row.measured / row.predicted - 1.0));
}

// How much of an oscillation one step leaves at 1, 10 and 100 times the unit of omega h.
struct DampingOfMethod {
  std::string method;
  double left[3] = {0.0, 0.0, 0.0};
  double largest = 0.0;  // difference between measurement and prediction
};

std::vector<DampingOfMethod> by_method(const std::vector<Damping>& rows) {
  std::vector<DampingOfMethod> methods;
  for (const Damping& row : rows) {
    if (methods.empty() || methods.back().method != row.method) methods.push_back({row.method});
    DampingOfMethod& here = methods.back();
    here.largest = std::max(here.largest, std::abs(row.measured - row.predicted));
    for (int i = 0; i < 3; ++i) {
      if (std::abs(row.angle / std::pow(10.0, i) - 1.0) < 1e-9) here.left[i] = row.measured;
    }
  }
  return methods;
}

template <class Row>
StabilityPart part_of(const char* name, const StudyColumns<Row>& columns,
                      const std::vector<Row>& rows) {
  return {printed_table(columns, rows),
          {{name + std::string(".csv"), csv_text(columns_in_file(columns), rows)}}};
}

std::string map_text(const OutcomeMap& map) {
  constexpr std::string_view letters = "+wiUFr.";  // in the order of verdicts
  std::string text = fmt::format(
      "reference: {}; {} up to {:.3f} us\n"
      "+ right   w wrong count   i inaccurate   U unstable   F solver failed   r refused   . left "
      "out\n",
      map.reference.description, counted(map.reference.sub_impacts.size(), "sub-impact"),
      map.reference.horizon * us);
  std::optional<bool> fixed_step;
  std::string row;
  for (const OutcomePoint& point : map.points) {
    if (point.setting.fixed_step != fixed_step) {
      if (fixed_step) text += '\n';
      fixed_step = point.setting.fixed_step;
      row.clear();
      text += fmt::format("\n{:<28}", *fixed_step ? "omega_max h" : "rtol");
      for (const OutcomePoint& other : map.points) {
        if (other.setting.fixed_step != fixed_step || other.row != point.row) continue;
        text += fmt::format(" {:>6g}", other.x);
      }
    }
    if (point.row != row) {
      row = point.row;
      text += fmt::format("\n{:<28}", row);
    }
    text += fmt::format(" {:>6}", letters[static_cast<std::size_t>(point.verdict)]);
  }
  return text + '\n';
}

}  // namespace

StabilityPart part_of(const std::vector<CriticalStep>& rows) {
  if (rows.empty()) return {};
  const auto theory = [](const CriticalStep& row) { return std::string(name_of(row.theory)); };
  const StudyColumns<CriticalStep> columns = {
      {"method", &CriticalStep::method, {"method", "<22"}},
      {"theory", theory, {"theory", "<16"}},
      {"segments", &CriticalStep::segments, {"cells", ">6"}},
      {"highest_frequency_rad_per_s", &CriticalStep::highest_frequency},
      {"limit_omega_h", &CriticalStep::limit, {"omega h", ">9", ".4f"}},
      {"predicted_s", &CriticalStep::predicted, {"predicted, us", ">13", ".6g", us}},
      {"measured_s", &CriticalStep::measured, {"measured, us", ">13", ".6g", us}},
      {"", difference<CriticalStep>, {"difference", ">10"}}};
  StabilityPart part = part_of("critical_steps", columns, rows);
  std::string method;
  for (const CriticalStep& row : rows) {
    if (row.method == method) continue;
    method = row.method;
    for (const Resonance& range : resonances(method)) {
      part.text +=
          fmt::format("{}: grows for omega h from {:.4f} to {:.4f} too, by up to {:.1e} per step\n",
                      method, range.from, range.to, range.growth - 1.0);
    }
  }
  return part;
}

StabilityPart part_of(const std::vector<StiffContact>& rows) {
  const StudyColumns<StiffContact> columns = {
      {"stiffness_N_per_m", &StiffContact::stiffness, {"spring, N/m", ">14", ".4g"}},
      {"beam_only_s", &StiffContact::beam_only, {"beam only, us", ">14", ".6g", us}},
      {"predicted_s", &StiffContact::predicted, {"predicted, us", ">14", ".6g", us}},
      {"measured_s", &StiffContact::measured, {"measured, us", ">14", ".6g", us}},
      {"", difference<StiffContact>, {"difference", ">10"}}};
  return part_of("stiff_contact", columns, rows);
}

StabilityPart part_of(const std::vector<Damping>& rows,
                      const std::vector<MultistepGrowth>& growths) {
  const Columns<Damping> columns = {{"method", &Damping::method},
                                    {"omega_h", &Damping::angle},
                                    {"predicted", &Damping::predicted},
                                    {"measured", &Damping::measured}};
  const Columns<MultistepGrowth> growth = {{"order", &MultistepGrowth::order},
                                           {"omega_h", &MultistepGrowth::angle},
                                           {"growth", &MultistepGrowth::growth}};
  const auto left = [](int i) { return [i](const DampingOfMethod& row) { return row.left[i]; }; };
  const StudyColumns<DampingOfMethod> printed = {
      {"", &DampingOfMethod::method, {"share of the amplitude\nleft by one step", "<22"}},
      {"", left(0), {"omega h = 1\n", ">12", ".5f"}},
      {"", left(1), {"10\n", ">12", ".5f"}},
      {"", left(2), {"100\n", ">12", ".5f"}},
      {"", &DampingOfMethod::largest, {"largest difference\nmeasured - predicted", ">22", ".1e"}}};
  return {
      printed_table(printed, by_method(rows)),
      {{"damping.csv", csv_text(columns, rows)}, {"bdf_growth.csv", csv_text(growth, growths)}}};
}

StabilityPart part_of(const OutcomeMap& map) {
  const auto if_completed = [](const OutcomePoint& point, double value) {
    const bool completed = point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
    return completed ? std::optional(value) : std::nullopt;
  };
  const Columns<OutcomePoint> columns = {
      {"group",
       [](const OutcomePoint& p) {
         return std::string(p.setting.fixed_step ? "fixed step" : "tolerance");
       }},
      {"row", &OutcomePoint::row},
      {"omega_h_or_rtol", &OutcomePoint::x},
      {"verdict", [](const OutcomePoint& p) { return p.verdict; }},
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"sub_impacts", errors<&EventErrors::n_found>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"median_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.median); }},
      {"max_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.maximum); }},
      {"energy_error", [=](const OutcomePoint& p) { return if_completed(p, p.energy_error); }},
      {"message", &OutcomePoint::message}};
  return {map_text(map), {{"outcomes.csv", csv_text(columns, map.points)}}};
}

StabilityPart part_of(const std::vector<MissedPairs>& rows) {
  using Row = MissedPairs;
  const StudyColumns<Row> columns = {
      {"step_s", &Row::step, {"step, us", ">9", ".3g", us}},
      {"runs", &Row::n_runs},
      {"right_with_search", &Row::right_with_search, {"all found, pairs looked for", ">28"}},
      {"right_without", &Row::right_without, {"all found, ends of steps only", ">28"}},
      {"shortest_s", &Row::shortest}};
  StabilityPart part = part_of("missed_pairs", columns, rows);
  part.text =
      fmt::format("{}; shortest sub-impact or separation {:.3g} us\n{}",
                  counted(rows.at(0).n_runs, "strike"), rows.at(0).shortest * us, part.text);
  return part;
}

StabilityPart part_of(const LayerStudy& study) {
  const auto first_unmatched = [](const LayerPoint& p) {
    return fmt::format(" {}", p.errors.unmatched ? p.errors.unmatched->description : "");
  };
  const StudyColumns<LayerPoint> columns = {
      {"layers", &LayerPoint::layers, {"layers", ">7"}},
      {"sub_impacts", errors<&EventErrors::n_found>, {"sub-impacts", ">11"}},
      {"exact_sub_impacts", errors<&EventErrors::n_reference>},
      {"corresponding", errors<&EventErrors::n_corresponding>, {"correspond", ">12"}},
      {"median_difference_s", errors<&EventErrors::median>, {"median, us", ">14", ".3e", us}},
      {"max_difference_s", errors<&EventErrors::maximum>, {"largest, us", ">12", ".3e", us}},
      {"", first_unmatched, {" ", "<"}}};
  StabilityPart part = part_of("layers", columns, study.points);
  part.text.insert(printed_heading(columns).size(),
                   fmt::format("{:>7} {:>11}\n", "exact", study.exact.sub_impacts.size()));
  return part;
}

void write(const std::filesystem::path& directory, const StabilityPart& part) {
  for (const auto& [name, content] : part.tables) write_file(directory / name, content);
}

}  // namespace subimpact
