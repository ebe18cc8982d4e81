#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "io/csv_text.h"
#include "io/write_file.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/io/versions.h"
#include "subimpact/io/work_precision.h"

namespace subimpact {
namespace {

constexpr const char* header =
    "case,label,method,kind,setting,verdict,reference_sub_impacts,sub_impacts,corresponding,"
    "first_odd_s,odd_duration_s,median_error_s,max_error_s,first_error_s,last_error_s,"
    "peak_force_error,striker_velocity_error,beam_velocity_error,wall_s,repeats,setup_s,steps,"
    "rejected_steps,right_hand_sides,mass_solves,jacobians,factorisations,message\n";

constexpr Verdict verdicts[] = {Verdict::right,    Verdict::wrong_count, Verdict::inaccurate,
                                Verdict::unstable, Verdict::failed,      Verdict::refused,
                                Verdict::not_run};

std::size_t whole(long value) { return static_cast<std::size_t>(value); }

std::string row(const std::string& id, const std::string& label, const WorkPrecisionPoint& point) {
  const EventErrors& errors = point.errors;
  const Work& work = point.work;
  CsvText csv("");
  csv.word(id).word(label).word(point.setting.method);
  csv.word(point.setting.fixed_step ? "step" : "rtol").number(point.setting.value);
  csv.word(to_string(point.verdict));
  csv.whole(errors.n_reference).whole(errors.n_found).whole(errors.n_corresponding);
  if (errors.odd) {
    csv.number(errors.odd->start).number(errors.odd->duration);
  } else {
    csv.empty().empty();
  }
  csv.number(errors.median).number(errors.maximum).number(errors.first).number(errors.last);
  csv.number(errors.peak_force).number(errors.striker_velocity).number(errors.beam_velocity);
  csv.number(point.seconds).whole(static_cast<std::size_t>(point.repeats));
  csv.number(work.setup_seconds);
  for (const long count : {work.steps, work.rejected_steps, work.right_hand_sides, work.mass_solves,
                           work.jacobians, work.factorisations}) {
    csv.whole(whole(count));
  }
  csv.text(point.message).end_row();
  return csv.str();
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

// A row that was written whole; nothing for one that an interruption cut short.
std::optional<WorkPrecisionPoint> point_of(const std::vector<std::string>& cells) {
  if (cells.size() != 28) return std::nullopt;
  WorkPrecisionPoint point;
  point.setting = {cells[2], cells[3] == "step", number(cells[4])};
  const auto verdict = std::find_if(std::begin(verdicts), std::end(verdicts),
                                    [&](Verdict v) { return to_string(v) == cells[5]; });
  if (verdict == std::end(verdicts)) return std::nullopt;
  point.verdict = *verdict;
  const auto count = [&](std::size_t i) { return std::strtol(cells[i].c_str(), nullptr, 10); };
  EventErrors& errors = point.errors;
  errors.n_reference = static_cast<std::size_t>(count(6));
  errors.n_found = static_cast<std::size_t>(count(7));
  errors.n_corresponding = static_cast<std::size_t>(count(8));
  if (!cells[9].empty()) errors.odd = OddSubImpact{number(cells[9]), number(cells[10]), {}};
  errors.median = number(cells[11]);
  errors.maximum = number(cells[12]);
  errors.first = number(cells[13]);
  errors.last = number(cells[14]);
  errors.peak_force = number(cells[15]);
  errors.striker_velocity = number(cells[16]);
  errors.beam_velocity = number(cells[17]);
  point.seconds = number(cells[18]);
  point.repeats = static_cast<int>(count(19));
  Work& work = point.work;
  work.setup_seconds = number(cells[20]);
  work.steps = count(21);
  work.rejected_steps = count(22);
  work.right_hand_sides = count(23);
  work.mass_solves = count(24);
  work.jacobians = count(25);
  work.factorisations = count(26);
  point.message = cells[27];
  return point;
}

std::string key_of(const std::string& id, const Setting& setting) {
  return fmt::format("{} {} {} {:.17g}", id, setting.method, setting.fixed_step, setting.value);
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw OutputError(
      fmt::format("{}: cannot be written ({}); free the disk or choose another "
                  "directory with --out",
                  path.string(), std::strerror(errno)));
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

PointLog::PointLog(const std::filesystem::path& directory, const std::vector<std::string>& cases)
    : path_(directory / "work_precision.csv") {
  std::string kept;
  std::ifstream file(path_);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> cells = cells_of(line);
    const auto point = point_of(cells);
    // What was left out for its time may be run now.
    if (!point || point->verdict == Verdict::not_run) continue;
    if (std::find(cases.begin(), cases.end(), cells[0]) == cases.end()) {
      throw OutputError(
          fmt::format("{}: holds points of another case (or another version of the program), which "
                      "this study would mix with its own; choose another directory with --out, or "
                      "remove the file",
                      path_.string()));
    }
    kept += line + '\n';
    known_[key_of(cells[0], point->setting)] = *point;
  }
  file.close();
  write_file(path_, header + kept);
}

std::optional<WorkPrecisionPoint> PointLog::known(const std::string& case_id,
                                                  const Setting& setting) const {
  const auto found = known_.find(key_of(case_id, setting));
  if (found == known_.end()) return std::nullopt;
  return found->second;
}

void PointLog::append(const std::string& case_id, const std::string& label,
                      const WorkPrecisionPoint& point) {
  errno = 0;
  std::ofstream file(path_, std::ios::app);
  if (!(file << row(case_id, label, point) << std::flush)) fail(path_);
}

}  // namespace subimpact
