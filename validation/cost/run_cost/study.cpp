// What `subimpact run` takes at its defaults on ten scenes: beside what its runs take to integrate,
// or beside what `subimpact explain` forecasts.
//
//   subimpact_run_cost [--forecast] [--repeat N] [SCENE...]

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulate/run_parts.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/model/scene_choice.h"
#include "subimpact/study/run_as_asked.h"

namespace {

using namespace subimpact;
namespace fs = std::filesystem;

// Where integrations take this long or longer, all else may take a share of them; else it has a
// fixed allowance.
constexpr double long_enough = 0.05;  // s
constexpr double most_ratio = 1.3;
constexpr double most_besides = 0.015;       // s
constexpr double most_wall_besides = 0.080;  // s

// Of forecasts.
constexpr double most_off = 2.0;  // of time
constexpr std::size_t scenes_off = 1;

struct Cost {
  double processor = 1e9, wall = 1e9;  // s, the smallest
  double memory = 0.0;                 // bytes, the largest
  void join(const Cost& other) {
    processor = std::min(processor, other.processor);
    wall = std::min(wall, other.wall);
    memory = std::max(memory, other.memory);
  }
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// The memory of a child is never below that of this program when it starts the child.
Cost cost_of_program(const char* command, const fs::path& scene, const char* option,
                     const fs::path& place, const fs::path& output = "/dev/null") {
  const auto begun = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDOUT_FILENO);
    execl(SUBIMPACT_PROGRAM, SUBIMPACT_PROGRAM, command, scene.c_str(), option,
          place.empty() ? nullptr : place.c_str(), nullptr);
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) < 0 || status != 0) {
    throw std::runtime_error(fmt::format("{}: {} failed", scene.string(), command));
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun;
  return {seconds_of(used.ru_utime) + seconds_of(used.ru_stime), wall.count(),
          1024.0 * static_cast<double>(used.ru_maxrss)};
}

// The cases of all runs, without rows. The coarse ones that choose the theory and state errors of
// the model are not among them.
std::vector<Case> cases_of(const LoadedCase& loaded) {
  Case input = loaded.value;
  input.output.keep_no_rows();
  std::vector<Case> cases;
  if (choices_left(input, loaded.given, std::nullopt)) {
    RunRequest request;
    request.finished = [&](const Case& run, const Result&) { cases.push_back(run); };
    run_as_asked(input, loaded.given, std::move(request));
  } else {
    cases.push_back(input);
    for (const CaseBeside& other : cases_beside_on_given_mesh(input)) cases.push_back(other.input);
  }
  return cases;
}

double processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Processor time (s) of the steps alone: the model is there, no rows are made.
double integration(const Case& input) {
  ResolvedRun run = resolve(input);
  run.parts().complete();
  const auto integrator = run.parts().make_integrator();
  const double begun = processor_time();
  simulate(run.parts(), *integrator);
  return processor_time() - begun;
}

// Whether both limits hold.
bool report(const fs::path& scene, const fs::path& results, int repetitions) {
  const LoadedCase loaded = read_case_file(scene, {}, choose_scene);
  Cost program;
  const std::vector<Case> cases = cases_of(loaded);
  double integrations = 1e9;
  for (int i = 0; i < repetitions; ++i) {
    program.join(cost_of_program("run", scene, "--out", results));
    double sum = 0.0;
    for (const Case& input : cases) sum += integration(input);
    integrations = std::min(integrations, sum);
  }
  const double besides = program.processor - integrations;
  const bool holds = integrations >= long_enough ? program.processor <= most_ratio * integrations
                                                 : besides <= most_besides;
  const bool wall_holds = program.wall <= integrations + most_wall_besides;
  fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f} | {:.1f} | {:.1f} | {}{} |\n",
             scene.stem().string(), cases.size(), 1e3 * integrations, 1e3 * program.processor,
             program.processor / integrations, 1e3 * besides, 1e3 * (program.wall - integrations),
             holds ? "holds" : "**too much**", wall_holds ? "" : ", **wall time too long**");
  std::fflush(stdout);
  return holds && wall_holds;
}

// How far a forecast of times is off, and whether its memory suffices.
struct Forecast {
  double off = 1.0;
  bool memory_suffices = true;
};

Forecast report_forecast(const fs::path& scene, const fs::path& place, int repetitions) {
  Cost explained, program;
  double processor = 1e9, wall = 1e9, memory = 1e18;
  std::size_t n_runs = 0;
  for (int i = 0; i < repetitions; ++i) {
    explained.join(cost_of_program("explain", scene, "--json", {}, place / "forecast.json"));
    const auto forecast = nlohmann::json::parse(std::ifstream(place / "forecast.json"));
    const auto& expected = forecast.at("expected");
    processor = std::min<double>(processor, expected.at("processor_s"));
    wall = std::min<double>(wall, expected.at("wall_s"));
    memory = std::min<double>(memory, forecast.at("memory_bytes"));
    n_runs = expected.at("runs").size();
    program.join(cost_of_program("run", scene, "--out", place / "results"));
  }
  const double ratio = processor / program.processor;
  const Forecast found{std::max(ratio, 1.0 / ratio), memory >= program.memory};
  fmt::print(
      "| {} | {} | {:.3g} | {:.3g} | {:.2f} | {:.3g} | {:.3g} | {:.2f} | {:.1f} | {:.1f} | "
      "{:.2f} | {:.2g} | {}{} |\n",
      scene.stem().string(), n_runs, processor, program.processor, ratio, wall, program.wall,
      wall / program.wall, 1e-6 * memory, 1e-6 * program.memory, memory / program.memory,
      explained.processor, found.off <= most_off ? "holds" : "**time is off**",
      found.memory_suffices ? "" : ", **memory is too small**");
  std::fflush(stdout);
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("What a run costs besides its integrations");
  int repetitions = 5;
  bool forecast = false;
  std::vector<std::string> scenes;
  program.add_flag("--forecast", forecast);
  program.add_option("--repeat", repetitions)->check(CLI::PositiveNumber);
  program.add_option("scenes", scenes)->check(CLI::ExistingFile);
  CLI11_PARSE(program, argc, argv);
  if (scenes.empty()) {
    for (const auto& entry : fs::directory_iterator(SUBIMPACT_RUN_COST "/scenes")) {
      scenes.push_back(entry.path());
    }
    std::ranges::sort(scenes);
  }
  char place[] = "/tmp/run-cost-XXXXXX";
  if (mkdtemp(place) == nullptr) throw std::runtime_error("no directory for results");
  if (forecast) {
    fmt::print(
        "| scene | runs | processor time forecast, s | taken, s | ratio | wall time forecast, s | "
        "taken, s | ratio | memory forecast, MB | taken, MB | ratio | `explain`, s | |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    std::size_t n_off = 0;
    bool memory_suffices = true;
    for (const std::string& scene : scenes) {
      const Forecast found = report_forecast(scene, place, repetitions);
      if (found.off > most_off) ++n_off;
      memory_suffices = memory_suffices && found.memory_suffices;
    }
    fs::remove_all(place);
    return n_off <= scenes_off && memory_suffices ? 0 : 1;
  }
  fmt::print(
      "| scene | runs | integration, ms | processor time of `run`, ms | ratio | beside, ms | wall "
      "time beyond integration, ms | |\n|---|---|---|---|---|---|---|---|\n");
  bool all = true;
  for (const std::string& scene : scenes) {
    all = report(scene, fs::path(place) / "results", repetitions) && all;
  }
  fs::remove_all(place);
  return all ? 0 : 1;
}
