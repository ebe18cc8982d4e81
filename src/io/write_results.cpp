#include <fcntl.h>
#include <unistd.h>

#include <any>
#include <cerrno>
#include <cstring>

#include "io/directory/listed_files.h"
#include "io/records/run_record.h"
#include "io/records/run_tables.h"
#include "simulate/settings/refuse.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"

namespace subimpact {

namespace fs = std::filesystem;

/// A table that grows row by row. Rows are collected and written together.
class ResultWriter::RowFile {
 public:
  template <class Row>
  RowFile(ResultWriter& writer, const RunTable<Row>& table, const OutputOptions& output = {})
      : writer_(writer),
        name_(table.file),
        columns_(table.columns_of(output)),
        heading_(csv_heading(std::any_cast<const Columns<Row>&>(columns_))),
        pending_(heading_) {}
  ~RowFile() { leave_directory(); }
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  template <class Row>
  void add(const Row& row) {
    append_row(pending_, std::any_cast<const Columns<Row>&>(columns_), row, numbers_);
    if (pending_.size() <= most_pending || !writer_.lost_.empty()) return;
    try {
      write();
    } catch (const OutputError& error) {  // the run goes on: its events can still be printed
      writer_.lost_ = error.what();
    }
  }

  /// Writes the rows collected. Throws OutputError.
  void write() {
    const OutputDirectory& directory = writer_.directory_;
    const fs::path path = directory.staging() / name_;
    constexpr int flags = O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC;
    if (file_ < 0) file_ = open(path.c_str(), flags, 0666);
    if (const int cause = file_ < 0 ? errno : write_all(file_, pending_); cause != 0) {
      fail<OutputError>("{}: cannot be written ({})", directory.path().string(),
                        std::strerror(cause));
    }
    pending_.clear();
  }

  /// Discards all rows.
  void restart() {
    leave_directory();
    pending_ = heading_;
  }

 private:
  static constexpr std::size_t most_pending = 1 << 18;

  void leave_directory() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }

  ResultWriter& writer_;
  std::string name_;
  std::any columns_;  // Columns of its rows
  std::string heading_;
  std::string pending_;
  NumberWriter numbers_;
  int file_ = -1;
};

namespace {

// Sizes of rows in the paper's example.
constexpr double bytes_per_history_row = 345.0;
constexpr double bytes_per_section_row = 97.0;
constexpr double bytes_per_point_row = 80.0;
constexpr double bytes_per_gauge = 23.0;
constexpr double bytes_per_shape_row = 105.0;

constexpr const char* case_name = "case.toml";

// A user's own case in the directory stays as it is.
bool may_write_case(const fs::path& directory) {
  const std::optional<Manifest> manifest = read_manifest(directory);
  return (manifest && manifest->files.contains(case_name)) || !fs::exists(directory / case_name);
}

// Figures of an older run in their folder; left where another command writes there.
void remove_old_figures(const fs::path& directory) {
  if (!fs::exists(directory / "figures" / manifest_name)) return;
  try {
    OutputDirectory old(directory / "figures", "figures", read_manifest(directory)->identity);
    old.commit();
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch)
  }
}

void check_space(const OutputDirectory& directory, const Case& input) {
  std::error_code error;
  const auto available = static_cast<double>(fs::space(directory.path(), error).available);
  const double expected = expected_bytes(input);
  if (error || expected <= available) return;
  fail<OutputError>(
      "{}: the rows of this run take some {:.2g} GB, and the disk has {:.2g} GB free; use a longer "
      "output.interval, or choose another directory with --out",
      directory.path().string(), 1e-9 * expected, 1e-9 * available);
}

}  // namespace

double expected_bytes(const Case& input) {
  const double interval = input.output.shape_interval(input.end_time);
  const double of_shapes =
      interval > 0.0 ? input.end_time / interval * bytes_per_shape_row * input.output.shape_points
                     : 0.0;
  if (!input.output.has_history()) return of_shapes;
  const double bytes_per_row =
      bytes_per_history_row +
      bytes_per_section_row * static_cast<double>(input.output.sections.size()) +
      bytes_per_point_row * static_cast<double>(input.output.points.size()) +
      bytes_per_gauge * static_cast<double>(input.output.gauges.size());
  return of_shapes + input.end_time / input.output.history_interval(input.end_time) * bytes_per_row;
}

ResultWriter::ResultWriter(const fs::path& directory, const Case& input)
    : directory_(directory, "run") {
  check_space(directory_, input);
  const OutputOptions& output = input.output;
  history_ = std::make_unique<RowFile>(*this, run_table<HistoryRow>(), output);
  if (!output.sections.empty()) {
    sections_ = std::make_unique<RowFile>(*this, run_table<SectionRow>());
  }
  if (!output.points.empty()) points_ = std::make_unique<RowFile>(*this, run_table<PointRow>());
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add(const HistoryRow& row) { history_->add(row); }
void ResultWriter::add(const SectionRow& row) { sections_->add(row); }
void ResultWriter::add(const PointRow& row) { points_->add(row); }
void ResultWriter::add(const ShapeRow& row) {
  if (!shapes_) shapes_ = std::make_unique<RowFile>(*this, run_table<ShapeRow>());
  shapes_->add(row);
}

template <class Use>
void ResultWriter::for_each_file(Use use) {
  for (const auto* file : {&history_, &sections_, &points_, &shapes_}) {
    if (*file) use(**file);
  }
}

void ResultWriter::restart() {
  for_each_file([](RowFile& file) { file.restart(); });
}

void ResultWriter::finish(const Case& input, const Result& result, const std::string& report) {
  if (!lost_.empty()) throw OutputError(lost_);
  const fs::path& place = directory_.staging();
  for_each_file([](RowFile& file) { file.write(); });
  const auto write_table = [&]<class Row>(const RunTable<Row>& table) {
    write_file(place / table.file, csv_of<Row>(result));
  };
  if (input.strikes > 1) write_table(run_table<StrikeRow>());
  if (!result.envelope.empty()) write_table(run_table<EnvelopeRow>());
  write_table(run_table<SubImpact>());
  write_table(run_table<Transition>());
  if (input.scene.beam.may_lift()) write_table(run_table<SupportContact>());
  write_file(place / "summary.json", summary_json(input, result));
  if (!report.empty()) write_file(place / "report.json", report);
  if (may_write_case(directory_.path())) write_file(place / case_name, case_file_text(input));
  directory_.commit();
  remove_old_figures(directory_.path());
}

void write_results(const fs::path& directory, const Case& input, const Result& result,
                   const std::string& report) {
  ResultWriter files(directory, input);
  for (const HistoryRow& row : result.history) files.add(row);
  for (const SectionRow& row : result.section_history) files.add(row);
  for (const PointRow& row : result.point_history) files.add(row);
  for (const ShapeRow& row : result.shapes) files.add(row);
  files.finish(input, result, report);
}

}  // namespace subimpact
