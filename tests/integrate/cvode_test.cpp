// The multistep methods: accuracy by tolerance, stability on oscillations, restarts, failures.

#include "integrate/sundials.h"
#include "mechanical_systems.h"
#include "print.h"

namespace subimpact {
namespace {

struct Family {
  std::string name;
  int max_order;
  std::function<std::unique_ptr<Integrator>(MechanicalSystem&, const IntegratorOptions&)> make;

  std::unique_ptr<Integrator> with_tolerance(MechanicalSystem& system, double rtol) const {
    return make(system, {.relative_tolerance = rtol, .max_order = max_order});
  }
};

std::ostream& operator<<(std::ostream& out, const Family& family) { return out << family.name; }

class Multistep : public testing::TestWithParam<Family> {};
INSTANTIATE_TEST_SUITE_P(Families, Multistep,
                         testing::Values(Family{"adams", adams_order_limit, make_cvode_adams},
                                         Family{"bdf2", 2, make_cvode_bdf},
                                         Family{"bdf5", bdf_order_limit, make_cvode_bdf}),
                         NamedAsPrinted{});

struct Errors {
  double at_steps = 0.0, inside = 0.0;
};
Errors errors_until(double end, KnownSystem& system, Integrator& integrator) {
  Errors errors;
  State y;
  integrator.restart(0.0, system.initial());
  while (integrator.time() < end) {
    integrator.step();
    const double t = integrator.start_time() + 0.6 * (integrator.time() - integrator.start_time());
    integrator.state_at(t, y);
    errors.inside = std::max(errors.inside, system.error(t, y));
    errors.at_steps =
        std::max(errors.at_steps, system.error(integrator.time(), integrator.state()));
  }
  return errors;
}

TEST_P(Multistep, ErrorFallsWithTheTolerance) {
  CurvedSystem system;
  OrderTable table(GetParam().name + ": error over 1/rtol");
  for (double rtol = 1e-4; rtol > 5e-11; rtol *= 0.1) {
    const auto integrator = GetParam().with_tolerance(system, rtol);
    const Errors errors = errors_until(10.0, system, *integrator);
    table.add(1.0 / rtol, errors.at_steps);
    EXPECT_LT(errors.inside, 2.0 * errors.at_steps) << "rtol " << rtol;
  }
  table.print();
  // An error per step kept below the tolerance makes the whole error fall as rtol^(p/(p + 1)), p
  // the order in use.
  table.expect_overall_order_within(0.6, 1.2);
}

TEST_P(Multistep, ConsistentMassIsSolvedWith) {
  ElasticBar bar(6);
  const auto integrator = GetParam().with_tolerance(bar, 1e-9);
  EXPECT_LT(errors_until(5.0, bar, *integrator).at_steps, 2e-5);
}

TEST_P(Multistep, RestartBeginsAtAStepOfItsOwn) {
  EXPECT_LT(step_after_restart(GetParam(), 300), 0.3);
}

TEST_P(Multistep, CountsGoOnOverRestarts) {
  ElasticBar bar(5);
  const auto integrator = GetParam().with_tolerance(bar, 1e-6);
  for (int restarts = 0; restarts < 4; ++restarts) {
    integrator->restart(0.0, bar.initial());
    for (int i = 0; i < 25; ++i) integrator->step();
  }
  const WorkCounts work = integrator->work();
  EXPECT_EQ(work.steps, 100);
  EXPECT_GE(work.nonlinear_iterations, 100);
  EXPECT_GE(work.right_hand_sides, work.nonlinear_iterations);
  const bool newton = GetParam().name != "adams";
  EXPECT_EQ(work.pattern_analyses, newton ? 1 : 0);
  EXPECT_EQ(work.factorisations > 4, newton);
}

TEST_P(Multistep, WhatTheAccelerationThrowsComesOutWhole) {
  expect_mishap(GetParam(), ThrowingBar::In::acceleration, 20);
}

// A slow oscillation sets the order; a fast one, far below the tolerance, sees steps of one radian:
// orders 3 to 5 let it grow until the error test notices, orders 1 and 2 damp it away.
TEST(BdfOnTheImaginaryAxis, OrdersAboveTwoLetAFastOscillationGrow) {
  const double fast = 60.0;
  const double seed = 1e-10;
  for (int order = 1; order <= bdf_order_limit; ++order) {
    Oscillators pair(Eigen::Vector2d(1.0, fast), Eigen::Vector2d(1.0, seed));
    const auto integrator = make_cvode_bdf(
        pair, {.relative_tolerance = 1e-6, .max_step = 1.0 / fast, .max_order = order});
    integrator->restart(0.0, pair.initial());
    double largest = 0.0;
    while (integrator->time() < 20.0) {
      integrator->step();
      if (integrator->time() < 10.0) continue;
      largest = std::max(largest, pair.amplitude(integrator->state(), 1));
    }
    EXPECT_TRUE(order <= 2 ? largest < 1e-3 * seed : largest > 1e3 * seed)
        << order << ' ' << largest;
  }
}

}  // namespace
}  // namespace subimpact
