#pragma once

/// A finished run, read back from its files.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

struct FinishedRun {
  Case input;
  /// Of more than some 400,000 history rows, `history` and `section_history` hold those that show
  /// the run's course and extremes; `n_history_rows` is the number in the file.
  Result result;
  std::string identity;  ///< from manifest.json; empty for files of an older version
  std::string program_version;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

/// The inverse of write_results(). All files are of one run, as it wrote them: each is compared
/// with the checksum in manifest.json. Throws ResultsError.
FinishedRun read_results(const std::filesystem::path& directory);

}  // namespace subimpact
