#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// The version of the layout of summary.json, its key "layout": raised when a key is renamed, moved
/// or removed. Files of other layouts are not read.
constexpr int summary_layout = 6;

/// Writes the files of a run (docs/files.md); `report`: its report_json(), for `subimpact
/// report`, or empty. Numbers in CSV carry 17 significant digits, enough to read the same double
/// back. All files appear together, with a manifest.json, or none does (see OutputDirectory).
/// Throws OutputError.
void write_results(const std::filesystem::path& directory, const Case& input, const Result& result,
                   const std::string& report = {});

/// Rough size (bytes) of the files of a run: its rows, with as many points in a shape as
/// output.shape_points allows, and without the shapes of events.
double expected_bytes(const Case& input);

/// write_results() for a run that has not begun: the directory is locked and checked to be writable
/// before the run, and rows are written to their files as they are made.
///
///     ResultWriter files(directory, input);
///     const Result result = simulate(input, {}, nullptr, &files);
///     files.finish(input, result);
class ResultWriter final : public RowSink {
 public:
  /// Throws OutputError, also if the disk has less room than expected_bytes(input).
  ResultWriter(const std::filesystem::path& directory, const Case& input);
  ~ResultWriter() override;

  void add(const HistoryRow& row) override;
  void add(const SectionRow& row) override;
  void add(const PointRow& row) override;
  void add(const ShapeRow& row) override;

  /// Discards the rows so far: another run begins.
  void restart();

  /// Writes the other files and puts all in place. Throws OutputError, also if rows could not be
  /// written before (a full disk); the older files are then unchanged.
  void finish(const Case& input, const Result& result, const std::string& report = {});

  const OutputDirectory& directory() const { return directory_; }

 private:
  class RowFile;
  template <class Use>
  void for_each_file(Use use);

  OutputDirectory directory_;
  std::unique_ptr<RowFile> history_, sections_, points_, shapes_;  // none: no such rows
  std::string lost_;                                               // why rows could not be written
};

/// JSON has no infinity and no NaN: an infinite setting is written as the text "inf", a result that
/// is not finite as null.
std::string summary_json(const Case& input, const Result& result);

/// The CSV tables of a run and their columns.
std::string column_listing();

std::string project_version();

/// Name and version of every library that the program uses.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace subimpact
