#pragma once

/// A finished run, read back from its files.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Thrown if files of a run are missing or do not have the format of write_results(); `what()`
/// names file and line, what was found, and what to do.
class ResultsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct FinishedRun {
  Case input;
  Result result;
  std::string program_version;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
};

/// The inverse of write_results(). Throws ResultsError.
FinishedRun read_results(const std::filesystem::path& directory);

}  // namespace subimpact
