#pragma once

/// Commands and their options, as data. command_line.cpp alone speaks CLI11.

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace subimpact::app {

/// An option, or an argument by its place: of a name without dashes.
struct Option {
  /// How the values of a list are given.
  enum class List { by_commas, one_by_one, all_that_follow };

  std::string name;  ///< "--out", "CASE"
  /// Where the value goes.
  std::variant<std::string*, std::vector<std::string>*, double*, unsigned*, bool*> value;
  std::string meaning;
  /// Why a text is refused; empty: it is not.
  std::function<std::string(const std::string&)> refusal = {};
  std::vector<std::string> choices = {};   ///< empty: any
  std::vector<std::string> excludes = {};  ///< options beside which it is refused
  std::string needs = {};                  ///< an option without which it is refused
  List list = List::by_commas;
  bool is_required = false;
};

struct Command {
  std::string name, description;
  std::vector<Option> options;
  std::string footer;
  /// Returns the exit status. `rest`: the words that the command takes as they are.
  std::function<int(const std::vector<std::string>& rest)> run;
  bool takes_rest = false;    ///< all words after its name
  bool has_own_help = false;  ///< `--help` is one of them
};

/// A command whose options are held as long as it is. `options_of` lists them with their places.
template <class Held>
Command command_with(const char* name, const char* description, int (*run)(Held&),
                     std::vector<Option> (*options_of)(Held&), std::string footer) {
  const auto held = std::make_shared<Held>();
  return {name, description, options_of(*held), std::move(footer),
          [=](const std::vector<std::string>&) { return run(*held); }};
}

/// A command line that is refused: what is wrong with an option.
struct UsageError : std::runtime_error {
  UsageError(std::string option_name, const std::string& message)
      : std::runtime_error(message), option(std::move(option_name)) {}
  std::string option;
};

/// Runs the command that the words name, and returns its exit status; prints what is asked of the
/// command line itself, and why it is refused.
int run_command_line(int argc, char** argv, const std::vector<Command>& commands);

}  // namespace subimpact::app
