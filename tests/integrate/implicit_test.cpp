// The implicit and half-implicit Runge-Kutta methods: orders, damping, matrices, failures.

#include "integrate/sundials.h"
#include "mechanical_systems.h"
#include "order_table.h"
#include "print.h"
#include "testing.h"

namespace subimpact {
namespace {

struct ImplicitMethod {
  std::string name;
  CoefficientTable table;
  std::unique_ptr<Integrator> (*make)(MechanicalSystem&, const IntegratorOptions&);

  std::unique_ptr<Integrator> with_step(MechanicalSystem& system, double step,
                                        double newton_tolerance = 1e-13) const {
    IntegratorOptions options;
    options.table = table.name;
    options.fixed_step = step;
    options.relative_tolerance = newton_tolerance;
    return make(system, options);
  }
  std::unique_ptr<Integrator> with_tolerance(MechanicalSystem& system, double rtol) const {
    IntegratorOptions options;
    options.table = table.name;
    options.relative_tolerance = rtol;
    return make(system, options);
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
  for (const CoefficientTable& table : imex_tables()) {
    methods.push_back({"imex_" + table.name, table, make_arkode_imex});
  }
  return methods;
}

std::vector<ImplicitMethod> default_methods() {
  return {{"dirk", dirk_tables().front(), make_arkode_dirk},
          {"imex", imex_tables().front(), make_arkode_imex}};
}

class ImplicitOrder : public testing::TestWithParam<ImplicitMethod> {
 protected:
  // `error_of(n)` with n steps growing by the cube root of 2, while the error is neither coarse nor
  // rounding; the order is taken over the last doubling.
  template <class ErrorOf>
  void expect_order(const std::string& title, ErrorOf error_of) {
    OrderTable table(GetParam().name + ", " + title + ": largest error over steps");
    for (int thirds = 9; thirds < 45 && table.size() < 8; ++thirds) {
      const auto n = static_cast<int>(std::lround(std::pow(2.0, thirds / 3.0)));
      const double error = error_of(n);
      if (!(error < 1e-4)) continue;
      if (error < 2e-11) break;
      table.add(n, error);
    }
    table.print();
    const double order = GetParam().table.order;
    table.expect_finest_order_within(4, order - 0.4, order + 0.4);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, ImplicitOrder, testing::ValuesIn(all_methods()),
                         NamedAsPrinted{});

TEST_P(ImplicitOrder, OnABarWithConsistentMassIsTheTables) {
  ElasticBar bar(5);
  expect_order("elastic bar", [&](int n) { return error_in_steps(GetParam(), bar, 6.0, n, 1.0); });
}

TEST_P(ImplicitOrder, OnACurvedMotionWithCoupledMassIsTheTables) {
  CurvedSystem system;
  expect_order("curved motion",
               [&](int n) { return error_in_steps(GetParam(), system, 4.0, n, 1.0); });
}

TEST_P(ImplicitOrder, InsideStepsIsTheTables) {
  CurvedSystem system;
  expect_order("inside steps",
               [&](int n) { return error_in_steps(GetParam(), system, 4.0, n, 0.37); });
}

// |R(i omega h)| after one step of an oscillator.
double amplification(const std::string& table, double angle) {
  Oscillators one(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1));
  IntegratorOptions options;
  options.table = table;
  options.fixed_step = angle;
  options.relative_tolerance = 1e-13;
  const auto integrator = make_arkode_dirk(one, options);
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
    const double at_1 = amplification(known.table, 1.0);
    const double at_10 = amplification(known.table, 10.0);
    std::printf("%-10s |R(i)| %.6f |R(10i)| %.4f\n", known.table, at_1, at_10);
    EXPECT_NEAR(at_1, known.at_1, known.band_1) << known.table;
    EXPECT_NEAR(at_10, known.at_10, known.band_10) << known.table;
  }
}

TEST(DirkDamping, NoTableLetsAnOscillationGrow) {
  for (const CoefficientTable& table : dirk_tables()) {
    for (double angle = 0.1; angle < 1e3; angle *= 1.3) {
      EXPECT_LT(amplification(table.name, angle), 1.0 + 1e-9) << table.name << ", " << angle;
    }
  }
}

class Implicit : public testing::TestWithParam<ImplicitMethod> {};
INSTANTIATE_TEST_SUITE_P(Methods, Implicit, testing::ValuesIn(default_methods()), NamedAsPrinted{});

TEST_P(Implicit, ErrorFallsWithTheTolerance) {
  CurvedSystem system;
  OrderTable table(GetParam().name + ": error over 1/rtol");
  for (double rtol = 1e-3; rtol > 5e-10; rtol *= 0.1) {
    const auto integrator = GetParam().with_tolerance(system, rtol);
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
TEST_P(Implicit, PatternIsAnalysedOnce) {
  ElasticBar bar(8);
  const auto integrator = GetParam().with_tolerance(bar, 1e-6);
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

TEST_P(Implicit, AFailedStepIsRetakenWithTheMatrixOfItsNewLength) {
  long rejected = 0;
  for (double rtol = 1e-3; rtol > 5e-10; rtol *= 0.1) {
    CurvedSystem system;
    const auto integrator = GetParam().with_tolerance(system, rtol);
    integrator->restart(0.0, system.initial());
    while (integrator->time() < 10.0) integrator->step();
    const WorkCounts work = integrator->work();
    EXPECT_GE(work.factorisations, work.steps + work.rejected_steps) << rtol;
    rejected += work.rejected_steps;
  }
  EXPECT_GT(rejected, 0);
}

TEST_P(Implicit, RestartKeepsTheStepSize) {
  ElasticBar bar(5);
  const auto integrator = GetParam().with_tolerance(bar, 1e-8);
  integrator->restart(0.0, bar.initial());
  for (int i = 0; i < 30; ++i) integrator->step();
  const double before = integrator->time() - integrator->start_time();
  integrator->restart(integrator->time(), State(integrator->state()));
  integrator->step();
  EXPECT_GT(integrator->time() - integrator->start_time(), 0.4 * before);
}

TEST_P(Implicit, WhatForceOrStiffnessThrowsComesOutWhole) {
  expect_mishap(GetParam(), ThrowingBar::In::force, 7);
  expect_mishap(GetParam(), ThrowingBar::In::stiffness, 7);
}

TEST_P(Implicit, AnUnknownTableIsRefused) {
  CurvedSystem system;
  IntegratorOptions options;
  options.table = "dop853";
  EXPECT_THROW(GetParam().make(system, options), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
