#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "io/csv_columns.h"
#include "io/sealed_files.h"
#include "io/write_file.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/io/versions.h"
#include "subimpact/io/work_precision.h"

namespace subimpact {

static bool read_cell(std::string_view cell, Verdict& verdict) {
  return read_choice(cell, verdict,
                     {Verdict::right, Verdict::wrong_count, Verdict::inaccurate, Verdict::unstable,
                      Verdict::failed, Verdict::refused, Verdict::not_run});
}

namespace {

constexpr const char* file_name = "work_precision.csv";

// A row of the file.
struct LoggedPoint {
  std::string id, label;  // of the case
  std::string kind;       // of the setting
  std::optional<double> unmatched_start, unmatched_duration;
  WorkPrecisionPoint point;
};

// The member of a row that a path of members leads to.
template <auto... members>
constexpr auto member = [](auto& row) -> auto& {
  return (row.*....*members);
};

template <auto found>
constexpr auto errors = member<&LoggedPoint::point, &WorkPrecisionPoint::errors, found>;
template <auto count>
constexpr auto work = member<&LoggedPoint::point, &WorkPrecisionPoint::work, count>;
template <auto part>
constexpr auto of_setting = member<&LoggedPoint::point, &WorkPrecisionPoint::setting, part>;

const Columns<LoggedPoint>& point_columns() {
  static const Columns<LoggedPoint> columns = {
      {"case", &LoggedPoint::id},
      {"label", &LoggedPoint::label},
      {"method", of_setting<&Setting::method>},
      {"kind", &LoggedPoint::kind},
      {"setting", of_setting<&Setting::value>},
      {"verdict", member<&LoggedPoint::point, &WorkPrecisionPoint::verdict>},
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"sub_impacts", errors<&EventErrors::n_found>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"first_odd_s", &LoggedPoint::unmatched_start},
      {"odd_duration_s", &LoggedPoint::unmatched_duration},
      {"median_error_s", errors<&EventErrors::median>},
      {"max_error_s", errors<&EventErrors::maximum>},
      {"first_error_s", errors<&EventErrors::first>},
      {"last_error_s", errors<&EventErrors::last>},
      {"peak_force_error", errors<&EventErrors::peak_force>},
      {"striker_velocity_error", errors<&EventErrors::striker_velocity>},
      {"beam_velocity_error", errors<&EventErrors::beam_velocity>},
      {"wall_s", member<&LoggedPoint::point, &WorkPrecisionPoint::seconds>},
      {"repeats", member<&LoggedPoint::point, &WorkPrecisionPoint::repeats>},
      {"setup_s", work<&Work::setup_seconds>},
      {"steps", work<&Work::steps>},
      {"rejected_steps", work<&Work::rejected_steps>},
      {"right_hand_sides", work<&Work::right_hand_sides>},
      {"mass_solves", work<&Work::mass_solves>},
      {"jacobians", work<&Work::jacobians>},
      {"factorisations", work<&Work::factorisations>},
      {"message", member<&LoggedPoint::point, &WorkPrecisionPoint::message>},
  };
  return columns;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line + ',');  // an empty last cell counts too
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

// A row that was written whole; nothing for one that an interruption cut short.
std::optional<LoggedPoint> row_of(const std::string& line) {
  const Columns<LoggedPoint>& columns = point_columns();
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != columns.size()) return std::nullopt;
  LoggedPoint row;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (!columns[k].read(cells[k], row)) return std::nullopt;
  }
  row.point.setting.fixed_step = row.kind == "step";
  if (row.unmatched_start)
    row.point.errors.unmatched =
        UnmatchedSubImpact{*row.unmatched_start, *row.unmatched_duration, {}};
  return row;
}

std::string key_of(const std::string& id, const Setting& setting) {
  return fmt::format("{} {} {} {:.17g}", id, setting.method, setting.fixed_step, setting.value);
}

}  // namespace

std::string case_id(const Case& input) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  const auto add = [&](const std::string& text) {
    for (const char c : text) {
      hash ^= static_cast<unsigned char>(c);
      hash *= 1099511628211u;
    }
  };
  add(project_version());
  for (const CaseKey& key : case_keys()) {
    const bool set_by_study = key.name == "solver.method" || key.name == "solver.table" ||
                              key.name == "solver.rtol" || key.name == "solver.step";
    if (set_by_study || key.name == "title" || key.table() == "output") continue;
    const auto value = key.get(input);
    add(key.name + "=" + (value ? to_text(*value) : std::string()) + ";");
  }
  return fmt::format("{:016x}", hash);
}

PointLog::PointLog(OutputDirectory& directory, const std::vector<std::string>& cases)
    : directory_(directory), text_(csv_heading(point_columns())) {
  const SealedFiles files(directory.path());
  if (!files.manifest() || !files.manifest()->files.contains(file_name)) return;
  std::ifstream file = files.open(file_name);
  for (std::string line; std::getline(file, line);) {
    const std::optional<LoggedPoint> row = row_of(line);
    // What was left out for its time may be run now.
    if (!row || row->point.verdict == Verdict::not_run) continue;
    if (std::find(cases.begin(), cases.end(), row->id) == cases.end()) {
      throw OutputError(
          fmt::format("{}: holds points of another case (or another version of the program), which "
                      "this study would mix with its own; choose another directory with --out, or "
                      "remove the file",
                      (directory.path() / file_name).string()));
    }
    text_ += line + '\n';
    known_[key_of(row->id, row->point.setting)] = row->point;
  }
}

std::optional<WorkPrecisionPoint> PointLog::known(const std::string& case_id,
                                                  const Setting& setting) const {
  const auto found = known_.find(key_of(case_id, setting));
  if (found == known_.end()) return std::nullopt;
  return found->second;
}

void PointLog::append(const std::string& case_id, const std::string& label,
                      const WorkPrecisionPoint& point) {
  LoggedPoint row{case_id, label, point.setting.fixed_step ? "step" : "rtol", {}, {}, point};
  if (point.errors.unmatched) {
    row.unmatched_start = point.errors.unmatched->start;
    row.unmatched_duration = point.errors.unmatched->duration;
  }
  append_row(text_, point_columns(), row);
  write_file(directory_.staging() / file_name, text_);
  directory_.commit();
}

}  // namespace subimpact
