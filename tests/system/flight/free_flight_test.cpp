// A struck beam in free flight: oscillators about the shape that past flow has left.

#include "system/flight/free_flight.h"
#include "beam_under_test.h"

namespace subimpact {
namespace {

// The other integrator: time passes in short steps, and nothing moves.
class Resting final : public Integrator {
 public:
  void restart(double t, const State& y) override {
    t0_ = t1_ = t;
    y0_ = y1_ = y;
  }
  void step() override {
    t0_ = t1_;
    t1_ += 1e-9;
  }
  void state_at(double, State& y) override { y = y1_; }
  WorkCounts work() const override { return {}; }
};

// A beam, separated, that has been bent beyond yield and let back by some.
class AFreeFlight : public testing::TestWithParam<Model> {
 protected:
  AFreeFlight() : beam_(make_beam(GetParam())), n_(beam_.n_positions() - 1) {
    beam_.set_section_evaluation(Evaluation::smooth);
    enter(beam_, ContactBranch::separated, 0.0);
    const State bent = smooth_state(beam_, 3, 1.8, -1e-4, -0.3);
    beam_.commit(bent);
    y_ = bent;
    for (std::size_t i = 0; i < n_; ++i) y_[i] *= 0.6;
    for (std::size_t i = 0; i < n_; ++i) y_[n_ + 1 + i] *= -1.0;
    y_[n_] = beam_.mesh().struck_point()({y_.data(), n_}) - gap;
    beam_.commit(y_);
  }
  // Takes steps until one is a free flight; false if none is.
  bool fly(const State& y, double max_step = std::numeric_limits<double>::infinity()) {
    flight_ = std::make_unique<FreeFlight>(std::make_unique<Resting>(), beam_, max_step);
    flight_->restart(0.0, y);
    for (int i = 0; i < 100 && !flight_->is_event_free(); ++i) flight_->step();
    return flight_->is_event_free();
  }
  double length() const { return flight_->time() - flight_->start_time(); }
  State at(double t) {
    State y;
    flight_->state_at(flight_->start_time() + t, y);
    return y;
  }
  // Smallest distance to a limit: of sections to the edges of their windows, in yield curvatures,
  // and of the indentation to the residual one, in gaps as free flight began.
  double to_nearest_limit(const State& y) const {
    std::vector<double> kappa(beam_.mesh().n_sections());
    beam_.mesh().curvatures({y.data(), n_}, kappa);
    double nearest = (beam_.contact().residual_indentation() - beam_.indentation(y)) / gap;
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      const double above = beam_.sections().window_high()[i] - kappa[i];
      const double below = kappa[i] - beam_.sections().window_low()[i];
      nearest = std::min(nearest, std::min(above, below) / paper_beam().yield_curvature());
    }
    return nearest;
  }

  static constexpr double gap = 1e-4;  // m
  StruckBeam beam_;
  std::size_t n_;
  State y_;
  std::unique_ptr<FreeFlight> flight_;
};

TEST_P(AFreeFlight, BeginsAtTheStateOfTheOtherIntegrator) {
  ASSERT_TRUE(fly(y_));
  EXPECT_EQ(flight_->start_state(), y_);
  const State start = at(0.0);
  for (std::size_t i = 0; i < y_.size(); ++i) {
    EXPECT_NEAR(start[i], y_[i], 1e-11 * (i <= n_ ? 1e-2 : 10.0)) << i;
  }
  EXPECT_EQ(flight_->state(), at(length()));
}

TEST_P(AFreeFlight, MovesAsTheBeamDoes) {
  // Central differences of displacements and velocities against the beam's own equations.
  ASSERT_TRUE(fly(y_));
  const double t = 0.5 * length();
  const double h = 1e-9;
  const State before = at(t - h), y = at(t), after = at(t + h);
  std::vector<double> acceleration(n_ + 1);
  beam_.acceleration({y.data(), n_ + 1}, acceleration);
  const double largest = largest_of(acceleration);
  const double fastest = largest_of({&y[n_ + 1], n_ + 1});
  for (std::size_t i = 0; i <= n_; ++i) {
    const std::size_t v = n_ + 1 + i;
    EXPECT_NEAR((after[i] - before[i]) / (2.0 * h), y[v], 1e-6 * fastest) << i;
    EXPECT_NEAR((after[v] - before[v]) / (2.0 * h), acceleration[i], 1e-6 * largest) << i;
  }
}

TEST_P(AFreeFlight, HasTheSameStatesAtTimesThatWereExpected) {
  ASSERT_TRUE(fly(y_));
  std::vector<double> times;
  std::vector<State> alone;
  for (int i = 0; i < 150; ++i) {
    times.push_back(flight_->start_time() + length() * i / 150.0);
    alone.push_back(at(length() * i / 150.0));
  }
  flight_->expect(times);
  for (const std::size_t i : {0u, 1u, 63u, 64u, 149u, 10u}) {
    State y;
    flight_->state_at(times[i], y);
    ASSERT_EQ(y.size(), alone[i].size());
    for (std::size_t k = 0; k < y.size(); ++k) {
      EXPECT_NEAR(y[k], alone[i][k], 1e-9 * (k <= n_ ? gap : 1.0)) << i << ' ' << k;
    }
  }
}

TEST_P(AFreeFlight, StaysWithinWindowsAndApartAndCoversFourFifthsOfTheTimeToALimit) {
  ASSERT_TRUE(fly(y_));
  for (int i = 0; i <= 10000; ++i) ASSERT_GT(to_nearest_limit(at(1e-4 * i * length())), 0.0) << i;
  double nearest = 1.0;
  for (int i = 0; i <= 100; ++i) {
    nearest = std::min(nearest, to_nearest_limit(at(length() * (1.0 + 2.5e-3 * i))));
  }
  EXPECT_LT(nearest, 0.0);
}

TEST_P(AFreeFlight, IsNoLongerThanTheLargestStep) {
  ASSERT_TRUE(fly(y_));
  const double half = 0.5 * length();
  ASSERT_TRUE(fly(y_, half));
  EXPECT_NEAR(length(), half, 1e-9 * half);
}

TEST_P(AFreeFlight, DoesNotBeginInContactOrWhileASectionFlows) {
  beam_.contact().pass(EventKind::contact_begins, beam_.indentation(y_));
  EXPECT_FALSE(fly(y_));
  beam_.contact().pass(EventKind::contact_ends, beam_.indentation(y_));
  EXPECT_TRUE(fly(y_));
  State flowing = y_;
  for (std::size_t i = 0; i < n_; ++i) flowing[i] *= 4.0;
  for (std::size_t i = 0; i < n_; ++i) flowing[n_ + 1 + i] = 1e3 * flowing[i];
  beam_.commit(flowing);
  EXPECT_FALSE(fly(flowing));
}

INSTANTIATE_TEST_SUITE_P(, AFreeFlight, testing::Values(models()[1], models()[3], models()[4]),
                         NamedAsPrinted{});

}  // namespace
}  // namespace subimpact
