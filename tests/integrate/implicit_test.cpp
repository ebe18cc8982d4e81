// The implicit Runge-Kutta methods: orders, damping, matrices, failures.

#include "integrate/sundials.h"
#include "mechanical_systems.h"
#include "print.h"

namespace subimpact {
namespace {

struct ImplicitMethod {
  std::string name;
  CoefficientTable table;
  std::unique_ptr<Integrator> (*make)(MechanicalSystem&, const IntegratorOptions&);

  std::unique_ptr<Integrator> with_step(MechanicalSystem& system, double step,
                                        double newton_tolerance = 1e-13) const {
    return make(system,
                {.relative_tolerance = newton_tolerance, .fixed_step = step, .table = table.name});
  }
  std::unique_ptr<Integrator> with_tolerance(MechanicalSystem& system, double rtol) const {
    return make(system, {.relative_tolerance = rtol, .table = table.name});
  }
};

std::ostream& operator<<(std::ostream& out, const ImplicitMethod& method) {
  return out << method.name;
}

std::vector<ImplicitMethod> all_methods() {
  std::vector<ImplicitMethod> methods;
  for (const CoefficientTable& table : dirk_tables()) {
    methods.push_back({"dirk_" + table.name, table, make_arkode_dirk});
  }
  return methods;
}

class ImplicitOrder : public testing::TestWithParam<ImplicitMethod> {
 protected:
  void expect_order(KnownSystem& system, double end, double place) {
    const double order = GetParam().table.order;
    expect_finest_order(order - 0.4, order + 0.4, {9, 1e-4, 2e-11, 8},
                        [&](int n) { return error_in_steps(GetParam(), system, end, n, place); });
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, ImplicitOrder, testing::ValuesIn(all_methods()),
                         NamedAsPrinted{});

TEST_P(ImplicitOrder, OnACurvedMotionWithCoupledMassIsTheTables) {
  CurvedSystem system;
  expect_order(system, 4.0, 1.0);
}

TEST_P(ImplicitOrder, InsideStepsIsTheTables) {
  CurvedSystem system;
  expect_order(system, 4.0, 0.37);
}

// |R(i omega h)| after one step of an oscillator.
double amplification(const std::string& table, double angle) {
  Oscillators one(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1));
  const auto integrator =
      make_arkode_dirk(one, {.relative_tolerance = 1e-13, .fixed_step = angle, .table = table});
  integrator->restart(0.0, one.initial());
  integrator->step();
  return one.amplitude(integrator->state(), 0);
}

TEST(DirkDamping, IsThatOfTheTablesStabilityFunction) {
  struct Known {
    const char* table;
    double at_1, band_1, at_10, band_10;
  };
  for (const Known& known :
       {Known{"ark324", 0.982, 5e-4, 0.28, 5e-3}, Known{"esdirk436", 0.9999, 1e-4, 0.75, 5e-3},
        Known{"esdirk437", 1.0, 5e-5, 0.86, 5e-3}}) {
    EXPECT_NEAR(amplification(known.table, 1.0), known.at_1, known.band_1) << known.table;
    EXPECT_NEAR(amplification(known.table, 10.0), known.at_10, known.band_10) << known.table;
  }
}

TEST(DirkDamping, NoTableLetsAnOscillationGrow) {
  for (const CoefficientTable& table : dirk_tables()) {
    for (double angle = 0.1; angle < 1e3; angle *= 1.3) {
      EXPECT_LT(amplification(table.name, angle), 1.0 + 1e-9) << table.name << ", " << angle;
    }
  }
}

const ImplicitMethod dirk{"dirk", dirk_tables().front(), make_arkode_dirk};

TEST(Dirk, ErrorFallsWithTheTolerance) {
  CurvedSystem system;
  OrderTable table(dirk.name + ": error over 1/rtol");
  for (double rtol = 1e-3; rtol > 5e-10; rtol *= 0.1) {
    const auto integrator = dirk.with_tolerance(system, rtol);
    integrator->restart(0.0, system.initial());
    double largest = 0.0;
    while (integrator->time() < 10.0) {
      integrator->step();
      largest = std::max(largest, system.error(integrator->time(), integrator->state()));
    }
    table.add(1.0 / rtol, largest);
  }
  table.print();
  table.expect_overall_order_within(0.6, 1.3);
}

// The pattern is analysed once for the steps and once for the partial steps, whatever happens.
TEST(Dirk, PatternIsAnalysedOnce) {
  ElasticBar bar(8);
  const auto integrator = dirk.with_tolerance(bar, 1e-6);
  State y = bar.initial(), inside;
  double t = 0.0;
  for (int restarts = 0; restarts < 5; ++restarts) {
    integrator->restart(t, y);
    for (int i = 0; i < 5; ++i) {
      integrator->step();
      integrator->state_at(0.5 * (integrator->start_time() + integrator->time()), inside);
    }
    t = integrator->time();
    y = integrator->state();
  }
  const WorkCounts work = integrator->work();
  EXPECT_EQ(work.pattern_analyses, 2);
  EXPECT_GE(work.factorisations, 50);
  EXPECT_GE(work.jacobians, 30);
  EXPECT_EQ(work.steps, 25);
  EXPECT_EQ(work.partial_steps, 25);
  EXPECT_GT(work.mass_solves, 0);
  EXPECT_GT(work.nonlinear_iterations, 0);
}

TEST(Dirk, AFailedStepIsRetakenWithTheMatrixOfItsNewLength) {
  long rejected = 0;
  for (double rtol = 1e-3; rtol > 5e-10; rtol *= 0.1) {
    CurvedSystem system;
    const auto integrator = dirk.with_tolerance(system, rtol);
    integrator->restart(0.0, system.initial());
    while (integrator->time() < 10.0) integrator->step();
    const WorkCounts work = integrator->work();
    EXPECT_GE(work.factorisations, work.steps + work.rejected_steps) << rtol;
    rejected += work.rejected_steps;
  }
  EXPECT_GT(rejected, 0);
}

TEST(Dirk, RestartKeepsTheStepSize) { EXPECT_GT(step_after_restart(dirk, 30), 0.4); }

TEST(Dirk, WhatForceOrStiffnessThrowsComesOutWhole) {
  expect_mishap(dirk, ThrowingBar::In::force, 7);
  expect_mishap(dirk, ThrowingBar::In::stiffness, 7);
}

TEST(Dirk, AnUnknownTableIsRefused) {
  CurvedSystem system;
  EXPECT_THROW(dirk.make(system, {.table = "dop853"}), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
