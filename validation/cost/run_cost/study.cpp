// What `subimpact run` takes at its defaults on ten scenes, beside what its runs take to integrate.
//
//   subimpact_run_cost [--repeat N] [SCENE...]

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
#include <stdexcept>
#include <string>
#include <vector>

#include "simulate/run_parts.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/model.h"
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

struct Cost {
  double processor = 1e9, wall = 1e9;  // s, the smallest
  void join(const Cost& other) {
    processor = std::min(processor, other.processor);
    wall = std::min(wall, other.wall);
  }
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

Cost cost_of_run(const fs::path& scene, const fs::path& results) {
  const auto begun = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    execl(SUBIMPACT_PROGRAM, SUBIMPACT_PROGRAM, "run", scene.c_str(), "--out", results.c_str(),
          nullptr);
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) < 0 || status != 0) {
    throw std::runtime_error(scene.string() + ": the run failed");
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun;
  return {seconds_of(used.ru_utime) + seconds_of(used.ru_stime), wall.count()};
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
    program.join(cost_of_run(scene, results));
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("What a run costs besides its integrations");
  int repetitions = 5;
  std::vector<std::string> scenes;
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
