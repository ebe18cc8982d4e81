// What finding every event costs beside the integration itself.

#include <fmt/format.h>

#include "parts.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact::benchmarks {

void measure_events(const Settings& settings) {
  fmt::print(
      "2 ms, rtol 1e-8. pairs: a run with the search for contacts that open and close within one\n"
      "step, against one without. error bars: a run with them, against the run and its "
      "refined_run\n"
      "made one by one. Bar for both together: 1.10.\n\n");
  fmt::print("{:10} {:8}  {:>10} {:>10} {:>8}  {:>10} {:>10} {:>8}\n", "method", "section",
             "pairs s", "without s", "ratio", "bars s", "two runs s", "ratio");
  for (const Method method : {Method::erk, Method::nystrom}) {
    for (const auto& [section, name] :
         {std::pair{SectionKind::elastic, "elastic"}, std::pair{SectionKind::exact, "exact"}}) {
      Case input = paper_case(section);
      input.solver.method = method;
      input.solver.rtol = 1e-8;
      Case without = input;
      without.study.pair_detection = false;
      const std::vector<CaseBeside> beside = cases_beside_in_time(input);
      const std::vector<double> seconds =
          seconds_side_by_side(settings, {[&] { run_to_end(input); }, [&] { run_to_end(without); },
                                          [&] { simulate_judged(input, beside, 1); },
                                          [&] {
                                            run_to_end(input);
                                            run_to_end(beside.front().input);
                                          }});
      fmt::print("{:10} {:8}  {:10.4f} {:10.4f} {:8.3f}  {:10.4f} {:10.4f} {:8.3f}\n",
                 method == Method::erk ? "erk" : "nystrom", name, seconds[0], seconds[1],
                 seconds[0] / seconds[1], seconds[2], seconds[3], seconds[2] / seconds[3]);
    }
  }
}

}  // namespace subimpact::benchmarks
