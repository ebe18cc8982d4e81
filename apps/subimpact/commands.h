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

  /// CASE and --set.
  std::vector<Option> of_case();
  /// These and --method.
  std::vector<Option> of_case_and_method();
  Option of_within();
  Option of_opening();
  /// Throws CaseFileError.
  LoadedCase load() const;
  /// The case file's name without its ending, and this ending, in the current directory.
  std::string directory_with(const std::string& ending) const;
};

/// Options that several commands have. `of_directory`: --out.
Option of_directory(std::string& directory, const std::string& meaning);
Option of_jobs(Jobs& jobs);
Option of_seconds(const char* name, double& seconds, const std::string& meaning);
/// A list of values of a key that has choices.
Option of_choices(const char* name, std::vector<std::string>& values, const char* key,
                  const std::string& meaning);
/// A refusal of an empty text, which would count as none.
std::string not_empty(const std::string& text);

inline std::vector<Option> operator+(std::vector<Option> first, const std::vector<Option>& more) {
  first.insert(first.end(), more.begin(), more.end());
  return first;
}

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

Command new_command(), run_command(), compare_command(), work_precision_command(),
    stability_command(), explain_command(), report_command();
std::vector<Command> python_commands(), listing_commands();

/// Runs a module of Python's package subimpact with these arguments, its streams being those of the
/// program, and returns its exit status: 128 and the number of a signal that ended it. Where a
/// module is missing, one line on stderr says what to install, and the status is `refused`.
int run_python(const std::string& module, const std::vector<std::string>& arguments);

}  // namespace subimpact::app
