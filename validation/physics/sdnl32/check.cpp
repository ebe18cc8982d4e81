// SDNL32: a turning beam with 1 % damping meets a spring.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

constexpr double published_mm[] = {-2.66, -4.33, -4.92, -4.78, -3.82, -2.87,
                                   -2.71, -3.09, -3.41, -3.36, -2.64, -0.742};
constexpr double largest_mm = 4.92;

// The history row at a time; both sides of an event have rows of their own.
const HistoryRow& row_at(const Result& result, double time) {
  return *std::min_element(result.history.begin(), result.history.end(),
                           [time](const HistoryRow& a, const HistoryRow& b) {
                             return std::abs(a.time - time) < std::abs(b.time - time);
                           });
}

// Error of the balance over the largest energy that has left the striker.
double balance_error(const Result& result) {
  double error = 0.0;
  double largest = 0.0;
  for (const HistoryRow& row : result.history) {
    error = std::max(error, std::abs(row.energy_error) * result.used.initial_energy);
    largest = std::max(largest, row.beam_kinetic_energy + row.bending_elastic +
                                    row.contact_elastic + row.beam_damping);
  }
  return error / largest;
}

}  // namespace

Outcome check_sdnl32() {
  Outcome outcome{"code_aster, VPCS", {}, {}};
  const Result result = simulate(case_of("sdnl32"));
  int ms = 0;
  for (const double published : published_mm) {
    ++ms;
    // The spring is at rest in the resting frame, where the tip is at -lambda.
    const double ours = -1e3 * row_at(result, 1e-3 * ms).indentation;
    outcome.rows.push_back(
        {fmt::format("tip at {} ms, mm", ms), published, ours, Bound::absolute, 0.01 * largest_mm});
  }
  outcome.rows.push_back({"error of the energy over that of beam and spring", 1e-8,
                          balance_error(result), Bound::within, 0.0});
  outcome.notes.push_back(
      fmt::format("Damping has dissipated {:.4f} J by {:.1f} ms, of {:.4f} J "
                  "that the striker gave.",
                  result.beam_damping_loss, 1e3 * result.outcome.time,
                  result.used.initial_energy - result.history.back().striker_energy));
  return outcome;
}

}  // namespace subimpact::validation
