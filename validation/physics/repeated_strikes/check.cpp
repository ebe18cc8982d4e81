// Strike after strike: rigid bodies beside the balance of each dent, and a bar struck 91 times.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "case/problem.h"
#include "outcome.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::validation {
namespace {

constexpr int n_shown[] = {1, 2, 5, 20, 91};

// Of two rigid bodies: R + D grows by the energy of the approach between two largest indentations.
std::vector<double> restitutions_of_rigid_bodies(const Case& input) {
  const auto law = contact_law_of(input);
  const double m = input.scene.striker.mass;
  const double v0 = input.scene.striker.velocity;
  const double beam = input.scene.beam.mass();
  const double energy = 0.5 * m * beam / (m + beam) * v0 * v0;
  std::vector<double> restitutions;
  double before = 0.0;
  for (int k = 0; k < input.strikes; ++k) {
    double low = before, high = input.scene.beam.thickness;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      const double taken = law->recoverable_energy({middle}, middle) +
                           law->dissipated_energy({middle}) - law->dissipated_energy({before});
      (taken < energy ? low : high) = middle;
    }
    restitutions.push_back(std::sqrt(law->recoverable_energy({low}, low) / energy));
    before = low;
  }
  return restitutions;
}

void check_rigid(Outcome& outcome) {
  Case rigid = case_of("repeated_strikes", {"model.mesh=rigid", "beam.ends=free,free",
                                            "solver.method=nystrom", "solver.rtol=1e-11"});
  rigid.end_time = 2e-3;
  RunRequest request;
  request.error_bars = ErrorBars::off;
  const Result result = run_as_asked(rigid, {}, std::move(request)).result;
  const std::vector<double> exact = restitutions_of_rigid_bodies(rigid);
  for (const int k : n_shown) {
    const auto i = static_cast<std::size_t>(k - 1);
    outcome.rows.push_back({fmt::format("restitution of strike {}, rigid bodies", k), exact[i],
                            result.strikes.at(i).restitution.value_or(NAN), Bound::relative, 1e-8});
  }
}

void check_bar(Outcome& outcome) {
  const std::clock_t start = std::clock();
  const GivenKeys given{{"model.segments", "solver.method"}, {}};
  const Result result = run_as_asked(case_of("repeated_strikes"), given, {}).result;
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const std::vector<StrikeRow>& strikes = result.strikes;
  outcome.rows.push_back(
      {"strikes of the bar", 91, static_cast<double>(strikes.size()), Bound::absolute, 0.0});
  outcome.rows.push_back({"processor time of all, s", 30, seconds, Bound::within, 0.0});
  const bool grows = std::ranges::is_sorted(strikes, {}, &StrikeRow::dent);
  outcome.rows.push_back({"the dent never shrinks", 1, grows ? 1.0 : 0.0, Bound::holds, 0.0});
  double worst = 0.0;
  for (const StrikeRow& row : strikes) {
    const double energy =
        row.striker_energy + row.vibration + row.bending_dissipated + row.contact_dissipated;
    worst = std::max(worst, result.used.initial_energy - energy);
  }
  outcome.rows.push_back({"energy that strikes lose, of theirs, beyond all accounts", 1e-3,
                          worst / result.used.initial_energy, Bound::within, 0.0});
  const auto dissipated = [](const StrikeRow& row) {
    return row.bending_dissipated + row.contact_dissipated;
  };
  outcome.rows.push_back({"dissipated by strike 91, of that by strike 1", 0.5,
                          dissipated(strikes.back()) / dissipated(strikes.front()), Bound::within,
                          0.0});
  std::string table =
      "| strike | sub-impacts | restitution | dent, mm | permanent set, mm | bending, J | contact, "
      "J "
      "|\n|---|---|---|---|---|---|---|\n";
  for (const int k : n_shown) {
    const StrikeRow& row = strikes.at(static_cast<std::size_t>(k - 1));
    table += fmt::format(
        "| {} | {} | {:.4f} ± {:.1g} | {:.4f} | {:.4f} ± {:.1g} | {:.3g} | {:.3g} |\n", row.strike,
        row.sub_impacts, row.restitution.value_or(NAN), row.restitution_error.value_or(NAN),
        1e3 * row.dent, 1e3 * row.permanent_set, 1e3 * row.permanent_set_error.value_or(NAN),
        row.bending_dissipated, row.contact_dissipated);
  }
  outcome.notes.push_back("The bar, on the mesh that the first strike chose (" + result.used.mesh +
                          "):\n\n" + table);
}

}  // namespace

Outcome check_repeated_strikes() {
  Outcome outcome{"closed form", {}, {}};
  check_rigid(outcome);
  check_bar(outcome);
  return outcome;
}

}  // namespace subimpact::validation
