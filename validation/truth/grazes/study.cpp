// Grazes with answers to fifty digits: openings and closings found, missed and invented, by located
// events and by other event finders. Reads the scenes of scenes.py; prints tables and, with
// --figure, draws the share found over the depth.

#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "scenes.h"
#include "taylor.h"

namespace {

using namespace grazes;
using subimpact::EventHandling;
using subimpact::Method;

constexpr double promised_depth = 1e-12;  // of the amplitude: above this none may be missing
constexpr double close = 0.2;             // rad of the fastest frequency: one event and its truth

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct Finder {
  std::string name;
  bool ours;  // held to the promise
  std::function<std::vector<Event>(const Scene&)> events;
};

struct Setting {
  Method method;
  const char* table;
  EventHandling events;
  double rtol;
  bool double_roots = true;
  double radians_per_step = 0.0;  // of the fastest frequency, for a fixed step
};

std::vector<Event> events_by(const Setting& setting, const Scene& scene) {
  subimpact::Options options;
  options.end_time = scene.end;
  options.solver.method = setting.method;
  if (*setting.table) options.solver.table = setting.table;
  options.solver.events = setting.events;
  options.solver.rtol = setting.rtol;
  if (setting.radians_per_step > 0.0) {
    options.solver.step = setting.radians_per_step / scene.fastest();
  }
  options.study.pair_detection = setting.double_roots;
  options.output.keep_no_rows();
  const subimpact::Result result = simulate(problem_of(scene), options);
  if (!result.outcome.completed()) {
    throw std::runtime_error(
        fmt::format("{} {}: {}", scene.family, scene.number, result.outcome.message));
  }
  std::vector<Event> events;
  for (const subimpact::Transition& event : result.transitions) {
    const bool begins = event.kind == subimpact::EventKind::contact_begins;
    if (!begins && event.kind != subimpact::EventKind::contact_ends) continue;
    if (!begins || event.time > 0.0) events.push_back({begins, event.time});
  }
  return events;
}

std::vector<Finder> finders() {
  const auto simulated = [](Setting setting) {
    return [setting](const Scene& scene) { return events_by(setting, scene); };
  };
  constexpr double tight = 1e-14;
  return {
      {"located, exponential", true,
       simulated({Method::exponential, "", EventHandling::located, tight})},
      {"located, nystrom", true, simulated({Method::nystrom, "", EventHandling::located, tight})},
      {"located, nystrom dprkn12", true,
       simulated({Method::nystrom, "dprkn12", EventHandling::located, tight})},
      {"located, erk", true, simulated({Method::erk, "", EventHandling::located, tight})},
      {"Taylor series, roots isolated", false, events_by_taylor_series},
      {"ARKODE roots, gap and rate", false,
       simulated({Method::erk, "", EventHandling::library, tight})},
      {"ARKODE roots, gap", false,
       simulated({Method::erk, "", EventHandling::library, tight, false})},
      {"CVODE roots, gap and rate", false,
       simulated({Method::adams, "", EventHandling::library, tight})},
      {"CVODE roots, gap", false,
       simulated({Method::adams, "", EventHandling::library, tight, false})},
      {"interpolated, nystrom", false,
       simulated({Method::nystrom, "", EventHandling::interpolated, tight})},
      {"interpolated, central differences", false,
       simulated({Method::central_difference, "", EventHandling::interpolated, tight, true, 0.01})},
  };
}

// Of one finder on one scene: how its events differ from the truth.
struct Difference {
  int missed = 0, invented = 0;
  bool failed = false;
};

Difference difference(const Scene& scene, const std::vector<Event>& found) {
  Difference sum;
  std::vector<bool> taken(found.size());
  const double tolerance = close / scene.fastest();
  for (const Event& event : scene.events) {
    std::size_t nearest = found.size();
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (taken[i] || found[i].begins != event.begins) continue;
      const double distance = std::abs(found[i].time - event.time);
      if (distance > tolerance) continue;
      if (nearest < found.size() && std::abs(found[nearest].time - event.time) <= distance)
        continue;
      nearest = i;
    }
    if (nearest == found.size()) {
      ++sum.missed;
    } else {
      taken[nearest] = true;
    }
  }
  sum.invented = static_cast<int>(std::ranges::count(taken, false));
  return sum;
}

struct Score {
  std::string name;
  bool ours = false;
  int events = 0, missed = 0, invented = 0, failed = 0;
  int missed_above_promise = 0;
  double deepest_missed = 0.0;           // over the amplitude
  double largest_margin_invented = 0.0;  // margin of the near miss, or depth of the graze, over it
  double seconds = 0.0;
  std::map<int, std::pair<int, int>> by_half_decade;  // of the depth: grazes, of these found whole

  void add(const Score& other);
};

constexpr double bins_per_decade = 2.0;
int bin_of(double depth) {
  return static_cast<int>(std::lround(bins_per_decade * std::log10(std::abs(depth))));
}

void add(Score& score, const Scene& scene, const Difference& d) {
  score.events += static_cast<int>(scene.events.size());
  score.missed += d.missed;
  score.invented += d.invented;
  score.failed += d.failed;
  if (d.missed > 0) {
    score.deepest_missed = std::max(score.deepest_missed, std::abs(scene.depth));
    if (scene.depth > promised_depth) score.missed_above_promise += d.missed;
  }
  if (d.invented > 0) {
    score.largest_margin_invented = std::max(score.largest_margin_invented, std::abs(scene.depth));
  }
  if (!scene.touches()) return;
  auto& [all, found] = score.by_half_decade[bin_of(scene.depth)];
  ++all;
  found += d.missed == 0 && !d.failed;
}

void Score::add(const Score& other) {
  events += other.events;
  missed += other.missed;
  invented += other.invented;
  failed += other.failed;
  missed_above_promise += other.missed_above_promise;
  deepest_missed = std::max(deepest_missed, other.deepest_missed);
  largest_margin_invented = std::max(largest_margin_invented, other.largest_margin_invented);
  seconds += other.seconds;
  for (const auto& [bin, counts] : other.by_half_decade) {
    by_half_decade[bin].first += counts.first;
    by_half_decade[bin].second += counts.second;
  }
}

bool of(const Scene& scene, const std::string& family) { return scene.family == family; }

Score score_of(const Finder& finder, const std::string& family, const std::vector<Scene>& scenes) {
  Score score;
  score.name = finder.name;
  score.ours = finder.ours;
  for (const Scene& scene : scenes) {
    if (!of(scene, family)) continue;
    std::vector<Event> found;
    bool failed = false;
    std::string why;
    const double start = processor_seconds();
    try {
      found = finder.events(scene);
    } catch (const std::exception& failure) {
      failed = true;
      why = failure.what();
    }
    score.seconds += processor_seconds() - start;
    Difference d = difference(scene, found);
    d.failed = failed;
    if (failed && score.failed == 0) fmt::print(stderr, "{}: {}\n", finder.name, why);
    if (finder.ours && (d.missed > 0 || d.invented > 0)) {
      fmt::print(stderr, "{}: {} {} {} of depth {:.2e}: {} missed, {} invented\n", finder.name,
                 scene.family, scene.number, scene.kind, scene.depth, d.missed, d.invented);
    }
    add(score, scene, d);
  }
  return score;
}

// Of another program: seconds for all scenes, then per scene the number of events with kinds and
// times.
Score score_of_file(const std::string& name, const std::string& file, const std::string& family,
                    const std::vector<Scene>& scenes) {
  Score score;
  score.name = name;
  std::ifstream in(file);
  double seconds = 0.0;
  in >> seconds;
  double events_of_all = 0.0;
  for (const Scene& scene : scenes) {
    int count = -1;
    in >> count;
    if (!in) throw std::runtime_error(file + ": ends before the last scene");
    std::vector<Event> found(static_cast<std::size_t>(std::max(count, 0)));
    for (Event& event : found) {
      std::string word;
      in >> word >> event.time;
      event.begins = word == "begins";
    }
    events_of_all += static_cast<double>(scene.events.size());
    if (of(scene, family)) add(score, scene, difference(scene, found));
  }
  score.seconds = seconds * score.events / events_of_all;
  return score;
}

void print(const std::vector<Score>& scores) {
  const auto size = [](double x) { return x > 0.0 ? fmt::format("{:.1e}", x) : std::string("-"); };
  fmt::print(
      "| events by | events | missed | of these deeper than {:.0e} | deepest with a miss | "
      "invented "
      "| largest margin invented | failed runs | time per event, us |\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      promised_depth);
  for (const Score& s : scores) {
    fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} | {:.1f} |\n", s.name, s.events, s.missed,
               s.missed_above_promise, size(s.deepest_missed), s.invented,
               size(s.largest_margin_invented), s.failed, 1e6 * s.seconds / s.events);
  }
}

void write_shares(const std::string& file, const std::vector<Score>& scores) {
  std::ofstream csv(file);
  csv << "finder,ours,depth,percent\n";
  for (const Score& score : scores) {
    for (const auto& [bin, counts] : score.by_half_decade) {
      csv << fmt::format("\"{}\",{:d},{:.6e},{:.3f}\n", score.name, score.ours,
                         std::pow(10.0, bin / bins_per_decade),
                         100.0 * counts.second / counts.first);
    }
  }
}

int run_program(int argc, char** argv) {
  CLI::App app{"Grazes found, missed and invented, by ways to find events."};
  std::string file;
  std::vector<std::string> others;
  std::string only;
  std::string shares;
  app.add_option("scenes", file, "scenes and their events, by scenes.py")->required();
  app.add_option("--also", others, "NAME=FILE: events that another program has found");
  app.add_option("--only", only, "finders whose name contains this");
  app.add_option("--shares", shares, "CSV file for the shares found, by depth");
  app.footer(
      "Exit status: 0 if located events miss none deeper than 1e-12 of the amplitude and "
      "invent none; 1 if not so.");
  CLI11_PARSE(app, argc, argv);
  const std::vector<Scene> all = read_scenes(file);
  std::vector<std::string> families;
  for (const Scene& scene : all) {
    if (std::ranges::find(families, scene.family) == families.end()) {
      families.push_back(scene.family);
    }
  }
  const auto table_of = [&](const std::string& family, const std::vector<Score>& scores) {
    fmt::print(
        "\n{}: {} scenes, {} of them grazes\n\n", family,
        std::ranges::count_if(all, [&](const Scene& s) { return of(s, family); }),
        std::ranges::count_if(all, [&](const Scene& s) { return of(s, family) && s.touches(); }));
    print(scores);
    std::fflush(stdout);
  };
  std::vector<Score> sums;
  for (const std::string& family : families) {
    std::vector<Score> scores;
    for (const Finder& finder : finders()) {
      if (finder.name.find(only) == std::string::npos) continue;
      scores.push_back(score_of(finder, family, all));
    }
    for (const std::string& other : others) {
      const std::size_t split = other.find('=');
      if (split == std::string::npos) throw std::runtime_error("--also: not NAME=FILE");
      scores.push_back(score_of_file(other.substr(0, split), other.substr(split + 1), family, all));
    }
    table_of(family, scores);
    if (sums.empty()) {
      sums = scores;
    } else {
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i].add(scores[i]);
    }
  }
  if (!shares.empty()) write_shares(shares, sums);
  const bool kept = std::ranges::all_of(sums, [](const Score& s) {
    return !s.ours || (s.missed_above_promise == 0 && s.invented == 0 && s.failed == 0);
  });
  fmt::print("\nLocated events: {}\n",
             kept ? "none deeper than 1e-12 of the amplitude missed, none invented, no run failed"
                  : "MISSED, INVENTED or FAILED");
  return kept ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "subimpact_grazes: %s\n", failure.what());
    return 2;
  }
}
