// The project's vector operations under SUNDIALS against the library's own.

#include <fmt/format.h>

#include "parts.h"

namespace subimpact::benchmarks {

void measure_vectors(const Settings& settings) {
  fmt::print(
      "erk, elastic section, rtol 1e-9, 2 ms: whole run with the project's vector operations and\n"
      "with those of the installed SUNDIALS. Bar for the ratio: 4.\n\n");
  fmt::print("{:18} {:>14} {:>14} {:>14} {:>14} {:>8}\n", "table", "right-h. sides", "project s",
             "library s", "apart us", "ratio");
  for (const char* table : {"dormand-prince", "dop853"}) {
    Case project = paper_case(SectionKind::elastic);
    project.solver.method = Method::erk;
    project.solver.rtol = 1e-9;
    project.solver.table = table;
    Case library = project;
    library.study.vector_operations = VectorOperationsKind::library;
    Result with_project, with_library;
    const std::vector<double> seconds = seconds_side_by_side(
        settings,
        {[&] { with_project = run_to_end(project); }, [&] { with_library = run_to_end(library); }});
    fmt::print("{:18} {:14} {:14.4f} {:14.4f} {:14.1e} {:8.2f}\n", table,
               with_project.work.right_hand_sides, seconds[0], seconds[1],
               1e6 * (last_separation(with_library) - last_separation(with_project)),
               seconds[1] / seconds[0]);
  }
}

}  // namespace subimpact::benchmarks
