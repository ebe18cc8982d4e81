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
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"

namespace subimpact {

namespace {

struct Point {
  std::string label;  // of the case
  Trial trial;
};

template <auto... members>
constexpr auto of_trial = member<&Point::trial, members...>;
template <auto found>
constexpr auto errors = of_trial<&Trial::errors, found>;
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
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"sub_impacts", errors<&EventErrors::n_found>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"", correspondence, {"corre-\nspond", ">9"}, has_errors},
      {"first_odd_s", odd(&UnmatchedSubImpact::start)},
      {"odd_duration_s", odd(&UnmatchedSubImpact::duration)},
      {"median_error_s", errors<&EventErrors::median>, time("times,\nmedian us"), has_errors},
      {"max_error_s", errors<&EventErrors::maximum>, time("times,\nmax us"), has_errors},
      {"first_error_s", errors<&EventErrors::first>},
      {"last_error_s", errors<&EventErrors::last>},
      {"peak_force_error", errors<&EventErrors::peak_force>, share("peaks,\nmax rel."), has_errors},
      {"striker_velocity_error", errors<&EventErrors::striker_velocity>, share("striker,\nrel."),
       has_errors},
      {"beam_velocity_error", errors<&EventErrors::beam_velocity>},
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
