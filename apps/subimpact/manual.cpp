// The manual page, made from the commands and options themselves, and the completion of bash.

#include <ranges>

#include "commands.h"
#include "report/files.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace subimpact::app {
namespace {

struct ManualOptions {
  const CLI::App* program = nullptr;
};

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

int print_manual(ManualOptions& options) {
  const CLI::App& program = *options.program;
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
    print_options(*command);
    print_text(command->get_footer());
  }
  print(".SH KEYS OF A CASE FILE\n");
  for (const CaseKey& key : case_keys()) {
    print(".TP\n.B {}\n{}\n", roff(key.name), roff(key.meaning));
  }
  return done;
}

int print_completion(ManualOptions&) {
  print("{}", embedded_file("../../apps/subimpact/completion.bash"));
  return done;
}

}  // namespace

void add_manual(CLI::App& program, int& status) {
  auto [manual, manual_options] = add_command(
      program, status, "manual", "Print the manual page of all commands, for man", print_manual);
  manual.footer("Example:\n  subimpact manual | man -l -");
  manual_options.program = &program;
  add_command(program, status, "completion",
              "Print the completion of commands and options for bash", print_completion)
      .first.footer(
          "Example, in ~/.bashrc, where no package has put it in place:\n  source <(subimpact "
          "completion)");
}

}  // namespace subimpact::app
