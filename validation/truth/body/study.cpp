// Parts of the errors of the body as a run states them, beside the same changes on the mesh of the
// run, on random scenes.
//
//   subimpact_body [--seed S] [--scenes N] [--first K] [--jobs J] [--verbose] [--case] [--file
//   FILE]

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include "body/scenes.h"
#include "case/meshes.h"
#include "io/records/run_record.h"
#include "study/method_choice.h"
#include "study/model/body_runs.h"
#include "study/model/coarse_strike.h"
#include "study/parallel.h"
#include "subimpact/io/case_file.h"
#include "subimpact/study/model.h"
#include "subimpact/study/run_as_asked.h"

namespace {

using namespace subimpact;

constexpr double factor = 1.5, small = 0.1;  // of the sum
constexpr const char* figure_names[] = {"parting",     "force",       "velocity", "set",
                                        "impulse",     "restitution", "dent",     "indentation",
                                        "contact end", "rest"};

struct Count {
  int n = 0, right = 0, n_large = 0, n_known = 0;
};

struct Found {
  std::map<std::string, Count> of_part, of_figure;
  int n = 0, n_refused = 0, n_failed = 0, n_missing = 0, n_absurd = 0, n_too_dear = 0;
  double run_seconds = 0.0, body_seconds = 0.0;
  std::string lines;
};

// Processor time of this thread.
double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const std::function<void()>& task) {
  const double begun = processor_seconds();
  task();
  return processor_seconds() - begun;
}

// On the mesh of the run, or where that cannot model the variant on one as fine.
std::optional<Result> full_run(Case input, const Result& run) {
  input.output.keep_no_rows();
  input.output.shapes = input.end_time;
  input.stop = StopRule::end_time;
  if (run.n_yielded_sections == 0) input.model.section = SectionKind::elastic;
  const bool bends = descriptor_of(input.model.mesh).bends;
  if (bends && input.scene.beam.shears() && input.model.mesh == MeshKind::hermite) {
    input.model.mesh = MeshKind::spectral;
    input.model.elements = 2 * (input.model.elements / 4 + 1);
  }
  input.solver.method = possible_method(input, input.solver.method);
  std::optional<Result> result = coarse_run(input);
  return result && result->outcome.completed() ? result : std::nullopt;
}

// The error of the computation that a run states of a figure.
double computed_error(const Result& run, std::size_t figure) {
  constexpr const char* names[] = {"",
                                   "peak_force_N",
                                   "striker_velocity_m_per_s",
                                   "permanent_set_m",
                                   "impulse_Ns",
                                   "restitution",
                                   "residual_indentation_m",
                                   "max_indentation_m",
                                   "",
                                   ""};
  if (!run.error_estimate) return 0.0;
  for (const auto& [name, total] : run.error_estimate->totals) {
    if (to_string(name) == names[figure]) return total.error.value_or(0.0);
  }
  const StrikeFigures value = figures_of(run);
  for (const SubImpact& s : run.sub_impacts) {
    if (s.end && s.end == value.*strike_figures[figure]) return s.end_error.value_or(0.0);
  }
  return 0.0;
}

class Scene {
 public:
  Scene(LoadedCase loaded, int number, Found& found)
      : loaded_(std::move(loaded)), number_(number), found_(found) {}

  void study() {
    RunRequest request;
    request.jobs = 1;
    request.body_errors = false;
    WithinRun run{};
    found_.run_seconds += run_seconds_ =
        seconds_of([&] { run = run_as_asked(loaded_.value, loaded_.given, std::move(request)); });
    if (!run.result.outcome.completed() || run.result.sub_impacts.empty()) {
      ++found_.n_failed;
      return;
    }
    const double taken = seconds_of([&] { add_body_errors(run.input, run.result); });
    found_.body_seconds += taken;
    if (taken > std::max(0.03, 0.25 * run_seconds_)) {
      ++found_.n_too_dear;
      say(fmt::format("took {:.0f} ms beside {:.0f}", 1e3 * taken, 1e3 * run_seconds_));
    }
    ++found_.n;
    if (run.result.body_errors) compare(run);
  }

 private:
  void say(const std::string& line) {
    found_.lines += fmt::format("  scene {}: {}\n", number_, line);
  }

  void compare(const WithinRun& run) {
    const BodyErrors& errors = *run.result.body_errors;
    const std::optional<Result> base = full_run(run.input, run.result);
    if (!base) return;
    std::map<BodyPart, StrikeFigures> again;
    for (const BodyVariant& variant : body_variants(run.input, run.result.n_yielded_sections > 0)) {
      StrikeFigures& change = again[variant.kind];
      const std::optional<Result> own = variant.base ? full_run(*variant.base, run.result) : base;
      for (const Case& other : variant.cases) {
        const std::optional<Result> result = full_run(other, run.result);
        if (!result || !own) {
          change = {};
          break;
        }
        const StrikeFigures a = figures_of(*own), b = figures_of(*result);
        for (const auto figure : strike_figures) {
          if (!(a.*figure) || !(b.*figure)) {
            continue;
          }
          change.*figure =
              std::max((change.*figure).value_or(0.0), std::abs(*(a.*figure) - *(b.*figure)));
        }
      }
    }
    for (std::size_t f = 0; f < std::size(strike_figures); ++f) {
      if (errors.value.*strike_figures[f]) compare(run.result, again, f);
    }
  }

  void compare(const Result& result, const std::map<BodyPart, StrikeFigures>& again,
               std::size_t f) {
    const auto figure = strike_figures[f];
    const BodyErrors& errors = *result.body_errors;
    double sum = 0.0;  // by full runs, and formulas
    bool has_all = true;
    for (const BodyErrors::Part& part : errors.parts) {
      const auto full = again.find(part.kind);
      const auto& change = full == again.end() ? part.change.*figure : full->second.*figure;
      has_all = has_all && change;
      sum += change.value_or(0.0);
    }
    const double value = std::abs(*(errors.value.*figure));
    const double noise = computed_error(result, f);
    const bool is_absurd =
        has_all && (errors.at_least.*figure).value_or(0.0) > value + noise && sum < value / 3.0;
    if (is_absurd) {
      ++found_.n_absurd;
      say(fmt::format("{} {:.4g}: absurd, {:.3g} for {:.3g}", figure_names[f], value,
                      *(errors.at_least.*figure), sum));
    }
    bool hides = (errors.error.*figure).has_value();
    for (const BodyErrors::Part& part : errors.parts) hides = hides && (part.change.*figure);
    if (hides != (errors.error.*figure).has_value()) ++found_.n_missing;
    for (const auto& [kind, changes] : again) {
      const auto part = std::ranges::find(errors.parts, kind, &BodyErrors::Part::kind);
      const auto& full = changes.*figure;
      if (part == errors.parts.end()) {
        ++found_.n_missing;
        continue;
      }
      const auto& stated = part->change.*figure;
      const std::string name = name_of(kind);
      for (Count* count : {&found_.of_part[name], &found_.of_figure[figure_names[f]]}) {
        if (full && *full > small * sum && *full > noise) {
          ++count->n_large;
          count->n_known += stated.has_value();
        }
        if (!full || !stated) continue;
        ++count->n;
        count->right += agrees(*stated, *full, sum, noise);
      }
      if (full && stated && !agrees(*stated, *full, sum, noise)) {
        say(fmt::format("{} {:.5g} +- {:.2g}: {} {:.3g}, on the mesh of the run {:.3g}, sum {:.3g}",
                        figure_names[f], value, noise, name, *stated, *full, sum));
      } else if (full && !stated && *full > small * sum && *full > noise) {
        say(fmt::format("{} {:.5g}: {} not known, {:.3g} of {:.3g}", figure_names[f], value, name,
                        *full, sum));
      }
    }
  }

  static bool agrees(double stated, double full, double sum, double noise) {
    const double larger = std::max(stated, full), smaller = std::min(stated, full);
    return larger <= factor * smaller || larger <= small * sum || larger - smaller <= noise;
  }

  LoadedCase loaded_;
  int number_;
  Found& found_;
  double run_seconds_ = 0.0;
};

void print(const std::map<std::string, Count>& counts, const char* of) {
  fmt::print("\n| {} | compared | right | large | of these known |\n|---|---|---|---|---|\n", of);
  Count all;
  const auto row = [](const std::string& name, const Count& c) {
    fmt::print("| {} | {} | {:.1f} % | {} | {:.1f} % |\n", name, c.n,
               100.0 * c.right / std::max(c.n, 1), c.n_large,
               100.0 * c.n_known / std::max(c.n_large, 1));
  };
  for (const auto& [name, c] : counts) {
    row(name, c);
    all = {all.n + c.n, all.right + c.right, all.n_large + c.n_large, all.n_known + c.n_known};
  }
  row("all", all);
}

void add(std::map<std::string, Count>& to, const std::map<std::string, Count>& from) {
  for (const auto& [name, c] : from) {
    Count& sum = to[name];
    sum = {sum.n + c.n, sum.right + c.right, sum.n_large + c.n_large, sum.n_known + c.n_known};
  }
}

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

Found study(const std::string& text, int number) {
  Found found;
  try {
    Scene(read_case_text(text, "scene", {}, choose_scene), number, found).study();
  } catch (const std::exception& error) {
    ++found.n_refused;
    found.lines += fmt::format("  scene {}: {}\n", number, error.what());
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("parts of the errors of the body beside the same changes on the mesh of the run");
  std::uint64_t seed = 1;
  int n_scenes = 200, first = 0;
  unsigned jobs = 2;
  bool verbose = false, prints_case = false;
  std::vector<std::string> files;
  app.add_option("--seed", seed, "of the scenes");
  app.add_option("--scenes", n_scenes, "how many");
  app.add_option("--first", first, "number of the first");
  app.add_option("--jobs", jobs, "scenes at a time");
  app.add_flag("--verbose", verbose, "print what differs");
  app.add_flag("--case", prints_case, "print the case file of the first and run nothing");
  app.add_option("--file", files, "these cases instead of scenes");
  CLI11_PARSE(app, argc, argv);
  if (prints_case) {
    fmt::print("{}", body::case_text(seed, first));
    return 0;
  }
  std::vector<std::string> texts;
  for (const std::string& file : files) texts.push_back(text_of(file));
  for (int k = 0; files.empty() && k < n_scenes; ++k)
    texts.push_back(body::case_text(seed, first + k));
  Found all;
  std::mutex mutex;
  in_parallel(texts.size(), jobs, [&](std::size_t k) {
    const Found found = study(texts[k], first + static_cast<int>(k));
    const std::lock_guard lock(mutex);
    add(all.of_part, found.of_part);
    add(all.of_figure, found.of_figure);
    for (auto member : {&Found::n, &Found::n_refused, &Found::n_failed, &Found::n_missing,
                        &Found::n_absurd, &Found::n_too_dear}) {
      all.*member += found.*member;
    }
    all.run_seconds += found.run_seconds;
    all.body_seconds += found.body_seconds;
    if (verbose) fmt::print("{}", found.lines);
    std::fflush(stdout);
  });
  fmt::print(
      "{} scenes ({} more refused, {} without contact or end), {} parts missing without a word, {} "
      "sums absurd\n",
      all.n, all.n_refused, all.n_failed, all.n_missing, all.n_absurd);
  fmt::print(
      "errors of the body took {:.1f} s beside {:.1f} s of runs, {} times above a quarter and 30 "
      "ms\n",
      all.body_seconds, all.run_seconds, all.n_too_dear);
  print(all.of_part, "part");
  print(all.of_figure, "figure");
  return 0;
}
