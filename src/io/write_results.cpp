#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/run_tables.h"
#include "io/write_file.h"
#include "subimpact/io/results.h"

namespace subimpact {

namespace fs = std::filesystem;

/// A table that grows row by row. Rows are collected and written together; what did not fit on the
/// disk is written again elsewhere.
class ResultWriter::RowFile {
 public:
  RowFile(std::string name, std::string heading)
      : name_(std::move(name)), heading_(std::move(heading)), pending_(heading_) {}
  ~RowFile() {
    if (file_ >= 0) close(file_);
  }
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  template <class Row>
  void add(const Columns<Row>& columns, const Row& row) {
    append_row(pending_, columns, row);
  }
  bool is_full() const { return pending_.size() > most_pending; }

  /// Writes the rows collected. Returns 0, or the error's number; the file holds the rows of the
  /// calls before then.
  int write_to(const fs::path& directory) {
    if (file_ < 0) {
      const fs::path path = directory / name_;
      file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (file_ < 0) return errno;
      // A copy of a file that was cut short has part of a row at its end.
      if (ftruncate(file_, n_written_) != 0) return errno;
    }
    if (const int cause = write_all(file_, pending_)) return cause;
    n_written_ += static_cast<off_t>(pending_.size());
    pending_.clear();
    return 0;
  }

  /// Discards all rows; the file is opened again and cut short.
  void restart() {
    leave_directory();
    pending_ = heading_;
    n_written_ = 0;
  }

  /// The file is opened again, in another directory.
  void leave_directory() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }

 private:
  static constexpr std::size_t most_pending = 1 << 18;

  std::string name_;
  std::string heading_;
  std::string pending_;
  int file_ = -1;
  off_t n_written_ = 0;
};

namespace {

// Of the paper's example.
constexpr double bytes_per_history_row = 345.0;
constexpr double bytes_per_section_row = 97.0;

void check_space(const OutputDirectory& directory, const Case& input) {
  std::error_code error;
  const auto available = static_cast<double>(fs::space(directory.path(), error).available);
  const double foreseen = foreseen_bytes(input);
  if (error || foreseen <= available) return;
  throw OutputError(
      fmt::format("{}: the rows of this run take some {:.2g} GB, and the disk has {:.2g} GB free; "
                  "use a longer output.interval, or choose another directory with --out",
                  directory.path().string(), 1e-9 * foreseen, 1e-9 * available));
}

}  // namespace

double foreseen_bytes(const Case& input) {
  if (!(input.output.interval > 0.0)) return 0.0;
  const double n_sections = static_cast<double>(input.output.sections.size());
  return input.end_time / input.output.interval *
         (bytes_per_history_row + n_sections * bytes_per_section_row);
}

ResultWriter::ResultWriter(const fs::path& directory, const Case& input)
    : directory_(directory, "run"),
      history_(std::make_unique<RowFile>("history.csv", csv_heading(history_columns()))) {
  check_space(directory_, input);
  if (input.output.sections.empty()) return;
  sections_ = std::make_unique<RowFile>("sections.csv", csv_heading(sections_columns()));
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add(const HistoryRow& row) {
  history_->add(history_columns(), row);
  if (history_->is_full()) flush(*history_);
}

void ResultWriter::add(const SectionRow& row) {
  sections_->add(sections_columns(), row);
  if (sections_->is_full()) flush(*sections_);
}

void ResultWriter::restart() {
  history_->restart();
  if (sections_) sections_->restart();
}

void ResultWriter::flush(RowFile& rows) {
  if (!lost_.empty()) return;
  try {
    write_or_relocate([&] { write_rows(rows); });
  } catch (const OutputError& error) {  // the run goes on: its events can still be printed
    lost_ = error.what();
  }
}

template <class Write>
void ResultWriter::write_or_relocate(Write write) {
  for (;;) {
    try {
      write();
      return;
    } catch (const OutputError& error) {
      directory_.relocate(error.what());  // throws the second time
      history_->leave_directory();
      if (sections_) sections_->leave_directory();
    }
  }
}

void ResultWriter::write_rows(RowFile& rows) {
  if (const int cause = rows.write_to(directory_.staging())) {
    throw OutputError(fmt::format("{}: cannot be written ({})", directory_.path().string(),
                                  std::strerror(cause)));
  }
}

void ResultWriter::finish(const Case& input, const Result& result) {
  if (!lost_.empty()) throw OutputError(lost_);
  write_or_relocate([&] {
    const fs::path& place = directory_.staging();
    write_rows(*history_);
    if (sections_) write_rows(*sections_);
    write_file(place / "events.csv", events_csv(result));
    write_file(place / "transitions.csv", transitions_csv(result.transitions));
    write_file(place / "summary.json", summary_json(input, result));
    directory_.commit();
  });
}

void write_results(const fs::path& directory, const Case& input, const Result& result) {
  ResultWriter files(directory, input);
  for (const HistoryRow& row : result.history) files.add(row);
  for (const SectionRow& row : result.section_history) files.add(row);
  files.finish(input, result);
}

void write_comparison(const fs::path& directory, const Comparison& comparison) {
  write_file(directory / "comparison.csv", comparison_csv(comparison));
  write_file(directory / "matches.csv", matches_csv(comparison));
}

}  // namespace subimpact
