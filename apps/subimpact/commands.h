#pragma once

/// What the commands share: exit statuses, printing, options. Each command has its own file.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/io/case_file.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/io/read_results.h"
#include "subimpact/study/companion.h"

namespace subimpact::app {

/// Exit statuses of the program; signals have their own.
enum ExitStatus : int {
  done = 0,
  refused = 2,  ///< bad command line or case, or a scene the model does not hold for
  failed = 3    ///< the solver failed, or its results could not be written
};

/// The exit status of a run that ended so.
ExitStatus status_of(OutcomeKind outcome);

/// Prints a text without control characters, for it may come from files, paths and arguments. A
/// failure is left to the stream: main() checks stdout once.
void print_to(std::FILE* stream, const std::string& text);

template <class... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  print_to(stdout, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void print_error(fmt::format_string<Args...> format, Args&&... args) {
  print_to(stderr, fmt::format(format, std::forward<Args>(args)...));
}

/// The options of every command that reads a case.
struct CaseOptions {
  std::string file;
  std::string method;
  std::vector<std::string> settings;

  void add_to(CLI::App& command);
  /// Without --method, for commands that run methods of their own choice.
  void add_case_to(CLI::App& command);
  /// With `by_options` after the settings of --set and --method. Throws CaseFileError.
  LoadedCase load(const std::vector<Override>& by_options = {}) const;
  /// The case file's name without its ending, and this ending, in the current directory.
  std::string directory_with(const std::string& ending) const;
};

/// The option --out.
CLI::Option* add_directory_option(CLI::App& command, std::string& directory,
                                  const std::string& meaning);

/// What `body` returns. An InvalidCase becomes a CaseFileError with the place of its key.
template <class Body>
auto with_places(const LoadedCase& loaded, Body body) {
  try {
    return body();
  } catch (const InvalidCase& error) {
    throw CaseFileError(loaded.message(error));
  }
}

/// Prints on stderr which of the keys given have no effect.
void print_notes(const LoadedCase& loaded);
/// Prints warnings on stderr, a line each.
void print_warnings(const std::vector<std::string>& warnings);

/// Writes files and puts them in place, once their content has been printed: without room for them
/// it is not lost. False, with a message, if they cannot be written.
bool write_after_printing(OutputDirectory& directory,
                          const std::function<void(const std::filesystem::path&)>& write);

/// Prints on stderr what the figures of a run leave out, and how a run ended that did not complete.
void print_figure_notes(const FinishedRun& run);

/// The option --jobs of commands that run several simulations.
struct JobsOption {
  Jobs given = 0;  ///< 0: not given

  void add_to(CLI::App& command);
  Jobs number() const;
};

/// A time above 0 with its unit, in seconds: "1us", "0.5 ms", "20ns", "2e-7s". Nothing for any
/// other text; a number alone has no unit.
std::optional<double> seconds_of(const std::string& text);

/// An option that takes such a time.
CLI::Option* add_time_option(CLI::App& command, const std::string& names, std::string& text,
                             const std::string& meaning);

/// A check of an option that is a time in seconds.
std::string positive_seconds(const std::string& text);

// Each adds its command, which leaves the exit status in `status` when it has run.
void add_run(CLI::App& program, int& status);
void add_compare(CLI::App& program, int& status);
void add_work_precision(CLI::App& program, int& status);
void add_stability(CLI::App& program, int& status);
void add_plan(CLI::App& program, int& status);
void add_sensitivity(CLI::App& program, int& status);
void add_explain(CLI::App& program, int& status);
void add_plot(CLI::App& program, int& status);
void add_report(CLI::App& program, int& status);
void add_methods(CLI::App& program, int& status);
void add_keys(CLI::App& program, int& status);
void add_columns(CLI::App& program, int& status);

}  // namespace subimpact::app
