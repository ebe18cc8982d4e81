// A struck beam in free flight: oscillators about a shape left by what has flowed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "beam_under_test.h"
#include "system/beam_flight.h"

namespace subimpact {
namespace {

// A beam, separated, that has been bent beyond yield and let back by half.
class FlyingBeam : public testing::TestWithParam<Model> {
 protected:
  FlyingBeam() : beam_(make_beam(GetParam())), n_(beam_.n_positions() - 1) {
    beam_.set_section_evaluation(Evaluation::smooth);
    enter(beam_, ContactBranch::separated, 0.0);
    State bent = smooth_state(beam_, 3, 1.8, -1e-4, -0.3);
    beam_.commit(bent);
    y_ = bent;
    for (std::size_t i = 0; i < n_; ++i) y_[i] *= 0.6;
    for (std::size_t i = 0; i < n_; ++i) y_[n_ + 1 + i] *= -1.0;
    y_[n_] = beam_.mesh().struck_point()({y_.data(), n_}) - 1e-4;
    beam_.commit(y_);
    flight_ = std::make_unique<BeamFlight>(beam_);
    const std::size_t n_modes = flight_->frequencies().size();
    z_.resize(n_modes);
    rates_.resize(n_modes);
    low_.resize(flight_->n_guards());
    high_.resize(flight_->n_guards());
    flight_->enter(y_, z_, rates_, low_, high_);
  }
  double value(std::size_t guard) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < z_.size(); ++k) sum += flight_->guard(guard)[k] * z_[k];
    return sum;
  }

  StruckBeam beam_;
  std::size_t n_;
  State y_;
  std::unique_ptr<BeamFlight> flight_;
  std::vector<double> z_, rates_, low_, high_;
};

TEST_P(FlyingBeam, IsTheSameStateThereAndBack) {
  EXPECT_TRUE(flight_->possible());
  State back;
  flight_->leave(z_, rates_, back);
  ASSERT_EQ(back.size(), y_.size());
  for (std::size_t i = 0; i < y_.size(); ++i) {
    EXPECT_NEAR(back[i], y_[i], 1e-11 * (i <= n_ ? 1e-2 : 10.0)) << i;
  }
}

TEST_P(FlyingBeam, LimitsAreTheElasticWindowsAndTheGap) {
  std::vector<double> kappa(beam_.mesh().n_sections());
  beam_.mesh().curvatures({y_.data(), n_}, kappa);
  const double kappa_y = paper_beam().yield_curvature();
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    EXPECT_NEAR(high_[i] - value(i), beam_.sections().window_high()[i] - kappa[i], 1e-9 * kappa_y);
    EXPECT_NEAR(value(i) - low_[i], kappa[i] - beam_.sections().window_low()[i], 1e-9 * kappa_y);
  }
  EXPECT_NEAR(high_.back() - value(kappa.size()),
              beam_.contact().residual_indentation() - beam_.indentation(y_), 1e-15);
}

TEST_P(FlyingBeam, OutlookIsTheTimeInWhichTheFirstGuardGetsToItsLimitAtItsRate) {
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < flight_->n_guards(); ++i) {
    double rate = 0.0;
    for (std::size_t k = 0; k < z_.size(); ++k) rate += flight_->guard(i)[k] * rates_[k];
    const double way = rate > 0.0 ? high_[i] - value(i) : low_[i] - value(i);
    first = std::min(first, way / rate);
  }
  EXPECT_NEAR(flight_->outlook(y_), first, 1e-6 * first);
}

TEST_P(FlyingBeam, AcceleratesAsTheBeamDoes) {
  // z'' = -omega^2 z against the beam's own acceleration, with what has flowed.
  std::vector<double> acceleration(n_ + 1);
  beam_.acceleration({y_.data(), n_ + 1}, acceleration);
  std::vector<double> second(z_.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < z_.size(); ++k) {
    second[k] = -flight_->frequencies()[k] * flight_->frequencies()[k] * z_[k];
  }
  State mapped, rest;
  flight_->leave(second, second, mapped);
  for (const double a : acceleration) largest = std::fmax(largest, std::abs(a));
  for (std::size_t i = 0; i <= n_; ++i) {
    EXPECT_NEAR(mapped[n_ + 1 + i], acceleration[i], 1e-8 * largest) << i;
  }
}

TEST_P(FlyingBeam, CannotFlyWhileInContactOrFlowing) {
  beam_.contact().pass(EventKind::contact_begins, beam_.indentation(y_));
  EXPECT_FALSE(flight_->possible());
  beam_.contact().pass(EventKind::contact_ends, beam_.indentation(y_));
  EXPECT_TRUE(flight_->possible());
  State flowing = y_;
  for (std::size_t i = 0; i < n_; ++i) flowing[i] *= 4.0;
  for (std::size_t i = 0; i < n_; ++i) flowing[n_ + 1 + i] = 1e3 * flowing[i];
  beam_.commit(flowing);
  EXPECT_FALSE(flight_->possible());
}

INSTANTIATE_TEST_SUITE_P(, FlyingBeam, testing::Values(models()[1], models()[3], models()[4]),
                         [](const auto& info) { return "model" + std::to_string(info.index); });

}  // namespace
}  // namespace subimpact
