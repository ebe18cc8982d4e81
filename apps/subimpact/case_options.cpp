#include "commands.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "print.h"
#include "subimpact/io/report.h"
#include "subimpact/report/figures.h"

namespace subimpact::app {

namespace {

// An empty value would count as none.
std::string not_empty(const std::string& text) {
  return text.empty() ? "is empty; give a value, or leave the option out" : std::string();
}

}  // namespace

CLI::Option* add_directory_option(CLI::App& command, std::string& directory,
                                  const std::string& meaning) {
  return command.add_option("--out", directory, meaning)->check(not_empty);
}

void CaseOptions::add_to(CLI::App& command) {
  add_case_to(command);
  command
      .add_option("--method", method,
                  "Time integration method, instead of solver.method; see `subimpact methods`")
      ->check(not_empty);
}

void CaseOptions::add_case_to(CLI::App& command) {
  command.add_option("CASE", file, "Case file (TOML); `subimpact keys` lists its keys")->required();
  command
      .add_option(
          "--set", settings,
          "table.key=value, instead of the value in the case file; table.key=default: as if the "
          "file did not have the key (but for a title); may be repeated: the last one holds")
      ->allow_extra_args(false);
}

LoadedCase CaseOptions::load(const std::vector<Override>& by_options) const {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  if (!method.empty()) overrides.push_back({"solver.method", method, "--method " + method});
  overrides.insert(overrides.end(), by_options.begin(), by_options.end());
  return read_case_file(file, overrides);
}

std::string CaseOptions::directory_with(const std::string& ending) const {
  return std::filesystem::path(file).stem().string() + ending;
}

void print_notes(const LoadedCase& loaded) {
  for (const std::string& note : loaded.notes()) print_error("subimpact: note: {}\n", note);
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    print_error("subimpact: warning: {}\n", warning);
  }
}

bool write_after_printing(OutputDirectory& directory,
                          const std::function<void(const std::filesystem::path&)>& write) {
  std::fflush(stdout);
  try {
    write(directory.staging());
    directory.commit();
  } catch (const OutputError& error) {
    print_error("subimpact: {}\n", error.what());
    return false;
  }
  print_warnings(directory.notes());
  return true;
}

void print_figure_notes(const FinishedRun& run) {
  for (const std::string& reason : figures_left_out(run.input, run.result)) {
    print_error("subimpact: note: not drawn: {}\n", reason);
  }
  const std::string caveat = outcome_caveat(run.result);
  if (!caveat.empty()) print_warnings({caveat});
}

}  // namespace subimpact::app
