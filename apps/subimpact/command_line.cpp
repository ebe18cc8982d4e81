#include "command_line.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <ranges>

#include "commands.h"
#include "io/printable.h"
#include "subimpact/io/results.h"

namespace subimpact::app {
namespace {

std::string version_text() {
  std::string text = "subimpact " + project_version();
  for (const auto& [name, version] : library_versions()) {
    text += fmt::format("\n  {} {}", name, version);
  }
  return text;
}

// CLI11's own message is that a command is missing.
std::optional<std::string> unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2) return std::nullopt;
  if (argv[1][0] == '-') {
    if (program.get_option_no_throw(argv[1]) != nullptr) return std::nullopt;
    return fmt::format("unknown option \"{}\"; a command comes first; see subimpact --help",
                       argv[1]);
  }
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  if (std::ranges::find(names, argv[1]) != names.end()) return std::nullopt;
  const std::string near = nearest_name(argv[1], names);
  return fmt::format("unknown command \"{}\"; allowed: {}; {}", argv[1], fmt::join(names, ", "),
                     near.empty() ? "see subimpact --help" : "did you mean \"" + near + "\"?");
}

// CLI11's own message has the words in reverse.
std::string unexpected_words(const CLI::App& command) {
  const std::vector<std::string> words = command.remaining();
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  const std::string word = words.front().substr(0, words.front().find('='));
  const std::string near = nearest_name(word, names);
  return fmt::format("unexpected \"{}\"{}", fmt::join(words, " "),
                     near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

std::string usage_error(const CLI::App* program, const CLI::Error& error) {
  std::string command = "subimpact", message = error.what();
  for (const CLI::App* used : program->get_subcommands()) {
    command += " " + used->get_name();
    if (!used->remaining().empty()) message = unexpected_words(*used);
  }
  return printable(fmt::format("{}: {}; see {} --help\n", command, message, command));
}

CLI::Option* added(CLI::App& to, const Option& option) {
  if (const auto* flag = std::get_if<bool*>(&option.value)) {
    return to.add_flag(option.name, **flag, option.meaning);
  }
  return std::visit([&](auto* value) { return to.add_option(option.name, *value, option.meaning); },
                    option.value);
}

void add(CLI::App& to, const Option& option) {
  CLI::Option* made = added(to, option);
  if (option.refusal) made->check(option.refusal);
  if (!option.choices.empty()) made->check(CLI::IsMember(option.choices));
  if (option.is_required) made->required();
  if (std::holds_alternative<std::vector<std::string>*>(option.value)) {
    if (option.list == Option::List::by_commas) made->delimiter(',');
    if (option.list == Option::List::one_by_one) made->allow_extra_args(false);
  }
  if (std::holds_alternative<double*>(option.value)) made->capture_default_str();
  if (!option.needs.empty()) made->needs(to.get_option(option.needs));
  for (const std::string& other : option.excludes) made->excludes(to.get_option(other));
}

void add(CLI::App& program, int& status, const Command& command) {
  CLI::App* made = program.add_subcommand(command.name, command.description);
  for (const Option& option : command.options) add(*made, option);
  made->footer(command.footer);
  if (command.takes_rest) made->prefix_command();
  if (command.has_own_help) made->set_help_flag();
  made->callback([&command, &status, made] {
    try {
      status = command.run(command.takes_rest ? made->remaining() : std::vector<std::string>());
    } catch (const UsageError& error) {
      throw CLI::ValidationError(error.option, error.what());
    }
  });
}

// --- the manual page, made from the commands and options themselves ------------------------------

// A line of text as groff sets it.
std::string roff(const std::string& text) {
  std::string line = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) line += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  return line;
}

// Paragraphs; lines that begin with two blanks, commands, are set as they are.
void print_text(const std::string& text) {
  bool is_literal = false;
  for (const auto part : std::views::split(text, '\n')) {
    const std::string line(part.begin(), part.end());
    const bool literal = line.starts_with("  ");
    if (literal != is_literal) print("{}\n", literal ? ".PP\n.nf\n.RS 2" : ".RE\n.fi");
    is_literal = literal;
    print("{}{}\n", literal || line.empty() ? "" : ".PP\n", roff(line.substr(literal ? 2 : 0)));
  }
  if (is_literal) print(".RE\n.fi\n");
}

// "--out DIR", "CASE": with the placeholder that --help shows.
std::string shown_name(const CLI::Option& option) {
  std::string name = option.get_name(false, true);
  if (option.get_items_expected_max() > 0) name += " " + option.get_type_name();
  return name;
}

void print_options(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options({})) {
    print(".TP\n.B {}\n{}\n", roff(shown_name(*option)), roff(option->get_description()));
  }
}

// A command that prints its own help does so here, set as it is.
void print_own_help(const Command& command) {
  print(".PP\n.nf\n.tr -\\-\n");
  command.run({"--help"});
  print(".tr --\n.fi\n");
}

void print_manual(const CLI::App& program, const std::vector<Command>& commands) {
  print(".TH SUBIMPACT 1 \"\" \"subimpact {}\" \"User commands\"\n", project_version());
  print(".SH NAME\nsubimpact \\- sub\\-impacts of a rigid mass that strikes a beam\n");
  print(".SH SYNOPSIS\n.B subimpact\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n");
  print_text(program.get_description());
  print_text(program.get_footer());
  print(".SH OPTIONS\n");
  print_options(program);
  print(".SH COMMANDS\n");
  for (const CLI::App* command : program.get_subcommands({})) {
    print(".SS subimpact {}\n", roff(command->get_name()));
    print_text(command->get_description() + ".");
    const auto own = std::ranges::find(commands, command->get_name(), &Command::name);
    if (own != commands.end() && own->has_own_help) {
      print_own_help(*own);
      continue;
    }
    print_options(*command);
    print_text(command->get_footer());
  }
  print(".SH KEYS OF A CASE FILE\n");
  for (const CaseKey& key : case_keys()) {
    print(".TP\n.B {}\n{}\n", roff(key.name), roff(key.meaning));
  }
}

}  // namespace

int run_command_line(int argc, char** argv, const std::vector<Command>& commands) {
  int status = done;
  CLI::App program("Finds every sub-impact when a rigid mass strikes an elasto-plastic beam.",
                   "subimpact");
  program.footer(
      "Examples:\n"
      "  subimpact new hammer > case.toml\n"
      "  subimpact explain case.toml\n"
      "  subimpact run case.toml --out out/first\n"
      "  subimpact plot out/first\n"
      "  subimpact compare case.toml --methods central-difference,erk,exponential\n"
      "  subimpact run --help\n"
      "Exit status: 0 done; 2 bad command line or case file; 3 a check, the solver, a figure or "
      "the writing failed; 128 and the signal's number: stopped (130 by Ctrl-C).");
  program.set_version_flag("--version", version_text,
                           "Print the versions of program and libraries");
  program.require_subcommand(1);
  program.failure_message(usage_error);
  for (const Command& command : commands) add(program, status, command);
  const Command manual = {"manual",
                          "Print the manual page of all commands, for man",
                          {},
                          "Example:\n  subimpact manual | man -l -",
                          [&](const auto&) -> int {
                            print_manual(program, commands);
                            return done;
                          }};
  add(program, status, manual);
  if (const auto message = unknown_command(program, argc, argv)) {
    print_error("subimpact: {}\n", *message);
    return refused;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? done : refused;
  }
  return status;
}

}  // namespace subimpact::app
