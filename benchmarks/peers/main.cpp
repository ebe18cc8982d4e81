// The published strike by this program and by the integrators of other libraries: error of event
// times over processor time, on the same mesh, with the same right-hand sides, against the same
// reference.

#include <fmt/format.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>

#include "../measure.h"
#include "contestants.h"
#include "peer.h"
#include "subimpact/study/judgement/event_errors.h"

namespace {

using namespace subimpact;
using namespace subimpact::peers;

constexpr double us = 1e6;
constexpr double wanted_errors[] = {1e-8, 1e-9, 1e-10};  // s
constexpr double reference_share = 0.3;  // of the smallest of them, the reference may be off by
constexpr double longest_run = 4.0;      // s: what comes after it in a sweep is left out
constexpr int rounds = 3;                // of those compared, side by side

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void run(Attempt& attempt, const std::vector<SubImpact>& reference) {
  const double start = processor_seconds();
  Result result;
  try {
    result = attempt.run();
  } catch (const InvalidCase& refused) {
    result.outcome.kind = OutcomeKind::solver_failed;
    fmt::print(stderr, "{}: {}\n", attempt.text, refused.what());
  }
  const double seconds = processor_seconds() - start;
  attempt.seconds = attempt.seconds > 0.0 ? std::min(attempt.seconds, seconds) : seconds;
  judge(attempt, result.sub_impacts, reference);
  attempt.right = attempt.right && result.outcome.completed();
  if (!result.outcome.completed()) attempt.error = std::numeric_limits<double>::infinity();
}

void run_sweeps(Contestant& contestant, const std::vector<SubImpact>& reference, double enough) {
  for (std::vector<Attempt>& sweep : contestant.sweeps) {
    for (std::size_t i = 0; i < sweep.size(); ++i) {
      if (sweep[i].run) run(sweep[i], reference);
      const bool two_good = i > 0 && sweep[i].error <= enough && sweep[i - 1].error <= enough;
      if (sweep[i].seconds > longest_run || two_good) {
        sweep.resize(i + 1);
        break;
      }
    }
  }
}

// The cheapest attempt that comes within an error, and whose tighter neighbour, if it was run, does
// too: what is good by chance does not count.
Attempt* cheapest(Contestant& contestant, double wanted) {
  Attempt* best = nullptr;
  for (std::vector<Attempt>& sweep : contestant.sweeps) {
    for (std::size_t i = 0; i < sweep.size(); ++i) {
      const auto good = [&](const Attempt& s) { return s.right && s.error <= wanted; };
      if (!good(sweep[i]) || (i + 1 < sweep.size() && !good(sweep[i + 1]))) continue;
      if (best == nullptr || sweep[i].seconds < best->seconds) best = &sweep[i];
    }
  }
  return best;
}

std::string digits(double seconds) { return fmt::format("{:.3g}", seconds); }

std::string ratio_text(double ratio) {
  return ratio < 9.95 ? fmt::format("{:.1f}", ratio) : fmt::format("{:.0f}", ratio);
}

// The smallest error of any run that found all sub-impacts, for those that reach nothing.
std::string best_text(const Contestant& contestant) {
  double best = HUGE_VAL;
  for (const std::vector<Attempt>& sweep : contestant.sweeps) {
    for (const Attempt& attempt : sweep) {
      if (attempt.right) best = std::min(best, attempt.error);
    }
  }
  return std::isfinite(best) ? fmt::format("not reached (best {:.0e} us)", us * best)
                             : "no run has all sub-impacts";
}

// Side by side: every setting that wins for its contestant, in turn, several times.
void repeat_winners(std::vector<Contestant>& all, const std::vector<SubImpact>& reference) {
  std::vector<Attempt*> chosen;
  for (Contestant& contestant : all) {
    for (const double wanted : wanted_errors) {
      Attempt* attempt = cheapest(contestant, wanted);
      if (attempt != nullptr && attempt->run &&
          std::ranges::find(chosen, attempt) == chosen.end()) {
        chosen.push_back(attempt);
      }
    }
  }
  for (int round = 0; round < rounds; ++round) {
    for (Attempt* attempt : chosen) run(*attempt, reference);
  }
}

// For each wanted error that is reached: the least seconds, and the contestant that takes them.
using Fastest = std::map<double, std::pair<double, std::string>>;

Fastest fastest_of(std::vector<Contestant>& all, bool ours) {
  Fastest fastest;
  for (Contestant& contestant : all) {
    if (contestant.ours != ours) continue;
    for (const double wanted : wanted_errors) {
      const Attempt* attempt = cheapest(contestant, wanted);
      if (attempt == nullptr) continue;
      auto& least = fastest.try_emplace(wanted, HUGE_VAL, "").first->second;
      if (attempt->seconds < least.first) least = {attempt->seconds, contestant.name};
    }
  }
  return fastest;
}

void print_table(const PeerScene& scene, std::vector<Contestant>& all, const Fastest& ours) {
  fmt::print(
      "\n{}: seconds for the largest error of an event time, and ratios to the fastest of "
      "subimpact\n\n",
      scene.name);
  fmt::print("|  |");
  for (const double wanted : wanted_errors)
    fmt::print(" {:.0e} us | ratio | setting |", us * wanted);
  fmt::print("\n|---|");
  for (std::size_t i = 0; i < std::size(wanted_errors); ++i) fmt::print("---|---|---|");
  fmt::print("\n");
  for (Contestant& contestant : all) {
    fmt::print("| {} |", contestant.name);
    for (const double wanted : wanted_errors) {
      const Attempt* attempt = cheapest(contestant, wanted);
      if (attempt == nullptr) {
        fmt::print(" {} | | |", best_text(contestant));
      } else {
        fmt::print(
            " {} | {} | {} |", digits(attempt->seconds),
            ours.contains(wanted) ? ratio_text(attempt->seconds / ours.at(wanted).first) : "",
            attempt->text);
      }
    }
    fmt::print("\n");
  }
  fmt::print("\n");
}

void print_verdicts(const PeerScene& scene, const Fastest& ours, const Fastest& others) {
  for (const double wanted : wanted_errors) {
    if (!ours.contains(wanted)) {
      fmt::print("{}, {:.0e} us: not reached by subimpact\n", scene.name, us * wanted);
      continue;
    }
    const double seconds = ours.at(wanted).first;
    if (!others.contains(wanted)) {
      fmt::print("{}, {:.0e} us: subimpact {} s; no other reaches it\n", scene.name, us * wanted,
                 digits(seconds));
    } else {
      const auto& [of_other, name] = others.at(wanted);
      fmt::print("{}, {:.0e} us: the fastest other, {}, takes {} times subimpact's {} s\n",
                 scene.name, us * wanted, name, ratio_text(of_other / seconds), digits(seconds));
    }
  }
  std::fflush(stdout);
}

// Whether this program reaches every wanted error.
bool compare(const PeerScene& scene, std::vector<Contestant>& all,
             const std::vector<SubImpact>& reference) {
  repeat_winners(all, reference);
  const Fastest ours = fastest_of(all, true);
  print_table(scene, all, ours);
  print_verdicts(scene, ours, fastest_of(all, false));
  return ours.size() == std::size(wanted_errors);
}

// The lower left of what a contestant has reached: its best error for the time.
std::vector<const Attempt*> front(const Contestant& contestant) {
  std::vector<const Attempt*> points;
  for (const std::vector<Attempt>& sweep : contestant.sweeps) {
    for (const Attempt& attempt : sweep) {
      if (attempt.right && attempt.error > 0.0) points.push_back(&attempt);
    }
  }
  std::ranges::sort(points, {}, &Attempt::seconds);
  double least = HUGE_VAL;
  std::erase_if(points, [&](const Attempt* s) {
    if (!(s->error < least)) return true;
    least = s->error;
    return false;
  });
  return points;
}

void write_front(std::ofstream& csv, const PeerScene& scene, const std::vector<Contestant>& all) {
  for (const Contestant& contestant : all) {
    for (const Attempt* s : front(contestant)) {
      csv << fmt::format("{},\"{}\",{:d},{:.4e},{:.4e}\n", scene.name, contestant.name,
                         contestant.ours, us * s->error, s->seconds);
    }
  }
}

int run_program(int argc, char** argv) {
  CLI::App app{"The published strike by this program and by integrators of other libraries."};
  std::vector<std::string> names;
  std::vector<std::string> others;
  std::string table;
  std::string only;
  double end = 2e-3;
  std::vector<std::string> known;
  for (const PeerScene& scene : peer_scenes) known.emplace_back(scene.name);
  app.add_option("--scenes", names, "Some of the scenes (default: all)")
      ->delimiter(',')
      ->check(CLI::IsMember(known));
  app.add_option("--end", end, "s")->capture_default_str();
  app.add_option("--only", only, "contestants whose name contains this, and subimpact");
  app.add_option(
      "--also", others,
      "NAME=FILE.SCENE: runs of another program, one file per scene (read where it exists)");
  app.add_option("--table", table, "CSV file for the chart");
  app.footer("Exit status: 0 if this program reaches every wanted error, 1 if not.");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!table.empty()) csv.open(table);
  csv << "scene,contestant,ours,error_us,seconds\n";
  bool reached = true;
  for (const PeerScene& scene : peer_scenes) {
    if (!names.empty() && std::ranges::find(names, scene.name) == names.end()) continue;
    Case input = case_of(scene);
    input.end_time = end;
    input.output.shapes = 0.0;
    const Reference reference =
        compute_reference(input, reference_share * wanted_errors[std::size(wanted_errors) - 1]);
    input.end_time = reference.horizon;
    fmt::print("\n== {}, to {:.2f} ms: {} sub-impacts; reference to {:.1e} us ({}; {})\n",
               scene.name, 1e3 * reference.horizon, reference.sub_impacts.size(),
               us * reference.error, reference.description, reference.horizon_reason);
    std::vector<std::string> skipped;
    std::vector<Contestant> all = contestants(input, skipped);
    std::erase_if(all, [&](const Contestant& c) {
      return !c.ours && c.name.find(only) == std::string::npos;
    });
    for (Contestant& contestant : all) {
      run_sweeps(contestant, reference.sub_impacts, wanted_errors[std::size(wanted_errors) - 1]);
    }
    for (const std::string& other : others) {
      const std::size_t split = other.find('=');
      if (split == std::string::npos) throw std::runtime_error("--also: not NAME=FILE");
      const std::string file = other.substr(split + 1) + "." + scene.name;
      if (std::filesystem::exists(file)) {
        all.push_back(read_contestant(other.substr(0, split), file, reference.sub_impacts));
      } else {
        skipped.push_back(other.substr(0, split) + " (" + scene.name + ")");
      }
    }
    for (const std::string& name : skipped) fmt::print("skipped: {}\n", name);
    reached = compare(scene, all, reference.sub_impacts) && reached;
    write_front(csv, scene, all);
  }
  return reached ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_program(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "subimpact_peers: %s\n", failure.what());
    return 1;
  }
}
