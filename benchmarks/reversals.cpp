// What putting right what sections do within steps costs, and what it buys.

#include <fmt/format.h>

#include "parts.h"

namespace subimpact::benchmarks {
namespace {

Case yielding_case(SectionKind section, const char* table, double rtol) {
  Case input = paper_case(section);
  input.solver.method = Method::erk;
  input.solver.table = table;
  input.solver.rtol = rtol;
  return input;
}

}  // namespace

void measure_reversals(const Settings& settings) {
  fmt::print(
      "erk with dormand-prince, 2 ms: sections put right at step ends, or history advanced\n"
      "there only. error: of the last separation before 2 ms, against dop853 at rtol 1e-11 with "
      "sections\n"
      "put right; n: sub-impacts found.\n\n");
  fmt::print("{:8} {:>6}  {:>14} {:>8} {:>9} {:>4}  {:>14} {:>8} {:>9} {:>4} {:>8}\n", "", "",
             "located:", "", "", "", "step ends:", "", "", "", "");
  fmt::print("{:8} {:>6}  {:>14} {:>8} {:>9} {:>4}  {:>14} {:>8} {:>9} {:>4} {:>8}\n", "section",
             "rtol", "right-h. sides", "seconds", "error us", "n", "right-h. sides", "seconds",
             "error us", "n", "ratio");
  for (const auto& [section, name] :
       {std::pair{SectionKind::exact, "exact"}, std::pair{SectionKind::layers, "layers"}}) {
    const double reference = last_separation(run_to_end(yielding_case(section, "dop853", 1e-11)));
    for (const double rtol : {1e-7, 1e-8, 1e-9}) {
      const Case located = yielding_case(section, "dormand-prince", rtol);
      Case step_end = located;
      step_end.solver.reversals = ReversalHandling::step_end;
      Result of_located, of_step_end;
      const std::vector<double> seconds = seconds_side_by_side(
          settings,
          {[&] { of_located = run_to_end(located); }, [&] { of_step_end = run_to_end(step_end); }});
      const auto error = [&](const Result& r) { return 1e6 * (last_separation(r) - reference); };
      fmt::print("{:8} {:6.0e}  {:14} {:8.3f} {:9.1e} {:4}  {:14} {:8.3f} {:9.1e} {:4} {:8.2f}\n",
                 name, rtol, of_located.work.right_hand_sides, seconds[0], error(of_located),
                 of_located.sub_impacts.size(), of_step_end.work.right_hand_sides, seconds[1],
                 error(of_step_end), of_step_end.sub_impacts.size(), seconds[0] / seconds[1]);
    }
  }
}

}  // namespace subimpact::benchmarks
