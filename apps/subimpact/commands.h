#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "command_line.h"
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

/// Prints a text without control characters. A failure is left to the stream: main() checks stdout.
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

  void add_case(CLI::App& command);  ///< CASE and --set
  void add_method(CLI::App& command);
  void add_within(CLI::App& command);
  void add_opening(CLI::App& command);
  /// Throws CaseFileError.
  LoadedCase load() const;
  /// The case file's name without its ending, and this ending, in the current directory.
  std::string directory_with(const std::string& ending) const;
};

/// Options that several commands have. `add_directory`: --out.
CLI::Option* add_directory(CLI::App& command, std::string& directory, const std::string& meaning);
void add_jobs(CLI::App& command, Jobs& jobs);
void add_seconds(CLI::App& command, const char* name, double& seconds, const std::string& meaning);
/// A list of values, separated by commas; of a key that has choices.
CLI::Option* add_list(CLI::App& command, const char* name, std::vector<std::string>& values,
                      const std::string& meaning);
CLI::Option* add_choices(CLI::App& command, const char* name, std::vector<std::string>& values,
                         const char* key, const std::string& meaning);
/// A refusal of an empty text, which would count as none.
std::string not_empty(const std::string& text);

/// What `body` returns. An InvalidCase becomes a CaseFileError with the place of its key.
template <class Body>
auto with_places(const LoadedCase& loaded, Body body) {
  try {
    return body();
  } catch (const InvalidCase& error) {
    throw CaseFileError(loaded.message(error));
  }
}

/// Prints which of the keys given have no effect, unless `quiet`, and which values are doubtful,
/// which it returns.
std::vector<std::string> print_doubts(const LoadedCase& loaded, bool quiet = false);
void print_warnings(const std::vector<std::string>& warnings);

/// Writes files and puts them in place, once their content has been printed. False, with a message,
/// if they cannot be written.
bool write_after_printing(OutputDirectory& directory,
                          const std::function<void(const std::filesystem::path&)>& write);

Jobs n_processors();

struct StudyOptions {
  CaseOptions input;
  std::vector<std::string> methods;
  std::string directory;
  Jobs jobs = n_processors();
};

/// Refuses methods that do not exist or cannot run the case, naming the option --methods. Throws
/// CaseFileError.
void check_methods(const Case& input, const std::vector<std::string>& methods);

inline std::string title_of(const Case& input) {
  return input.title.empty() ? "untitled case" : input.title;
}

/// Says which settings of a case have no effect in a study that sweeps them.
void note_swept(const LoadedCase& loaded);

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

void add_new_command(Program&), add_run_command(Program&), add_compare_command(Program&),
    add_work_precision_command(Program&), add_stability_command(Program&),
    add_explain_command(Program&), add_report_command(Program&), add_python_commands(Program&),
    add_listing_commands(Program&);

/// The module of a command that takes its arguments, and prints its help, itself; else null.
const char* module_of(const std::string& command);

/// Runs a module of Python's package subimpact with these arguments, its streams being those of the
/// program, and returns its exit status: 128 and the number of a signal that ended it. Where a
/// module is missing, one line on stderr says what to install, and the status is `refused`.
int run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace subimpact::app
