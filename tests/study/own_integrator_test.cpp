// An integrator from outside goes through events, errors and comparison as built-in ones do.

#include "../../examples/velocity_verlet.h"
#include "elastic_case.h"
#include "judgement/coverage.h"
#include "subimpact/study/studies.h"
#include "testing.h"

namespace subimpact {
namespace {

Case strike(double end_time, double step) {
  Case input = elastic_case(end_time);
  input.model.segments = 51;
  input.scene.contact = {ContactKind::linear, 2e7, {}, {}, {}};
  input.scene.striker.nose_radius.reset();
  input.solver.method = Method::own;
  input.solver.step = step;
  input.parts.integrator = velocity_verlet();
  return input;
}

TEST(OwnVelocityVerlet, HasOrderTwoOnEventsInAComparisonBesideBuiltInMethods) {
  std::vector<double> errors;
  for (const double step : {0.2e-6, 0.1e-6, 0.05e-6}) {
    const Comparison comparison =
        compare(strike(1e-3, step), {"own", "central-difference", "nystrom"});
    ASSERT_EQ(comparison.runs.size(), 3u);
    for (const ComparedRun& run : comparison.runs) {
      EXPECT_EQ(run.verdict, Verdict::right) << run.message;
      EXPECT_EQ(run.result.used.step, step);
    }
    errors.push_back(comparison.runs.front().errors.maximum);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2.0, 0.05);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2.0, 0.05);
}

TEST(OwnVelocityVerlet, StatesErrorsThatCoverInNineteenOfTwenty) {
  Coverage coverage;
  for (const double velocity : {10.0, 12.0, 14.0, 15.9, 20.0}) {
    for (const double step : {0.2e-6, 0.1e-6}) {
      Case input = strike(1e-3, step);
      input.scene.striker.velocity = velocity;
      const Result run = simulate_judged(input, cases_beside_in_time(input), 2);
      coverage.judge(run, run_reference(input, 1e-11).result);
    }
  }
  coverage.expect(40, 20.0);
}

TEST(OwnVelocityVerlet, IsSweptAtFixedStepsOnlyAndDampingIsRefused) {
  Case input = strike(1e-3, 1e-7);
  WorkPrecisionOptions options;
  options.methods = {"own"};
  options.most_repeats = 0;
  const WorkPrecision study = work_precision(input, options);
  EXPECT_TRUE(
      std::ranges::all_of(study.points, [](const Trial& p) { return p.setting.fixed_step; }));
  ASSERT_TRUE(study.orders.at(0).observed);
  EXPECT_NEAR(*study.orders[0].observed, 2.0, 0.1);
  EXPECT_EQ(study.orders[0].smooth, 2);
  input.scene.beam.damping.mass = 10.0;
  expect_in(message_of<InvalidCase>([&] { simulate(input); }), "OwnIntegrator::takes_velocities");
}

}  // namespace
}  // namespace subimpact
