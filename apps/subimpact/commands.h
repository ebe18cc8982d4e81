#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "progress.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact::app {

/// Exit statuses of the program; signals have their own.
enum ExitStatus : int {
  done = 0,
  refused = 2,  ///< bad command line or case, or a scene the model does not hold for
  failed = 3    ///< the solver failed, or its results could not be written
};

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

struct CaseOptions {
  std::string file;
  std::string method;
  std::vector<std::string> settings;
  std::string within;       // empty, or a time with its unit
  std::string opening;      // empty, or a length with its unit
  bool may_repeat = false;  // whether the command takes repeat.strikes

  void add_to(CLI::App& command);
  void add_within_to(CLI::App& command);
  void add_opening_to(CLI::App& command);
  /// Without --method, for commands that run methods of their own choice.
  void add_case_to(CLI::App& command);
  /// With `by_options` after the settings of --set and --method. Throws CaseFileError.
  LoadedCase load(const std::vector<Override>& by_options = {}) const;
  /// The case file's name without its ending, and this ending, in the current directory.
  std::string directory_with(const std::string& ending) const;
};

/// A check of an option: an empty value would count as none.
std::string not_empty(const std::string& text);

/// A check of an option whose text is refused where `fits` is false. `allowed`: what fits, in
/// words.
template <class Fits>
auto refused_unless(Fits fits, const std::string& allowed) {
  return [=](const std::string& text) {
    return fits(text) ? std::string() : fmt::format("is \"{}\"; allowed: {}", text, allowed);
  };
}

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

/// Prints on stderr which of the keys given have no effect, unless `quiet`, and which values are
/// doubtful, which it returns.
std::vector<std::string> print_doubts(const LoadedCase& loaded, bool quiet = false);
void print_warnings(const std::vector<std::string>& warnings);

/// Writes files and puts them in place, once their content has been printed: without room for them
/// it is not lost. False, with a message, if they cannot be written.
bool write_after_printing(OutputDirectory& directory,
                          const std::function<void(const std::filesystem::path&)>& write);

Jobs n_processors();
void add_jobs_option(CLI::App& command, Jobs& jobs);

struct StudyOptions {
  CaseOptions input;
  std::vector<std::string> methods;
  std::string directory;
  Jobs jobs = n_processors();
};

/// A time above 0 with its unit, in seconds: "1us", "0.5 ms", "20ns", "2e-7s". Nothing for any
/// other text; a number alone has no unit.
std::optional<double> seconds_of(const std::string& text);

CLI::Option* add_time_option(CLI::App& command, const std::string& names, std::string& text,
                             const std::string& meaning);

CLI::Option* add_seconds_option(CLI::App& command, const std::string& name, double& seconds,
                                const std::string& meaning);

/// An option whose values are separated by commas.
inline CLI::Option* add_list_option(CLI::App& command, const std::string& name,
                                    std::vector<std::string>& values, const std::string& meaning) {
  return command.add_option(name, values, meaning)->delimiter(',');
}

/// A list of values of a key that has choices.
inline CLI::Option* add_choices_option(CLI::App& command, const std::string& name,
                                       std::vector<std::string>& values, const char* key,
                                       const std::string& meaning) {
  return add_list_option(command, name, values, meaning)
      ->check(CLI::IsMember(find_case_key(key)->choice_names()));
}

/// Refuses methods and tables that do not exist, naming the option --methods. Throws CaseFileError.
void check_method_names(const std::vector<std::string>& methods);
/// The same, and throws InvalidCase for a method that cannot run the case.
void check_methods(const Case& input, const std::vector<std::string>& methods);

inline std::string title_of(const Case& input) {
  return input.title.empty() ? "untitled case" : input.title;
}

/// What runs, and whether the program was asked to end.
struct StudySession {
  InterruptListener listener;
  StatusLine status;

  Progress progress() {
    return [this](double) { return !listener.interrupted(); };
  }
  /// The exit status of a study that has ended, or was interrupted.
  int end(bool is_interrupted, int status, const std::string& what_is_left) {
    return is_interrupted ? end_interrupted(what_is_left) : status;
  }
  /// The exit status after a message that begins with "interrupted".
  int end_interrupted(const std::string& what_is_left) {
    print_error("subimpact: interrupted{}\n", what_is_left);
    return listener.exit_status();
  }
};

/// Adds a command, which leaves the exit status that `run` returns in `status`. Returns the command
/// and its options, which live as long as the command.
template <class Options>
std::pair<CLI::App&, Options&> add_command(CLI::App& program, int& status, const char* name,
                                           const char* description, int (*run)(Options&)) {
  CLI::App* command = program.add_subcommand(name, description);
  const auto options = std::make_shared<Options>();
  command->callback([=, &status] { status = run(*options); });
  return {*command, *options};
}

using AddCommands = void(CLI::App& program, int& status);
AddCommands add_run, add_compare, add_work_precision, add_stability, add_explain, add_new,
    add_report, add_python, add_listings, add_manual;

}  // namespace subimpact::app
