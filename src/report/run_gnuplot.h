#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace subimpact {

/// What a process of gnuplot left behind.
struct GnuplotRun {
  int start_error = 0;         ///< errno if gnuplot could not be started, else 0
  int status = 0;              ///< of its exit; minus the signal's number if one ended it
  bool took_too_long = false;  ///< and was ended
  std::string output, errors;
};

/// Runs gnuplot in a directory, with its default settings: neither ~/.gnuplot nor the variables of
/// the environment that gnuplot obeys have an effect. It is ended at the deadline, and with this
/// process.
GnuplotRun run_gnuplot(const std::filesystem::path& directory, std::vector<std::string> arguments,
                       std::chrono::steady_clock::time_point deadline);

}  // namespace subimpact
