#pragma once

/// The program and its commands, on CLI11.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <string>

namespace subimpact::app {

struct Program : CLI::App {
  using CLI::App::App;
  int status = 0;  ///< that the command returns
};

/// Adds a command that has no options, or takes its words as they are (CLI::App::remaining()).
CLI::App& add_command(Program& program, const char* name, const char* description,
                      const std::string& footer, std::function<int(const CLI::App&)> run);

/// Adds a command whose options are held as long as it is. `add_options` adds them with their
/// places.
template <class Held>
void add_command(Program& program, const char* name, const char* description, int (*run)(Held&),
                 void (*add_options)(CLI::App&, Held&), const std::string& footer) {
  const auto held = std::make_shared<Held>();
  add_options(
      add_command(program, name, description, footer, [=](const CLI::App&) { return run(*held); }),
      *held);
}

/// Runs the command that the words name, and returns its exit status; prints what is asked of the
/// command line itself, and why it is refused.
int run_command_line(int argc, char** argv);

}  // namespace subimpact::app
