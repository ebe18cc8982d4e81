#include "commands.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "case/keys/units.h"
#include "io/printable.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/model.h"

namespace subimpact::app {
namespace {

// A refusal of a text that does not fit. `allowed`: what fits, in words.
template <class Fits>
auto refused_unless(Fits fits, const std::string& allowed) {
  return [=](const std::string& text) {
    return fits(text) ? std::string() : fmt::format("is \"{}\"; allowed: {}", text, allowed);
  };
}

// Of a number without a unit; what else is wrong is said of its key.
auto unless_with_unit(const std::string& example) {
  return refused_unless([](const std::string& text) { return !split_unit(text).unit.empty(); },
                        "a number with its unit, such as " + example);
}

}  // namespace

void print_to(std::FILE* stream, const std::string& text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

std::string not_empty(const std::string& text) {
  return text.empty() ? "is empty; give a value, or leave the option out" : std::string();
}

Option of_directory(std::string& directory, const std::string& meaning) {
  return {"--out", &directory, meaning, not_empty};
}

std::vector<Option> CaseOptions::of_case() {
  Option set = {
      "--set", &settings,
      "table.key=value, instead of the value in the case file; table.key=default: as if the "
      "file did not have the key (but for a title); may be repeated: the last one holds"};
  set.list = Option::List::one_by_one;
  Option of_file = {"CASE", &file, "Case file (TOML); `subimpact keys` lists its keys"};
  of_file.is_required = true;
  return {of_file, set};
}

std::vector<Option> CaseOptions::of_case_and_method() {
  return of_case() +
         std::vector<Option>{
             {"--method", &method,
              "Time integration method, instead of solver.method; see `subimpact methods`",
              not_empty}};
}

Option CaseOptions::of_within() {
  return {"--within", &within,
          "Bound on the error of every event time, with its unit: 1us. The program "
          "chooses what the case leaves open of mesh, method and tolerance. Instead of "
          "accuracy.event_times",
          unless_with_unit("1us")};
}

Option CaseOptions::of_opening() {
  return {"--opening", &opening,
          "Contacts between which striker and beam part by less than this length, with its "
          "unit, are joined: 1um. Instead of output.opening",
          unless_with_unit("1um")};
}

LoadedCase CaseOptions::load() const {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  if (!method.empty()) overrides.push_back({"solver.method", method, "--method " + method});
  if (!within.empty()) overrides.push_back({"accuracy.event_times", within, "--within " + within});
  if (!opening.empty()) overrides.push_back({"output.opening", opening, "--opening " + opening});
  LoadedCase loaded = read_case_file(file, overrides, choose_scene);
  if (may_repeat || loaded.value.strikes == 1) return loaded;
  throw CaseFileError(loaded.message(InvalidCase(
      "repeat.strikes", fmt::format("is {}, but only `subimpact run` strikes more than once; "
                                    "allowed here: 1; add --set repeat.strikes=1",
                                    loaded.value.strikes))));
}

std::string CaseOptions::directory_with(const std::string& ending) const {
  return std::filesystem::path(file).stem().string() + ending;
}

Jobs n_processors() { return std::max(1u, std::thread::hardware_concurrency()); }

Option of_jobs(Jobs& jobs) {
  return {"--jobs", &jobs,
          "Largest number of runs in parallel; results do not depend on it. Default: the "
          "number of processors",
          refused_unless(
              [](const std::string& text) {
                const double n = std::strtod(text.c_str(), nullptr);
                return n >= 1.0 && n <= 1024.0 && n == std::floor(n);
              },
              "a whole number from 1 to 1024")};
}

Option of_seconds(const char* name, double& seconds, const std::string& meaning) {
  const auto fits = [](const std::string& text) {
    const double value = std::strtod(text.c_str(), nullptr);
    return value > 0.0 && std::isfinite(value);
  };
  return {name, &seconds, meaning, refused_unless(fits, "seconds, finite and above 0")};
}

Option of_choices(const char* name, std::vector<std::string>& values, const char* key,
                  const std::string& meaning) {
  return {name, &values, meaning, {}, find_case_key(key)->choice_names()};
}

std::vector<std::string> print_doubts(const LoadedCase& loaded, bool quiet) {
  if (!quiet) {
    for (const std::string& note : loaded.notes()) print_error("subimpact: note: {}\n", note);
  }
  std::vector<std::string> doubts = doubtful_units(loaded.value);
  print_warnings(doubts);
  return doubts;
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
  return true;
}

void check_methods(const Case& input, const std::vector<std::string>& methods) {
  for (const std::string& method : methods) {
    try {
      settings_of(input, method);
    } catch (const InvalidCase& error) {
      throw CaseFileError(fmt::format("--methods {}: {} {}", method, error.key, error.message));
    }
  }
}

void note_swept(const LoadedCase& loaded) {
  for (const char* key : {"solver.rtol", "solver.step"}) {
    if (!loaded.given.contain(key)) continue;
    print_error("subimpact: note: {} has no effect here: the study sweeps it\n", key);
  }
}

}  // namespace subimpact::app
