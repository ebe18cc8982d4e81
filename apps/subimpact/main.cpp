#include <fcntl.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>

#include "commands.h"
#include "io/printable.h"
#include "numerics/processor.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace {

std::string version_text() {
  std::string text = "subimpact " + subimpact::project_version();
  for (const auto& [name, version] : subimpact::library_versions()) {
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
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return std::nullopt;
  const std::string near = subimpact::nearest_name(argv[1], names);
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
  const std::string near = subimpact::nearest_name(word, names);
  return fmt::format("unexpected \"{}\"{}", fmt::join(words, " "),
                     near.empty() ? "" : "; did you mean \"" + near + "\"?");
}

std::string usage_error(const CLI::App* program, const CLI::Error& error) {
  std::string command = "subimpact", message = error.what();
  for (const CLI::App* used : program->get_subcommands()) {
    command += " " + used->get_name();
    if (!used->remaining().empty()) message = unexpected_words(*used);
  }
  return subimpact::printable(fmt::format("{}: {}; see {} --help\n", command, message, command));
}

// Whether standard output is a pipe whose reader has ended.
bool is_reader_gone() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) > 0 && (output.revents & POLLERR) != 0;
}

// Ends the program as other programs end whose reader has left: `subimpact keys | head`.
void end_by_broken_pipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
}

// Output that was lost is a failure of the command.
int checked_output(int status) {
  using namespace subimpact;
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  const int cause = errno;
  if (flushed && std::cout.flush()) return status;
  if (is_reader_gone()) end_by_broken_pipe();
  app::print_error(
      "subimpact: standard output cannot be written ({}); free the disk or write the output "
      "elsewhere\n",
      cause != 0 ? std::strerror(cause) : "only a part could be written");
  return status == app::done ? app::failed : status;
}

// A file of the program that took the number of a closed standard stream would receive what is
// printed. The stream gets a place that refuses it in its stead: printing then fails as it should.
bool occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    const int refusing = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", refusing) != stream) return false;
  }
  return true;
}

// "--error-bars off" is "--error-bars=off": its value may be left out, so that CLI11 takes none
// after a blank.
std::vector<std::string> joined(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool is_value = words[i] == "off" || words[i] == "time" || words[i] == "all";
    if (!is_value || words[i - 1] != "--error-bars") continue;
    words[i - 1] += "=" + words[i];
    words.erase(words.begin() + static_cast<std::ptrdiff_t>(i));
  }
  std::ranges::reverse(words);  // as CLI11 takes them
  return words;
}

int run_command_line(int argc, char** argv) {
  using namespace subimpact;
  std::signal(SIGXFSZ, SIG_IGN);  // writing beyond a limit fails then, like writing to a full disk
  std::signal(SIGPIPE, SIG_IGN);  // results come before what is printed, and notes before a run
  int status = app::done;
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
  for (const auto add :
       {app::add_new, app::add_run, app::add_compare, app::add_work_precision, app::add_stability,
        app::add_explain, app::add_report, app::add_python, app::add_listings, app::add_manual}) {
    add(program, status);
  }
  if (const auto message = unknown_command(program, argc, argv)) {
    app::print_error("subimpact: {}\n", *message);
    return app::refused;
  }
  try {
    program.parse(joined(argc, argv));
  } catch (const CLI::ParseError& error) {
    return checked_output(program.exit(error) == 0 ? app::done : app::refused);
  } catch (const Error& error) {
    const bool names_file = error.kind == ErrorKind::case_file || error.kind == ErrorKind::results;
    app::print_error("{}{}\n", names_file ? "" : "subimpact: ", error.what());
    return error.kind == ErrorKind::invalid_case ? app::failed : app::refused;
  } catch (const std::bad_alloc&) {
    app::print_error(
        "subimpact: the memory does not suffice; `subimpact explain` shows what a case takes: use "
        "a coarser mesh, or raise the limit of memory\n");
    return app::failed;
  } catch (const std::exception& error) {
    app::print_error("subimpact: {}\n", error.what());
    return app::failed;
  }
  return checked_output(status);
}

}  // namespace

int main(int argc, char** argv) {
  if (!occupy_closed_streams()) return subimpact::app::failed;
  if (!subimpact::is_processor_sufficient()) {
    std::fputs(subimpact::insufficient_processor, stderr);
    return subimpact::app::failed;
  }
  try {
    return run_command_line(argc, argv);
  } catch (...) {  // while a message was made
    std::fputs("subimpact: no memory is left for a message\n", stderr);
    return subimpact::app::failed;
  }
}
