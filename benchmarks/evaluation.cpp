// What adaptive methods add to the cost of a right-hand side, with central differences as the
// measure.

#include <fmt/format.h>

#include "parts.h"

namespace subimpact::benchmarks {

void measure_evaluation(const Settings& settings) {
  Case central = paper_case(SectionKind::elastic);
  central.solver.method = Method::central_difference;
  central.solver.step = 1e-7;
  Case dormand_prince = paper_case(SectionKind::elastic);
  dormand_prince.solver.method = Method::erk;
  dormand_prince.solver.table = "dormand-prince";
  dormand_prince.solver.rtol = 1e-9;
  Case dop853 = dormand_prince;
  dop853.solver.table = "dop853";
  Case nystrom = dormand_prince;
  nystrom.solver.method = Method::nystrom;
  nystrom.solver.table = "dprkn8";

  Result of_central, of_dormand_prince, of_dop853, of_nystrom;
  const std::vector<double> seconds =
      seconds_side_by_side(settings, {[&] { of_central = run_to_end(central); },
                                      [&] { of_dormand_prince = run_to_end(dormand_prince); },
                                      [&] { of_dop853 = run_to_end(dop853); },
                                      [&] { of_nystrom = run_to_end(nystrom); }});

  fmt::print(
      "Elastic section, half model, 2 ms: whole run divided by its right-hand sides (for central\n"
      "differences by its steps). Bar for the ratio: at most 1.6.\n\n");
  fmt::print("{:22} {:>14} {:>10} {:>14} {:>8}\n", "", "right-h. sides", "seconds", "us for one",
             "ratio");
  const double of_a_step = seconds[0] / static_cast<double>(of_central.work.steps);
  const auto row = [&](const char* name, double time, long count) {
    const double each = time / static_cast<double>(count);
    fmt::print("{:22} {:14} {:10.4f} {:14.3f} {:8.2f}\n", name, count, time, 1e6 * each,
               each / of_a_step);
  };
  row("central-difference", seconds[0], of_central.work.steps);
  row("erk, dormand-prince", seconds[1], of_dormand_prince.work.right_hand_sides);
  row("erk, dop853", seconds[2], of_dop853.work.right_hand_sides);
  row("nystrom, dprkn8", seconds[3], of_nystrom.work.right_hand_sides);
}

}  // namespace subimpact::benchmarks
