#include "judgement/cost.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include "strikes.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::judgement {
namespace {

constexpr unsigned jobs = 2;
constexpr double least_seconds = 2.0;  // of a measurement
constexpr int most_repetitions = 200;

struct Cost {
  double wall = 0.0, processor = 0.0;  // s
  double memory = 0.0;                 // MB, the largest
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// In a process of its own.
Cost cost_of(const std::function<void()>& task, int n) {
  const auto begun = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) {
    for (int i = 0; i < n; ++i) task();
    _exit(0);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) < 0 || status != 0) {
    throw std::runtime_error("a run that is measured failed");
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begun;
  return {wall.count() / n, (seconds_of(used.ru_utime) + seconds_of(used.ru_stime)) / n,
          1e-3 * static_cast<double>(used.ru_maxrss)};
}

Cost cost_of(const std::function<void()>& task) {
  const Cost once = cost_of(task, 1);
  const double n = least_seconds / std::max(once.wall, 1e-6);
  return n < 2.0 ? once : cost_of(task, static_cast<int>(std::min(n, 1.0 * most_repetitions)));
}

void print_row(const std::string& name, const Case& input, const GivenKeys& given) {
  const Case chosen = case_as_chosen(input, given, jobs);
  const Cost alone = cost_of([&] { simulate(chosen); });
  const Cost judged = cost_of([&] { simulate_judged(chosen, cases_beside(chosen), jobs); });
  const Cost all = cost_of([&] {
    RunRequest request;
    request.jobs = jobs;
    run_as_asked(input, given, std::move(request));
  });
  fmt::print("| {} | {:.3g} s, {:.0f} MB | {:.2f}, {:.2f}, {:.2f} | {:.2f}, {:.2f}, {:.2f} |\n",
             name, alone.wall, alone.memory, judged.wall / alone.wall,
             judged.processor / alone.processor, judged.memory / alone.memory,
             all.wall / alone.wall, all.processor / alone.processor, all.memory / alone.memory);
}

// Without its mesh and method.
Case open_scene(const Case& drawn) {
  Case input = drawn;
  input.model = {};
  input.model.section = drawn.model.section;
  input.solver = {};
  return input;
}

}  // namespace

void study_cost(const std::vector<std::string>& files) {
  fmt::print(
      "| case | run alone | judged: wall time on two cores, processor time, memory over these "
      "| all runs of the choice, over these |\n|---|---|---|---|\n");
  for (const std::string& file : files) {
    const LoadedCase loaded = read_case_file(file);
    print_row(std::filesystem::path(file).stem(), loaded.value, loaded.given);
  }
  int n_elastic = 0;
  for (int number = 0; n_elastic < 3; ++number) {
    const Case drawn = strikes::draw(16, number, {1.0}).input;
    if (drawn.model.section != SectionKind::elastic) continue;
    print_row(fmt::format("elastic scene {}", ++n_elastic), open_scene(drawn), {});
  }
}

}  // namespace subimpact::judgement
