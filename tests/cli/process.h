#pragma once

#include <sys/wait.h>

#include <csignal>

#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {

/// What a process left behind.
struct Finished {
  int status = -1;         ///< exit status; minus the signal's number if one ended it
  std::string output;      ///< stdout
  std::string errors;      ///< stderr
  double megabytes = 0.0;  ///< resident memory at its largest
};

using Words = std::vector<std::string>;

/// Runs the program with these arguments, its streams captured, in the given working directory.
/// `interrupt_after` in ms: sends `signal` then; 0: never. `most_bytes`: of a file that is written;
/// 0: as many as the disk holds.
Finished run_program(const Words& arguments, const std::filesystem::path& working_directory = ".",
                     int interrupt_after = 0, int signal = SIGINT, unsigned long most_bytes = 0);

/// The same in a directory of the test, expected to end with that status.
inline Finished run_in(const TemporaryDirectory& directory, const Words& arguments,
                       int status = 0) {
  const Finished finished = run_program(arguments, directory.path);
  EXPECT_EQ(finished.status, status) << testing::PrintToString(arguments) << finished.errors;
  return finished;
}

/// The same where the program leaves no files.
inline Finished run_anywhere(const Words& arguments, int status = 0) {
  const TemporaryDirectory directory;
  const Finished finished = run_in(directory, arguments, status);
  EXPECT_TRUE(std::filesystem::is_empty(directory.path)) << testing::PrintToString(arguments);
  return finished;
}

/// The exit status of a line for the shell, in which `subimpact` stands for the program.
inline int shell(const std::string& line, const std::filesystem::path& directory) {
  const std::string whole = "cd '" + directory.string() + "' && subimpact() { '" +
                            SUBIMPACT_PROGRAM + "' \"$@\"; } && " + line;
  return WEXITSTATUS(std::system(whole.c_str()));
}

/// The paper's scene, with mesh and method left to the program.
inline const std::string open_case =
    "title = \"open\"\n"
    "beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, "
    "youngs_modulus = 71.96e9, yield_stress = 150e6 }\n"
    "striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }\n"
    "time = { end = 0.25e-3 }\n";

/// A command on the paper's case with settings and, before them, other arguments.
inline Words paper(const std::string& command, const Words& settings = {}, const Words& more = {}) {
  Words words = {command, SUBIMPACT_PAPER_CASE};
  words.insert(words.end(), more.begin(), more.end());
  for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
  return words;
}

}  // namespace subimpact
