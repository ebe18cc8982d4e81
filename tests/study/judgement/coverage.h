#pragma once

#include "subimpact/simulate/result.h"
#include "subimpact/study/judgement/event_errors.h"
#include "testing.h"

namespace subimpact {

/// How many stated errors cover the true ones, and how wide they are in the middle.
class Coverage {
 public:
  void judge(double stated, double error) {
    ++n_events_;
    n_covered_ += error <= stated;
    if (error > 0.0) ratios_.push_back(stated / error);
  }

  /// The starts and ends of the certain sub-impacts, but for the first start, against those of a
  /// run without errors worth the name.
  void judge(const Result& result, const Result& exact) {
    const Counterparts exact_ones = counterparts(result.sub_impacts, exact.sub_impacts);
    for (std::size_t i = 0; i < result.sub_impacts.size(); ++i) {
      const SubImpact& here = result.sub_impacts[i];
      if (!*here.certain) continue;
      ASSERT_TRUE(exact_ones.of[i]) << i;
      const SubImpact& there = *exact_ones.of[i];
      if (i > 0) judge(here.start_error.value(), std::abs(here.start - there.start));
      if (here.end && there.end) judge(here.end_error.value(), std::abs(*here.end - *there.end));
    }
  }

  /// At least that many times, 95 % of them covered, by errors that are in the middle above the
  /// true ones and less than `most` times them.
  void expect(int least_events, double most) {
    std::sort(ratios_.begin(), ratios_.end());
    const double median = ratios_.at(ratios_.size() / 2);
    std::printf("%d of %d event times covered (%.1f %%), median stated/true %.1f\n", n_covered_,
                n_events_, 100.0 * n_covered_ / n_events_, median);
    EXPECT_GE(n_events_, least_events);
    EXPECT_GE(n_covered_, 0.95 * n_events_);
    EXPECT_LT(median, most);
    EXPECT_GT(median, 1.0);
  }

 private:
  int n_events_ = 0, n_covered_ = 0;
  std::vector<double> ratios_;
};

}  // namespace subimpact
