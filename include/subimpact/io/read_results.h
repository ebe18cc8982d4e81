#pragma once

/// Finished runs and sweeps, read back from their files.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

struct FinishedRun {
  Case input;
  /// If the file has more than about 400,000 history rows, `history` and `section_history` hold
  /// only rows that show the run's course and extremes; `n_history_rows` is the number in the file.
  Result result;
  std::string identity;  ///< from manifest.json; empty for files of an older version
  std::string program_version;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

/// The inverse of write_results(). Each file is compared with its checksum in manifest.json, so
/// that all are of one run and unchanged. Throws ResultsError.
FinishedRun read_results(const std::filesystem::path& directory);

/// The tables of a population of runs, as `subimpact-sweep` writes them.
struct SweptRuns {
  /// A column of runs.csv with one value per run: numbers, NaN where a cell is empty; or words, if
  /// some cell is not a number.
  struct Column {
    std::string name;
    bool is_key = false;  ///< of the case, with different values
    std::vector<double> numbers;
    std::vector<std::string> words;
  };
  std::string identity;         ///< of these tables; empty if no manifest.json has one
  std::vector<long> numbers;    ///< of the runs, in the plan
  std::vector<Column> columns;  ///< without those that have no values
  std::vector<std::vector<SubImpact>> sub_impacts;  ///< one list per run

  /// nullptr if there is no such column, or one without values.
  const Column* find(std::string_view name) const;
};

/// Whether a directory holds the tables of a sweep, and not the files of one run.
bool holds_sweep(const std::filesystem::path& directory);

/// Reads runs.csv and sub_impacts.csv; if there is a manifest.json, the files must be those that it
/// lists. Throws ResultsError with file, line, what was found and what to do; also if there is no
/// run.
SweptRuns read_sweep(const std::filesystem::path& directory);

}  // namespace subimpact
