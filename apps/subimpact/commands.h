#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "subimpact/io/case_file.h"

namespace subimpact::app {

/// What the program tells its caller.
enum ExitStatus : int {
  done = 0,
  refused = 2,       ///< bad command line or case, or a scene the model does not hold for
  failed = 3,        ///< the solver failed, or its results could not be written
  interrupted = 130  ///< by Ctrl-C, as shells report it
};

/// The options of every command that reads a case.
struct CaseOptions {
  std::string file;
  std::string method;
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  /// Throws CaseFileError.
  LoadedCase load() const;
};

/// A check of an option that is a time in seconds.
std::string positive_seconds(const std::string& text);

/// Refuses methods that do not exist or cannot run the case, naming the option. Throws
/// CaseFileError.
void check_methods(const Case& input, const std::vector<std::string>& methods);

// Each adds its command, which leaves the exit status in `status` when it has run.
void add_run(CLI::App& program, int& status);
void add_compare(CLI::App& program, int& status);
void add_work_precision(CLI::App& program, int& status);
void add_stability(CLI::App& program, int& status);
void add_plan(CLI::App& program, int& status);
void add_explain(CLI::App& program, int& status);
void add_plot(CLI::App& program, int& status);
void add_report(CLI::App& program, int& status);
void add_methods(CLI::App& program, int& status);
void add_keys(CLI::App& program, int& status);

}  // namespace subimpact::app
