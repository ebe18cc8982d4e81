// Every explicit Runge-Kutta table: work, time and error.

#include <fmt/format.h>

#include "integrate/arkode_erk.h"
#include "parts.h"

namespace subimpact::benchmarks {
namespace {

Case case_with(SectionKind section, const std::string& table, double rtol) {
  Case input = paper_case(section);
  input.solver.method = Method::erk;
  input.solver.table = table;
  input.solver.rtol = rtol;
  return input;
}

void print_tables_of(SectionKind section, const char* name, double reference_rtol) {
  const Result reference = run_to_end(case_with(section, "dop853", reference_rtol));
  fmt::print(
      "\n{} section, 2 ms; error: of the last separation, {:.6f} us in the reference\n"
      "(dop853 at rtol {:.0e}), {} sub-impacts there. One run each.\n\n",
      name, 1e6 * last_separation(reference), reference_rtol, reference.sub_impacts.size());
  fmt::print("{:18} {:>8} {:>16} {:>10} {:>12} {:>12}\n", "table", "rtol", "right-h. sides",
             "seconds", "error us", "sub-impacts");
  for (const ExplicitTable& table : explicit_tables()) {
    for (const double rtol : {1e-7, 1e-8, 1e-9}) {
      const Result result = simulate(case_with(section, table.name, rtol));
      if (!result.outcome.completed()) {
        fmt::print("{:18} {:8.0e} {}\n", table.name, rtol, result.outcome.message);
        continue;
      }
      fmt::print("{:18} {:8.0e} {:16} {:10.3f} {:12.1e} {:12}\n", table.name, rtol,
                 result.work.right_hand_sides, result.work.wall_seconds,
                 1e6 * (last_separation(result) - last_separation(reference)),
                 result.sub_impacts.size());
    }
  }
}

}  // namespace

void measure_tables(const Settings& /*settings*/) {
  fmt::print("erk with each table; seconds are wall time.\n");
  print_tables_of(SectionKind::elastic, "Elastic", 1e-12);
  print_tables_of(SectionKind::exact, "Exact", 1e-11);
}

}  // namespace subimpact::benchmarks
