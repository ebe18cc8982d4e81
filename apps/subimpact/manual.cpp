// The manual page and the completion of bash, made from the commands and options themselves.

#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>

#include "commands.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace subimpact::app {
namespace {

struct ManualOptions {
  const CLI::App* program = nullptr;
};

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// A line of text as groff sets it.
std::string roff(std::string text) {
  replace_all(text, "\\", "\\e");
  replace_all(text, "-", "\\-");
  if (text.starts_with('.') || text.starts_with('\'')) text.insert(0, "\\&");
  return text;
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

// What may follow an option, or stand in place of a positional argument; empty: a file.
std::vector<std::string> words_after(const CLI::Option& option) {
  const std::string name = option.get_name();
  if (name == "--set") {
    std::vector<std::string> keys;
    for (const CaseKey& key : case_keys()) keys.push_back(key.name + "=");
    return keys;
  }
  if (name == "--method" || name == "--methods") {
    return find_case_key("solver.method")->choice_names();
  }
  const std::string type = option.get_type_name();  // "TEXT:{a,b}"
  const std::size_t from = type.find('{'), to = type.find('}');
  if (to == type.npos || from > to) return {};
  std::vector<std::string> words;
  for (const auto word : std::views::split(type.substr(from + 1, to - from - 1), ',')) {
    words.emplace_back(word.begin(), word.end());
  }
  return words;
}

int print_completion(ManualOptions& options) {
  const auto commands = options.program->get_subcommands({});
  const auto names_of = [](const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options({})) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
  };
  app::print(
      "# Completion of bash for subimpact, as `subimpact completion` prints it.\n"
      "_subimpact() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} last=${{COMP_WORDS[COMP_CWORD-1]}} words=\n"
      "  COMPREPLY=()\n"
      "  if ((COMP_CWORD == 1)); then\n"
      "    words='{} {}'\n"
      "  else\n"
      "    case ${{COMP_WORDS[1]}} in\n",
      fmt::join(commands | std::views::transform([](const auto* c) { return c->get_name(); }), " "),
      fmt::join(names_of(*options.program), " "));
  for (const CLI::App* command : commands) {
    app::print("      {})\n        case $last in\n", command->get_name());
    std::vector<std::string> first;
    for (const CLI::Option* option : command->get_options({})) {
      const std::vector<std::string> words = words_after(*option);
      if (option->get_positional()) {
        first.insert(first.end(), words.begin(), words.end());
      } else if (option->get_items_expected_max() > 0) {
        app::print("          --{}) words='{}' ;;\n", fmt::join(option->get_lnames(), "|--"),
                   fmt::join(words, " "));
      }
    }
    app::print(
        "          *) words='{}'\n            [[ $word != -* ]] || words='{}' ;;\n        esac "
        ";;\n",
        fmt::join(first, " "), fmt::join(names_of(*command), " "));
  }
  app::print(
      "    esac\n"
      "  fi\n"
      "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
      "  [[ ${{#COMPREPLY[@]}} -ne 1 || $COMPREPLY != *= ]] || compopt -o nospace\n"
      "}}\n"
      "complete -o default -F _subimpact subimpact\n");
  return done;
}

}  // namespace

void add_manual(CLI::App& program, int& status) {
  auto [manual, manual_options] = add_command(
      program, status, "manual", "Print the manual page of all commands, for man", print_manual);
  manual.footer("Example:\n  subimpact manual | man -l -");
  manual_options.program = &program;
  auto [completion, completion_options] =
      add_command(program, status, "completion",
                  "Print the completion of commands and options for bash", print_completion);
  completion.footer(
      "Example, in ~/.bashrc, where no package has put it in place:\n  source <(subimpact "
      "completion)");
  completion_options.program = &program;
}

}  // namespace subimpact::app
