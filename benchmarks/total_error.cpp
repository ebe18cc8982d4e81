// What the paper's beam costs at one total error, of mesh and time together.

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <string>

#include "parts.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact::benchmarks {
namespace {

struct Contestant {
  std::string name;
  Case input;
};

Case case_of(SectionKind section, double end_time, Method method) {
  Case input = paper_case(section);
  input.end_time = end_time;
  input.solver.method = method;
  return input;
}

Case on_cells(Case input, int segments) {
  input.model.mesh = MeshKind::cells;
  input.model.segments = segments;
  return input;
}

Case on_elements(Case input, int elements, double rtol) {
  input.model.mesh = MeshKind::hermite;
  input.model.elements = elements;
  input.solver.rtol = rtol;
  return input;
}

void compare(const Settings& settings, const char* heading, const Case& limit,
             const std::vector<Contestant>& contestants) {
  const std::vector<SubImpact> truth = run_to_end(limit).sub_impacts;
  std::vector<Result> results(contestants.size());
  std::vector<std::function<void()>> runs;
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    runs.push_back([&, i] { results[i] = run_to_end(contestants[i].input); });
  }
  const std::vector<double> seconds = seconds_side_by_side(settings, runs);
  fmt::print("{}\n\n{:44} {:>10} {:>9} {:>12} {:>14} {:>8}\n", heading, "setting", "error, us",
             "steps", "ms", "ns", "ratio");
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    const Result& result = results[i];
    const double per_unknown = seconds[i] / static_cast<double>(result.work.steps) /
                               static_cast<double>(result.used.n_unknowns);
    fmt::print("{:44} {:10.3f} {:9} {:12.2f} {:14.2f} {:8.2f}\n", contestants[i].name,
               1e6 * event_errors(result.sub_impacts, truth).overall(), result.work.steps,
               1e3 * seconds[i], 1e9 * per_unknown, seconds[i] / seconds[0]);
    std::fflush(stdout);
  }
}

}  // namespace

void measure_total_error(const Settings& settings) {
  {
    const Case central = case_of(SectionKind::exact, 0.84e-3, Method::central_difference);
    Case nystrom = on_cells(case_of(SectionKind::exact, 0.84e-3, Method::nystrom), 2227);
    nystrom.solver.rtol = 1e-7;
    compare(settings,
            "section exact, 0.84 ms; error: largest of any start or end, against 8001 cells;\n"
            "ns: of the whole run, per step and unknown; ratio: to the first.",
            on_cells(central, 8001),
            {{"central-difference, 2227 cells", on_cells(central, 2227)},
             {"central-difference, 1001 cells", on_cells(central, 1001)},
             {"nystrom, 2227 cells, rtol 1e-7", nystrom},
             {"central-difference, 2227 cells, elastic section",
              on_cells(case_of(SectionKind::elastic, 0.84e-3, Method::central_difference), 2227)}});
  }
  {
    const Case exponential = case_of(SectionKind::elastic, 2e-3, Method::exponential);
    const Case central = case_of(SectionKind::elastic, 2e-3, Method::central_difference);
    fmt::print("\n");
    compare(settings,
            "section elastic, 2 ms; error: largest of any start or end, against 800 elements.",
            on_elements(exponential, 800, 1e-11),
            {{"exponential, 216 elements, rtol 1e-4", on_elements(exponential, 216, 1e-4)},
             {"central-difference, 2401 cells", on_cells(central, 2401)},
             {"exponential, 336 elements, rtol 1e-4", on_elements(exponential, 336, 1e-4)},
             {"central-difference, 2901 cells", on_cells(central, 2901)}});
  }
}

}  // namespace subimpact::benchmarks
