#pragma once

#include "subimpact/simulate/result.h"
#include "testing.h"

namespace subimpact {

/// Counts, verdicts and totals of a judged run are one account: zones add up to the run, their
/// times have no smaller errors than those of their sub-impacts, the number of sub-impacts has no
/// error where all are certain, and contact is not said to be over where another sub-impact is
/// possible.
inline void expect_one_account(const Result& result) {
  ASSERT_TRUE(result.error_estimate);
  const ErrorEstimate& estimate = *result.error_estimate;
  const auto named = std::ranges::find(estimate.totals, RunTotal::sub_impacts, &NamedTotal::name);
  ASSERT_NE(named, estimate.totals.end());
  const auto& [count, error] = named->total;
  const auto n = static_cast<double>(result.sub_impacts.size());
  EXPECT_EQ(count, n);
  double of_zones = 0.0, errors = 0.0;
  for (const ZoneTotals& zone : estimate.zones) {
    of_zones += zone.sub_impacts.value;
    errors += zone.sub_impacts.error.value_or(HUGE_VAL);
  }
  EXPECT_EQ(of_zones, n);
  for (const SubImpact& s : result.sub_impacts) {
    const ZoneTotals& zone = estimate.zones.at(static_cast<std::size_t>(s.zone - 1));
    EXPECT_TRUE(s.start != zone.start.value || zone.start.error.value_or(1.0) >= s.start_error);
    EXPECT_TRUE(s.end != zone.end.value || zone.end.error.value_or(1.0) >= s.end_error);
  }
  EXPECT_EQ(errors, n > 0.0 ? error.value_or(HUGE_VAL) : 0.0);
  const double n_doubts = n - static_cast<double>(*result.n_certain()) +
                          static_cast<double>(estimate.uncertain_flights.size());
  EXPECT_GE(error.value_or(HUGE_VAL), n_doubts);
  EXPECT_TRUE(estimate.finer_meshes || !error || result.all_certain() == (*error == 0.0));
  const bool may_have_more = estimate.doubt_after(result.sub_impacts.size() - 1) != nullptr;
  EXPECT_FALSE(result.contact_over && may_have_more);
}

}  // namespace subimpact
