#include "measure.h"

#include <time.h>

#include <algorithm>
#include <ranges>
#include <stdexcept>

namespace subimpact::benchmarks {
namespace {

double now(Clock clock) {
  timespec time{};
  clock_gettime(clock == Clock::processor ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

std::vector<double> seconds_side_by_side(const Settings& settings,
                                         const std::vector<std::function<void()>>& contestants) {
  std::vector<std::vector<double>> times(contestants.size());
  for (const auto& run : contestants) run();
  for (int round = 0; round < settings.repeats; ++round) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const double start = now(settings.clock);
      contestants[i]();
      times[i].push_back(now(settings.clock) - start);
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of_one : times) {
    std::sort(of_one.begin(), of_one.end());
    const std::size_t middle = of_one.size() / 2;
    medians.push_back(of_one.size() % 2 == 1 ? of_one[middle]
                                             : 0.5 * (of_one[middle - 1] + of_one[middle]));
  }
  return medians;
}

Case paper_case(SectionKind section) {
  Case input;
  input.title = "Free-free beam struck at the middle";
  Beam& beam = input.scene.beam;
  beam.length = 0.7112;
  beam.width = 0.0163;
  beam.thickness = 0.0075;
  beam.density = 2600.0;
  beam.youngs_modulus = 71.96e9;
  beam.yield_stress = 150e6;
  Striker& striker = input.scene.striker;
  striker.mass = 0.201;
  striker.nose_radius = 0.01;
  striker.velocity = 15.9;
  input.model.segments = 501;
  input.model.section = section;
  input.model.layers = 40;
  input.end_time = 2e-3;
  input.output.interval = 0.0;
  return input;
}

Case paper_case_with_shear(SectionKind section) {
  Case input = paper_case(section);
  input.scene.beam.theory = BeamTheory::timoshenko;
  input.scene.beam.poisson = 0.3;
  input.scene.contact.kind = ContactKind::line;
  input.scene.contact.pressure_by_depth = true;
  return input;
}

Result run_to_end(const Case& input) {
  Result result = simulate(input);
  if (!result.outcome.completed()) throw std::runtime_error(result.outcome.message);
  return result;
}

double last_separation(const Result& result) {
  for (const SubImpact& s : result.sub_impacts | std::views::reverse) {
    if (s.end) return *s.end;
  }
  throw std::runtime_error("no sub-impact ended");
}

}  // namespace subimpact::benchmarks
