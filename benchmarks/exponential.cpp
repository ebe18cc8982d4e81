// The exponential method against erk and nystrom on a beam that stays elastic.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "parts.h"

namespace subimpact::benchmarks {
namespace {

Case elastic_case(Method method, double rtol, const char* table = nullptr) {
  Case input = paper_case(SectionKind::elastic);
  input.solver.method = method;
  input.solver.rtol = rtol;
  if (table) input.solver.table = table;
  return input;
}

// The largest difference of any start or end, us; nothing if the counts differ.
std::optional<double> largest_difference(const Result& a, const Result& b) {
  if (a.sub_impacts.size() != b.sub_impacts.size()) return std::nullopt;
  double worst = 0.0;
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    const SubImpact& p = a.sub_impacts[i];
    const SubImpact& q = b.sub_impacts[i];
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

// Of rtol = 1e-4, 10^-4.5, ... the first at which every event is within `wanted` us.
std::optional<Case> cheapest(const Contestant& contestant, const Result& reference, double wanted,
                             double end_time) {
  for (double exponent = -4.0; exponent > -12.0; exponent -= 0.5) {
    Case input = elastic_case(contestant.method, std::pow(10.0, exponent), contestant.table);
    input.end_time = end_time;
    const std::optional<double> error = largest_difference(run_to_end(input), reference);
    if (error && *error <= wanted) return input;
  }
  return std::nullopt;
}

void at_equal_accuracy(const Settings& settings) {
  constexpr double end_time = 8e-3;
  Case tight = elastic_case(Method::exponential, 1e-12);
  tight.end_time = end_time;
  const Result reference = run_to_end(tight);
  const Contestant contestants[] = {{"exponential", Method::exponential, nullptr},
                                    {"erk dop853", Method::erk, "dop853"},
                                    {"erk dormand-prince", Method::erk, "dormand-prince"},
                                    {"erk verner", Method::erk, "verner"},
                                    {"nystrom dprkn8", Method::nystrom, "dprkn8"},
                                    {"nystrom dprkn12", Method::nystrom, "dprkn12"}};
  fmt::print(
      "8 ms, 501 cells, every start and end within the error of the reference's; seconds\n"
      "include set-up.\n\n{:10} {:20} {:>8} {:>14} {:>10} {:>8}\n",
      "error us", "method", "rtol", "right-h. sides", "s", "ratio");
  for (const double wanted : {1e-1, 1e-2, 1e-3, 1e-4}) {
    std::vector<Case> cases;
    std::vector<const char*> names;
    for (const Contestant& contestant : contestants) {
      const auto found = cheapest(contestant, reference, wanted, end_time);
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
      "\n2 ms, rtol 1e-8: growth with the mesh. set-up: of the exponential method alone.\n\n"
      "{:>9} {:>12} {:>12} {:>12} {:>8}\n",
      "segments", "set-up s", "the rest s", "erk s", "ratio");
  for (const int segments : {251, 501, 1001, 2001}) {
    Case exponential = elastic_case(Method::exponential, 1e-8);
    Case erk = elastic_case(Method::erk, 1e-8);
    exponential.model.segments = erk.model.segments = segments;
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
  at_equal_accuracy(settings);
  over_meshes(settings);
}

}  // namespace subimpact::benchmarks
