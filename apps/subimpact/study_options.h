#pragma once

#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "progress.h"
#include "subimpact/simulate/result.h"

namespace subimpact::app {

/// Options of commands that make several runs of a case.
struct StudyOptions {
  CaseOptions input;
  std::vector<std::string> methods;
  std::string directory;
  JobsOption jobs;
};

/// An option whose values are separated by commas.
inline CLI::Option* add_list_option(CLI::App& command, const std::string& name,
                                    std::vector<std::string>& values, const std::string& meaning) {
  return command.add_option(name, values, meaning)->delimiter(',');
}

/// An option that is a time in seconds and has a default.
CLI::Option* add_seconds_option(CLI::App& command, const std::string& name, double& seconds,
                                const std::string& meaning);

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
  /// The exit status after a message that begins with "interrupted".
  int end_interrupted(const std::string& what_is_left) {
    print_error("subimpact: interrupted{}\n", what_is_left);
    return listener.exit_status();
  }
};

/// Adds a command that has these options and runs by `run`, which returns the exit status.
template <class Options>
void add_command(CLI::App& program, int& status, const char* name, const char* description,
                 void (*add_options)(CLI::App&, Options&), int (*run)(Options)) {
  CLI::App* command = program.add_subcommand(name, description);
  const auto options = std::make_shared<Options>();
  add_options(*command, *options);
  command->callback([=, &status] { status = run(*options); });
}

}  // namespace subimpact::app
