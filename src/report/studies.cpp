#include "subimpact/report/studies.h"

#include <fmt/format.h>
#include <algorithm>
#include <sstream>

#include "case/counted.h"
#include "case/refuse.h"
#include "io/directory/listed_files.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

template <auto number>
constexpr auto errors = [](const auto& row) { return row.errors.*number; };

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

namespace {

struct Point {
  std::string label;  // of the case
  Trial trial;
};

template <auto... members>
constexpr auto of_trial = member<&Point::trial, members...>;
template <auto found>
constexpr auto trial_errors = of_trial<&Trial::errors, found>;
template <auto count>
constexpr auto work = of_trial<&Trial::work, count>;

bool has_run(const Point& row) {
  return row.trial.verdict != Verdict::not_run && row.trial.verdict != Verdict::refused;
}

bool has_errors(const Point& row) {
  return row.trial.verdict == Verdict::right || row.trial.verdict == Verdict::wrong_count;
}

std::string correspondence(const Point& row) {
  return fmt::format("{:>4}/{:<4}", row.trial.errors.n_corresponding, row.trial.errors.n_reference);
}

const StudyColumns<Point>& point_columns() {
  const auto setting = [](const Point& row) { return row.trial.setting.text(); };
  const auto wall_time = [](const Point& row) { return duration_text(row.trial.seconds); };
  const auto time = [](const char* heading) { return Print{heading, ">9", ".1e", us}; };
  const auto share = [](const char* heading) { return Print{heading, ">9", ".1e"}; };
  const auto odd = [](double UnmatchedSubImpact::*length) {
    return [length](const Point& row) {
      const auto& unmatched = row.trial.errors.unmatched;
      return unmatched ? std::optional((*unmatched).*length) : std::nullopt;
    };
  };
  static const StudyColumns<Point> columns = {
      {"label", &Point::label},
      {"method", of_trial<&Trial::setting, &Setting::method>, {"method", "<22"}},
      {"kind", [](const Point& row) { return row.trial.setting.fixed_step ? "step" : "rtol"; }},
      {"setting", of_trial<&Trial::setting, &Setting::value>},
      {"", setting, {"setting", "<14"}},
      {"verdict", of_trial<&Trial::verdict>, {"verdict", "<12"}},
      {"reference_sub_impacts", trial_errors<&EventErrors::n_reference>},
      {"sub_impacts", trial_errors<&EventErrors::n_found>},
      {"corresponding", trial_errors<&EventErrors::n_corresponding>},
      {"", correspondence, {"corre-\nspond", ">9"}, has_errors},
      {"first_odd_s", odd(&UnmatchedSubImpact::start)},
      {"odd_duration_s", odd(&UnmatchedSubImpact::duration)},
      {"median_error_s", trial_errors<&EventErrors::median>, time("times,\nmedian us"), has_errors},
      {"max_error_s", trial_errors<&EventErrors::maximum>, time("times,\nmax us"), has_errors},
      {"first_error_s", trial_errors<&EventErrors::first>},
      {"last_error_s", trial_errors<&EventErrors::last>},
      {"peak_force_error", trial_errors<&EventErrors::peak_force>, share("peaks,\nmax rel."),
       has_errors},
      {"striker_velocity_error", trial_errors<&EventErrors::striker_velocity>,
       share("striker,\nrel."), has_errors},
      {"beam_velocity_error", trial_errors<&EventErrors::beam_velocity>},
      {"wall_s", of_trial<&Trial::seconds>},
      {"", wall_time, {"wall\ntime", ">10"}, has_run},
      {"repeats", of_trial<&Trial::repeats>},
      {"setup_s", work<&Work::setup_seconds>},
      {"steps", work<&Work::steps>},
      {"rejected_steps", work<&Work::rejected_steps>},
      {"right_hand_sides", work<&Work::right_hand_sides>, {"right-hand\nsides", ">10"}, has_run},
      {"mass_solves", work<&Work::mass_solves>, {"mass\nsolves", ">10"}, has_run},
      {"jacobians", work<&Work::jacobians>},
      {"factorisations", work<&Work::factorisations>, {"factori-\nsations", ">8"}, has_run},
      {"message", of_trial<&Trial::message>},
  };
  return columns;
}

std::string setting_text(const Trial& point) {
  return fmt::format("{} at {}: {}, largest error {:.1e} us", point.setting.method,
                     point.setting.text(), duration_text(point.seconds), point.errors.maximum * us);
}

}  // namespace

std::string case_id(const Case& input) {
  Case same = input;
  same.solver.method = {};
  same.solver.table.reset();
  same.solver.rtol = {};
  same.solver.step.reset();
  same.output = {};
  return case_identity(same, {});
}

std::string work_precision_table(const WorkPrecision& study) {
  const Reference& reference = study.reference;
  std::string text =
      fmt::format("reference: {}; {}, times to {:.1e} us\nhorizon: {:.3f} us ({})\n",
                  reference.description, counted(reference.sub_impacts.size(), "sub-impact"),
                  reference.error * us, reference.horizon * us, reference.horizon_reason);
  if (const auto growth = error_growth(study.points)) {
    text += fmt::format("errors grow {:.2g}-fold from the first separation to the last event\n",
                        *growth);
  }
  text += '\n' + printed_heading(point_columns());
  std::string method, messages;
  for (const Trial& point : study.points) {
    if (!method.empty() && point.setting.method != method) text += '\n';
    method = point.setting.method;
    text += printed_row(point_columns(), {{}, point});
    if (point.message.empty()) continue;
    messages += fmt::format("{} at {}: {}\n", method, point.setting.text(), point.message);
  }
  return messages.empty() ? text : text + '\n' + messages;
}

std::string recommendation_text(const std::vector<Recommendation>& recommendations) {
  std::string text;
  for (const Recommendation& item : recommendations) {
    text += fmt::format(
        "  {:<9} {}\n", fmt::format("{:g} us", item.wanted * us),
        item.point ? setting_text(*item.point) : "not reached by any setting that was run");
    if (!item.steady) continue;
    text += fmt::format("            by chance: finer settings miss it; reliably from {} on\n",
                        setting_text(*item.steady));
  }
  return text;
}

std::string work_precision_csv(const std::vector<WorkPrecision>& studies) {
  std::vector<Point> rows;
  for (const WorkPrecision& study : studies) {
    for (const Trial& point : study.points) rows.push_back({study.label, point});
  }
  return csv_text(columns_in_file(point_columns()), rows);
}

}  // namespace subimpact
