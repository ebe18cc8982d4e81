#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace subimpact {

/// What a process left behind.
struct Finished {
  int status = -1;     ///< exit status; minus the signal's number if one ended it
  std::string output;  ///< stdout
  std::string errors;  ///< stderr
};

/// Runs the program with these arguments, its streams captured, in the given working directory.
/// `interrupt_after` in ms: sends SIGINT then; 0: never.
Finished run_program(const std::vector<std::string>& arguments,
                     const std::filesystem::path& working_directory = ".", int interrupt_after = 0);

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

std::string read_file(const std::filesystem::path& path);

}  // namespace subimpact
