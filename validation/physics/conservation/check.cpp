// What must not change: energy, momentum; and what the strike can lose at most.

#include <fmt/format.h>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {

Outcome check_conservation() {
  Outcome outcome{"exact invariants", {}, {}};
  for (const char* section : {"elastic", "exact", "layers"}) {
    const Case input = case_of("conservation", {std::string("model.section=") + section});
    const Result result = simulate(input);
    outcome.rows.push_back({fmt::format("{}: largest energy error of any row, relative", section),
                            1e-7, result.max_energy_error, Bound::within, 0.0});
    outcome.rows.push_back({fmt::format("{}: largest momentum error, relative", section), 1e-12,
                            result.max_momentum_error.value(), Bound::within, 0.0});
    const HistoryRow& last = result.history.back();
    const double m = input.scene.striker.mass;
    const double beam = input.scene.beam.mass();
    outcome.rows.push_back({fmt::format("{}: plastic loss, J, below that of sticking", section),
                            result.used.initial_energy * beam / (m + beam),
                            last.bending_plastic + last.contact_plastic, Bound::within, 0.0});
  }
  outcome.rows.push_back(
      {"bound on the loss, J", 13.449, outcome.rows[2].published, Bound::absolute, 0.0006});
  return outcome;
}

}  // namespace subimpact::validation
