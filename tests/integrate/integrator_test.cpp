// What every method promises besides its order: steps, states inside them, restarts, work, errors.

#include "methods.h"
#include "test_systems.h"

namespace subimpact {
namespace {

class EveryMethod : public testing::TestWithParam<ExplicitMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::ValuesIn(all_methods()), NamedAsPrinted{});

class EveryAdaptiveMethod : public testing::TestWithParam<ExplicitMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, EveryAdaptiveMethod, testing::ValuesIn(adaptive_methods()),
                         NamedAsPrinted{});

TEST_P(EveryMethod, StatesInsideAStepAgreeWithItsEnds) {
  CurvedMotion motion;
  const double step = 0.02;
  const auto integrator = GetParam().with_step(motion, step);
  integrator->restart(1.0, motion.exact(1.0));
  State inside;
  for (int i = 0; i < 20; ++i) {
    integrator->step();
    integrator->state_at(integrator->time(), inside);
    EXPECT_LE(largest_difference(inside, integrator->state()), 1e-14);
    integrator->state_at(integrator->start_time() + 1e-9 * step, inside);
    EXPECT_LE(largest_difference(inside, integrator->start_state()), 1e-10);
    integrator->state_at(integrator->start_time(), inside);
    EXPECT_LE(largest_difference(inside, integrator->start_state()), 1e-15);
  }
}

TEST_P(EveryMethod, LookingInsideAStepDoesNotDisturbTheNextOne) {
  CurvedMotion motion;
  const auto undisturbed = GetParam().with_step(motion, 0.02);
  const auto looked_into = GetParam().with_step(motion, 0.02);
  undisturbed->restart(0.0, motion.initial());
  looked_into->restart(0.0, motion.initial());
  State inside;
  for (int i = 0; i < 50; ++i) {
    undisturbed->step();
    looked_into->step();
    for (const double part : {0.9, 0.1, 0.5}) {
      looked_into->state_at(looked_into->start_time() + part * 0.02, inside);
    }
  }
  EXPECT_EQ(undisturbed->state(), looked_into->state());
}

TEST_P(EveryMethod, RestartForgetsWhatWasBefore) {
  CurvedMotion motion;
  const auto fresh = GetParam().with_step(motion, 0.02);
  const auto used = GetParam().with_step(motion, 0.02);
  used->restart(0.0, motion.initial());
  for (int i = 0; i < 7; ++i) used->step();
  used->restart(2.0, motion.exact(2.0));
  fresh->restart(2.0, motion.exact(2.0));
  for (int i = 0; i < 20; ++i) {
    used->step();
    fresh->step();
  }
  EXPECT_EQ(used->state(), fresh->state());
  EXPECT_EQ(used->time(), fresh->time());
}

TEST_P(EveryMethod, CostsTheEvaluationsItsTableClaims) {
  CurvedMotion motion;
  const auto integrator = GetParam().with_step(motion, 0.02);
  integrator->restart(0.0, motion.initial());
  for (int i = 0; i < 100; ++i) integrator->step();
  const WorkCounts work = integrator->work();
  EXPECT_EQ(work.steps, 100);
  EXPECT_GE(work.right_hand_sides, 100 * GetParam().evaluations);
  EXPECT_LE(work.right_hand_sides, 100 * GetParam().evaluations + 2);  // the first one
}

struct Interrupted {
  int at_call;
};

TEST_P(EveryMethod, LetsAnExceptionOfTheAccelerationOutWhole) {
  int calls = 0;
  AnyMotion motion(5, [&](std::span<const double> q, std::span<double> a) {
    if (++calls == 20) throw Interrupted{calls};
    for (std::size_t i = 0; i < 5; ++i) a[i] = -q[i];
  });
  const auto integrator = GetParam().with_step(motion, 0.1);
  const State start{1.0, 2.0, 3.0, 4.0, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  const auto run = [&] {
    integrator->restart(0.0, start);
    for (int i = 0; i < 20; ++i) integrator->step();
  };
  try {
    run();
    FAIL() << "nothing came out";
  } catch (const Interrupted& interrupted) {
    EXPECT_EQ(interrupted.at_call, 20);
  }
  // And it can be used again.
  run();
  EXPECT_NEAR(integrator->state()[4], 5.0 * std::cos(2.0), 0.02);
}

// Error at t = 10 of an adaptive run.
double adaptive_error(const ExplicitMethod& method, KnownMotion& motion, double rtol,
                      WorkCounts* work = nullptr) {
  const auto integrator = method.with_tolerance(motion, rtol);
  integrator->restart(0.0, motion.initial());
  while (integrator->time() < 10.0) integrator->step();
  State end;
  integrator->state_at(10.0, end);
  if (work) *work = integrator->work();
  return motion.error(10.0, end);
}

TEST_P(EveryAdaptiveMethod, ErrorFallsWithTheToleranceAboutAsFast) {
  CurvedMotion motion;
  OrderTable table(GetParam().name + ": error over 1/rtol");
  long steps = 0;
  for (const double rtol : {1e-3, 1e-5, 1e-7, 1e-9}) {
    WorkCounts work;
    const double error = adaptive_error(GetParam(), motion, rtol, &work);
    table.add(1.0 / rtol, error);
    EXPECT_LE(error, 300.0 * rtol);
    EXPECT_GT(work.steps, steps);
    steps = work.steps;
  }
  table.print();
  table.expect_overall_order_within(0.7, 1.5);
}

TEST_P(EveryAdaptiveMethod, ChoosesTheSameStepsWhateverTheUnitOfTime) {
  SpringChain slow(5, 1.0);
  SpringChain fast(5, 0x1p20);
  const auto slow_run = GetParam().with_tolerance(slow, 1e-6);
  const auto fast_run = GetParam().with_tolerance(fast, 1e-6);
  slow_run->restart(0.0, slow.initial());
  fast_run->restart(0.0, fast.initial());
  const auto steps_to = [](Integrator& integrator, double end) {
    while (integrator.time() < end) integrator.step();
    return static_cast<double>(integrator.work().steps);
  };
  const double a = steps_to(*slow_run, 100.0);
  const double b = steps_to(*fast_run, 100.0 * 0x1p-20);
  EXPECT_NEAR(a, b, 0.02 * a + 5.0);
}

TEST_P(EveryAdaptiveMethod, AnAccelerationThatIsNoLongerANumberEndsInAFailureThatExplainsItself) {
  int calls = 0;
  AnyMotion motion(1, [&](std::span<const double> q, std::span<double> a) {
    a[0] = ++calls > 500 ? std::numeric_limits<double>::quiet_NaN() : -q[0];
  });
  const auto integrator = GetParam().with_tolerance(motion, 1e-8);
  integrator->restart(0.0, {0.0, 1.0});
  double reached = 0.0;
  State there;
  try {
    for (int i = 0; i < 10000; ++i) {
      reached = integrator->time();
      there = integrator->state();
      integrator->step();
    }
    FAIL() << "went on to t = " << integrator->time();
  } catch (const IntegrationFailure& failure) {
    EXPECT_FALSE(failure.function.empty() || failure.flag.empty());
    expect_in(failure.what(), failure.function, failure.flag);
    EXPECT_GT(failure.time, 0.0);
    EXPECT_TRUE(std::isfinite(failure.time));
    // The state is still that of the last accepted step.
    EXPECT_EQ(integrator->time(), reached);
    EXPECT_EQ(integrator->state(), there);
  }
}

// q'' = 1/(1 - q)^2, drawn into a wall that it reaches with infinite velocity: steps shrink without
// an end, each of them accepted.
TEST_P(EveryAdaptiveMethod, StepsThatShrinkForEverEndInAFailure) {
  AnyMotion motion(1, [](std::span<const double> q, std::span<double> a) {
    a[0] =
        q[0] < 1.0 ? 1.0 / ((1.0 - q[0]) * (1.0 - q[0])) : std::numeric_limits<double>::quiet_NaN();
  });
  const auto integrator = GetParam().with_tolerance(motion, 1e-6);
  integrator->restart(1.0, {0.0, 0.0});
  EXPECT_THROW(for (int i = 0; i < 20000; ++i) integrator->step(), IntegrationFailure);
  EXPECT_LT(integrator->state()[0], 1.0);
  EXPECT_TRUE(std::isfinite(integrator->state()[1]));
}

// Every method has the order its table claims, at whole steps and inside them, no less and no more.

class Order : public testing::TestWithParam<ExplicitMethod> {
 protected:
  void expect_order(KnownMotion& motion, double end, double place) {
    const double order = GetParam().order, band = GetParam().order_band;
    expect_finest_order(order - band, order + band, {6, 2e-4, 5e-12},
                        [&](int n) { return error_in_steps(GetParam(), motion, end, n, place); });
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Order, testing::ValuesIn(all_methods()), NamedAsPrinted{});

TEST_P(Order, OnACurvedMotionIsTheMethodsOwn) {
  CurvedMotion motion;
  expect_order(motion, 4.0, 1.0);
}

TEST_P(Order, InsideStepsIsTheMethodsOwn) {
  CurvedMotion motion;
  expect_order(motion, 4.0, 0.37);
}

}  // namespace
}  // namespace subimpact
