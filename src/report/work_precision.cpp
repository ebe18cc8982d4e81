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

static bool read_cell(std::string_view cell, Verdict& verdict) {
  for (int i = 0; i <= static_cast<int>(Verdict::not_run); ++i) {
    verdict = static_cast<Verdict>(i);
    if (to_string(verdict) == cell) return true;
  }
  return false;
}

namespace {

constexpr const char* file_name = "work_precision.csv";

struct LoggedPoint {
  std::string id, label;  // of the case
  std::string kind;       // of the setting
  std::optional<double> unmatched_start, unmatched_duration;
  Trial point;
};

template <auto... members>
constexpr auto of_point = member<&LoggedPoint::point, members...>;
template <auto found>
constexpr auto errors = of_point<&Trial::errors, found>;
template <auto count>
constexpr auto work = of_point<&Trial::work, count>;
template <auto part>
constexpr auto of_setting = of_point<&Trial::setting, part>;

bool has_run(const LoggedPoint& row) {
  return row.point.verdict != Verdict::not_run && row.point.verdict != Verdict::refused;
}

bool has_errors(const LoggedPoint& row) {
  return row.point.verdict == Verdict::right || row.point.verdict == Verdict::wrong_count;
}

std::string correspondence(const LoggedPoint& row) {
  return fmt::format("{:>4}/{:<4}", row.point.errors.n_corresponding, row.point.errors.n_reference);
}

const StudyColumns<LoggedPoint>& point_columns() {
  const auto setting = [](const LoggedPoint& row) { return row.point.setting.text(); };
  const auto wall_time = [](const LoggedPoint& row) { return duration_text(row.point.seconds); };
  const auto time = [](const char* heading) { return Print{heading, ">9", ".1e", us}; };
  const auto share = [](const char* heading) { return Print{heading, ">9", ".1e"}; };
  static const StudyColumns<LoggedPoint> columns = {
      {"case", &LoggedPoint::id},
      {"label", &LoggedPoint::label},
      {"method", of_setting<&Setting::method>, {"method", "<22"}},
      {"kind", &LoggedPoint::kind},
      {"setting", of_setting<&Setting::value>},
      {"", setting, {"setting", "<14"}},
      {"verdict", of_point<&Trial::verdict>, {"verdict", "<12"}},
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"sub_impacts", errors<&EventErrors::n_found>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"", correspondence, {"corre-\nspond", ">9"}, has_errors},
      {"first_odd_s", &LoggedPoint::unmatched_start},
      {"odd_duration_s", &LoggedPoint::unmatched_duration},
      {"median_error_s", errors<&EventErrors::median>, time("times,\nmedian us"), has_errors},
      {"max_error_s", errors<&EventErrors::maximum>, time("times,\nmax us"), has_errors},
      {"first_error_s", errors<&EventErrors::first>},
      {"last_error_s", errors<&EventErrors::last>},
      {"peak_force_error", errors<&EventErrors::peak_force>, share("peaks,\nmax rel."), has_errors},
      {"striker_velocity_error", errors<&EventErrors::striker_velocity>, share("striker,\nrel."),
       has_errors},
      {"beam_velocity_error", errors<&EventErrors::beam_velocity>},
      {"wall_s", of_point<&Trial::seconds>},
      {"", wall_time, {"wall\ntime", ">10"}, has_run},
      {"repeats", of_point<&Trial::repeats>},
      {"setup_s", work<&Work::setup_seconds>},
      {"steps", work<&Work::steps>},
      {"rejected_steps", work<&Work::rejected_steps>},
      {"right_hand_sides", work<&Work::right_hand_sides>, {"right-hand\nsides", ">10"}, has_run},
      {"mass_solves", work<&Work::mass_solves>, {"mass\nsolves", ">10"}, has_run},
      {"jacobians", work<&Work::jacobians>},
      {"factorisations", work<&Work::factorisations>, {"factori-\nsations", ">8"}, has_run},
      {"message", of_point<&Trial::message>},
  };
  return columns;
}

LoggedPoint row_of(const std::string& id, const std::string& label, const Trial& point) {
  LoggedPoint row{id, label, point.setting.fixed_step ? "step" : "rtol", {}, {}, point};
  if (point.errors.unmatched) {
    row.unmatched_start = point.errors.unmatched->start;
    row.unmatched_duration = point.errors.unmatched->duration;
  }
  return row;
}

// What follows for the point of a row from its other cells.
void complete(LoggedPoint& row) {
  row.point.setting.fixed_step = row.kind == "step";
  if (!row.unmatched_start) return;
  row.point.errors.unmatched =
      UnmatchedSubImpact{*row.unmatched_start, *row.unmatched_duration, {}};
}

// The rows of a file of these columns.
std::vector<LoggedPoint> rows_of(std::istream& file, const std::string& path) {
  const Columns<LoggedPoint> columns = columns_in_file(point_columns());
  std::string line;
  std::getline(file, line);
  bool is_read = line + '\n' == csv_heading(columns);
  std::vector<LoggedPoint> rows;
  while (is_read && std::getline(file, line)) {
    std::istringstream cells(line + ',');
    LoggedPoint& row = rows.emplace_back();
    for (const Column<LoggedPoint>& column : columns) {
      std::string cell;
      is_read = is_read && std::getline(cells, cell, ',') && column.read(cell, row);
    }
  }
  if (is_read) return rows;
  fail<ResultsError>(
      "{}: holds no points of this version of the program; choose another directory with --out, or "
      "remove the file",
      path);
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
    text += printed_row(point_columns(), row_of({}, {}, point));
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

PointLog::PointLog(OutputDirectory& directory, const std::vector<std::string>& cases)
    : directory_(directory), text_(csv_heading(columns_in_file(point_columns()))) {
  const std::optional<Manifest> manifest = read_manifest(directory.path());
  if (!manifest || !manifest->files.contains(file_name)) return;
  const std::string path = (directory.path() / file_name).string();
  std::istringstream file(listed_text(directory.path(), file_name));
  for (LoggedPoint& row : rows_of(file, path)) {
    // What was left out for its time may be run now.
    if (row.point.verdict == Verdict::not_run) continue;
    if (std::find(cases.begin(), cases.end(), row.id) == cases.end()) {
      throw OutputError(
          fmt::format("{}: holds points of another case (or another version of the program), which "
                      "this study would mix with its own; choose another directory with --out, or "
                      "remove the file",
                      path));
    }
    complete(row);
    append_row(text_, columns_in_file(point_columns()), row);
    known_.emplace_back(row.id, row.point);
  }
}

std::optional<Trial> PointLog::known(const std::string& case_id, const Setting& setting) const {
  for (const auto& [id, point] : known_) {
    if (id == case_id && point.setting == setting) return point;
  }
  return std::nullopt;
}

void PointLog::append(const std::string& case_id, const std::string& label, const Trial& point) {
  append_row(text_, columns_in_file(point_columns()), row_of(case_id, label, point));
  write_file(directory_.staging() / file_name, text_);
  directory_.commit();
}

}  // namespace subimpact
