// The exponential method against erk and nystrom, on beams that stay elastic and on yielding ones.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "parts.h"

namespace subimpact::benchmarks {
namespace {

Case case_of(SectionKind section, Method method, double rtol, const char* table = nullptr) {
  Case input = paper_case(section);
  input.solver.method = method;
  input.solver.rtol = rtol;
  if (table) input.solver.table = table;
  return input;
}

// The largest difference of any start or end before `horizon` (s), us; nothing if the counts
// differ.
std::optional<double> largest_difference(const Result& a, const Result& b, double horizon) {
  if (a.sub_impacts.size() != b.sub_impacts.size()) return std::nullopt;
  double worst = 0.0;
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    const SubImpact& p = a.sub_impacts[i];
    const SubImpact& q = b.sub_impacts[i];
    if (q.start > horizon) break;
    worst = std::max(
        {worst, std::abs(p.start - q.start), std::abs(p.end.value_or(0.0) - q.end.value_or(0.0))});
  }
  return 1e6 * worst;
}

struct Contestant {
  const char* name;
  Method method;
  const char* table;
};

// Of rtol = 1e-4, 10^-4.5, ... the first at which the count is right and every event before the
// horizon is within `wanted` us.
std::optional<Case> cheapest(const Contestant& contestant, const Result& reference,
                             const Case& scene, double wanted, double horizon) {
  for (double exponent = -4.0; exponent > -12.0; exponent -= 0.5) {
    Case input = scene;
    input.solver.method = contestant.method;
    if (contestant.table) input.solver.table = contestant.table;
    input.solver.rtol = std::pow(10.0, exponent);
    const std::optional<double> error = largest_difference(run_to_end(input), reference, horizon);
    if (error && *error <= wanted) return input;
  }
  return std::nullopt;
}

void at_equal_accuracy(const Settings& settings, SectionKind section, double horizon,
                       std::span<const double> errors) {
  Case scene = case_of(section, Method::exponential, 1e-12);
  scene.end_time = 8e-3;
  const Result reference = run_to_end(scene);
  const Contestant contestants[] = {{"exponential", Method::exponential, nullptr},
                                    {"erk dop853", Method::erk, "dop853"},
                                    {"erk dormand-prince", Method::erk, "dormand-prince"},
                                    {"erk verner", Method::erk, "verner"},
                                    {"nystrom dprkn8", Method::nystrom, "dprkn8"},
                                    {"nystrom dprkn12", Method::nystrom, "dprkn12"}};
  fmt::print(
      "{} sub-impacts in 8 ms, 501 cells; every start and end before {:g} ms within the error of\n"
      "the reference's; seconds include set-up.\n\n{:10} {:20} {:>8} {:>14} {:>10} {:>8}\n",
      reference.sub_impacts.size(), 1e3 * horizon, "error us", "method", "rtol", "right-h. sides",
      "s", "ratio");
  for (const double wanted : errors) {
    std::vector<Case> cases;
    std::vector<const char*> names;
    for (const Contestant& contestant : contestants) {
      const auto found = cheapest(contestant, reference, scene, wanted, horizon);
      if (!found) {
        fmt::print("{:10.0e} {:20} not reached\n", wanted, contestant.name);
        continue;
      }
      cases.push_back(*found);
      names.push_back(contestant.name);
    }
    std::vector<std::function<void()>> runs;
    std::vector<long> right_hand_sides(cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i) {
      runs.push_back([&, i] { right_hand_sides[i] = run_to_end(cases[i]).work.right_hand_sides; });
    }
    const std::vector<double> seconds = seconds_side_by_side(settings, runs);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      fmt::print("{:10.0e} {:20} {:8.0e} {:14} {:10.5f} {:8.1f}\n", wanted, names[i],
                 cases[i].solver.rtol, right_hand_sides[i], seconds[i], seconds[i] / seconds[0]);
    }
  }
}

void over_meshes(const Settings& settings) {
  fmt::print(
      "\nsection elastic, 8 ms, rtol 1e-8: growth with the mesh. set-up: of the exponential method "
      "alone.\n\n"
      "{:>9} {:>12} {:>12} {:>12} {:>8}\n",
      "segments", "set-up s", "the rest s", "erk s", "ratio");
  for (const int segments : {251, 501, 1001, 2001}) {
    Case exponential = case_of(SectionKind::elastic, Method::exponential, 1e-8);
    Case erk = case_of(SectionKind::elastic, Method::erk, 1e-8);
    exponential.model.segments = erk.model.segments = segments;
    exponential.end_time = erk.end_time = 8e-3;
    double setup = 0.0;
    const std::vector<double> seconds = seconds_side_by_side(
        settings,
        {[&] { setup = run_to_end(exponential).work.setup_seconds; }, [&] { run_to_end(erk); }});
    fmt::print("{:9} {:12.5f} {:12.5f} {:12.4f} {:8.1f}\n", segments, setup, seconds[0] - setup,
               seconds[1], seconds[1] / seconds[0]);
  }
}

}  // namespace

void measure_exponential(const Settings& settings) {
  constexpr double all = 8e-3;
  constexpr double before_2_ms = 2e-3;
  fmt::print("section elastic: ");
  at_equal_accuracy(settings, SectionKind::elastic, all, std::array{1e-1, 1e-2, 1e-3, 1e-4});
  fmt::print("\nsection exact: ");
  at_equal_accuracy(settings, SectionKind::exact, before_2_ms, std::array{1e-2, 1e-3});
  fmt::print("\nsection layers: ");
  at_equal_accuracy(settings, SectionKind::layers, before_2_ms, std::array{1e-2, 3e-3});
  over_meshes(settings);
}

}  // namespace subimpact::benchmarks
