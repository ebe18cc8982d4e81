#pragma once

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "read_file.h"

namespace subimpact {

/// What a process left behind.
struct Finished {
  int status = -1;         ///< exit status; minus the signal's number if one ended it
  std::string output;      ///< stdout
  std::string errors;      ///< stderr
  double megabytes = 0.0;  ///< resident memory at its largest
};

/// Runs the program with these arguments, its streams captured, in the given working directory.
/// `interrupt_after` in ms: sends `signal` then; 0: never. `most_bytes`: of a file that is written;
/// 0: as many as the disk holds.
Finished run_program(const std::vector<std::string>& arguments,
                     const std::filesystem::path& working_directory = ".", int interrupt_after = 0,
                     int signal = SIGINT, unsigned long most_bytes = 0);

/// A directory of the test's own, removed at its end.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  /// Writes a file into it and returns its path.
  std::string write(const std::string& name, const std::string& content) const;

  std::filesystem::path path;
};

}  // namespace subimpact
