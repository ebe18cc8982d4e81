#include "commands.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <thread>

#include "io/printable.h"
#include "subimpact/io/report.h"
#include "subimpact/report/figures.h"

namespace subimpact::app {

namespace {

// An empty value would count as none.
std::string not_empty(const std::string& text) {
  return text.empty() ? "is empty; give a value, or leave the option out" : std::string();
}

}  // namespace

ExitStatus status_of(OutcomeKind outcome) {
  if (outcome == OutcomeKind::completed || outcome == OutcomeKind::stopped) return done;
  return outcome == OutcomeKind::left_validity ? refused : failed;
}

void print_to(std::FILE* stream, const std::string& text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

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

void JobsOption::add_to(CLI::App& command) {
  command
      .add_option("--jobs", given,
                  "Runs beside one another at most; results do not depend on it. Default: the "
                  "number of processors")
      ->check(CLI::Range(1u, 1024u));
}

Jobs JobsOption::number() const {
  return given > 0 ? given : std::max(1u, std::thread::hardware_concurrency());
}

std::optional<double> seconds_of(const std::string& text) {
  char* rest = nullptr;
  const double value = std::strtod(text.c_str(), &rest);
  if (rest == text.c_str() || !(value > 0.0) || !std::isfinite(value)) return std::nullopt;
  while (*rest == ' ') ++rest;
  constexpr std::pair<std::string_view, double> units[] = {
      {"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  for (const auto& [unit, seconds] : units) {
    if (rest == unit) return value * seconds;
  }
  return std::nullopt;
}

CLI::Option* add_time_option(CLI::App& command, const std::string& names, std::string& text,
                             const std::string& meaning) {
  return command.add_option(names, text, meaning)->check([](const std::string& given) {
    if (seconds_of(given)) return std::string();
    return fmt::format(
        "is \"{}\"; allowed: a time above 0 with its unit, such as 1us, 0.5ms or 20ns", given);
  });
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
