// subimpact_benchmark: side-by-side measurements, printed as tables. Nothing passes or fails here.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "parts.h"

namespace subimpact::benchmarks {

std::span<const Part> all_parts() {
  static constexpr std::array<Part, 9> parts{{
      {"naive", "central-difference against the same scheme done naively", measure_naive},
      {"vectors", "own vector operations against the SUNDIALS library's", measure_vectors},
      {"evaluation",
       "cost of a right-hand side of erk and nystrom against a central-difference step",
       measure_evaluation},
      {"reversals", "sections put right at step ends against history advanced there only",
       measure_reversals},
      {"events", "finding every event and stating its error, against the runs alone",
       measure_events},
      {"exponential", "the exponential method against erk and nystrom on an elastic beam",
       measure_exponential},
      {"mesh", "Hermite elements against cells at one total error, on an elastic beam",
       measure_mesh},
      {"total-error",
       "the cheapest settings known for a total error of 0.1 us, and others beside them",
       measure_total_error},
      {"tables", "every table of erk and nystrom: work, time, error", measure_tables},
  }};
  return parts;
}

}  // namespace subimpact::benchmarks

// NOLINTNEXTLINE(bugprone-exception-escape): the exception shows what failed
int main(int argc, char** argv) {
  using namespace subimpact::benchmarks;
  Settings settings;
  std::vector<std::string> names;
  std::string list = "Parts (all, if none is named):";
  for (const Part& part : all_parts())
    list += fmt::format("\n  {:12} {}", part.name, part.question);
  list +=
      "\n\nExamples:\n  subimpact_benchmark\n  subimpact_benchmark naive evaluation --repeats 11\n"
      "  subimpact_benchmark mesh --clock wall";

  CLI::App app{"Measures alternatives side by side, alternating, and prints medians and ratios."};
  app.footer(list);
  std::vector<std::string> known;
  for (const Part& part : all_parts()) known.emplace_back(part.name);
  app.add_option("part", names, "parts to run")->check(CLI::IsMember(known));
  app.add_option("--repeats", settings.repeats, "rounds of which the median is taken")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  const std::map<std::string, Clock> clocks{{"processor", Clock::processor}, {"wall", Clock::wall}};
  app.add_option("--clock", settings.clock, "processor (default): time on the processor; wall")
      ->transform(CLI::CheckedTransformer(clocks).description(""))
      ->type_name("CLOCK");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  fmt::print("Seconds are medians of {} alternating runs, {} time of one thread.\n",
             settings.repeats, settings.clock == Clock::processor ? "processor" : "wall");
  for (const Part& part : all_parts()) {
    if (!names.empty() && std::find(names.begin(), names.end(), part.name) == names.end()) continue;
    fmt::print("\n== {}: {}\n", part.name, part.question);
    std::fflush(stdout);
    try {
      part.run(settings);
    } catch (const std::exception& failure) {
      fmt::print(stderr, "{}: {}\n", part.name, failure.what());
      return 3;
    }
  }
}
