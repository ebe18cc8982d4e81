// Every table of the explicit adaptive methods: work, time and error.

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "integrate/nystrom.h"
#include "integrate/sundials.h"
#include "parts.h"

namespace subimpact::benchmarks {
namespace {

std::vector<std::pair<Method, std::string>> methods_and_tables() {
  std::vector<std::pair<Method, std::string>> list;
  for (const CoefficientTable& table : explicit_tables())
    list.emplace_back(Method::erk, table.name);
  for (const NystromTable& table : nystrom_tables()) {
    list.emplace_back(Method::nystrom, table.name);
  }
  return list;
}

Case case_with(SectionKind section, Method method, const std::string& table, double rtol) {
  Case input = paper_case(section);
  input.solver.method = method;
  input.solver.table = table;
  input.solver.rtol = rtol;
  return input;
}

void print_tables_of(SectionKind section, const char* name, double reference_rtol) {
  const Result reference = run_to_end(case_with(section, Method::erk, "dop853", reference_rtol));
  fmt::print(
      "\n{} section, 2 ms; error: of the last separation, {:.6f} us in the reference\n"
      "(erk, dop853 at rtol {:.0e}), {} sub-impacts there. One run each.\n\n",
      name, 1e6 * last_separation(reference), reference_rtol, reference.sub_impacts.size());
  fmt::print("{:8} {:18} {:>8} {:>16} {:>10} {:>12} {:>12}\n", "method", "table", "rtol",
             "right-h. sides", "seconds", "error us", "sub-impacts");
  for (const auto& [method, table] : methods_and_tables()) {
    const char* method_name = method == Method::erk ? "erk" : "nystrom";
    for (const double rtol : {1e-7, 1e-8, 1e-9}) {
      const Result result = simulate(case_with(section, method, table, rtol));
      fmt::print("{:8} {:18} {:8.0e} ", method_name, table, rtol);
      if (!result.outcome.completed()) {
        fmt::print("{}\n", result.outcome.message);
        continue;
      }
      fmt::print(
          "{:16} {:10.3f} {:12.1e} {:12}\n", result.work.right_hand_sides, result.work.wall_seconds,
          1e6 * (last_separation(result) - last_separation(reference)), result.sub_impacts.size());
    }
  }
}

}  // namespace

void measure_tables(const Settings& /*settings*/) {
  fmt::print("erk and nystrom with each table; seconds are wall time.\n");
  print_tables_of(SectionKind::elastic, "Elastic", 1e-12);
  print_tables_of(SectionKind::exact, "Exact", 1e-11);
}

}  // namespace subimpact::benchmarks
