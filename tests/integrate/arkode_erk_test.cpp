// What is particular to the methods of SUNDIALS: vector operations, tables, failures by name.

#include "integrate/sundials.h"
#include "test_systems.h"

namespace subimpact {
namespace {

State run(SpringChain& chain, const std::string& table, VectorOperations operations,
          std::optional<double> fixed_step, long* steps = nullptr) {
  const auto integrator = make_arkode_erk(chain, {.relative_tolerance = 1e-7,
                                                  .fixed_step = fixed_step,
                                                  .table = table,
                                                  .vector_operations = operations});
  integrator->restart(0.0, chain.initial());
  while (integrator->time() < 20.0) integrator->step();
  State end;
  integrator->state_at(20.0, end);
  if (steps) *steps = integrator->work().steps;
  return end;
}

TEST(VectorOperations, OfTheProjectGiveTheNumbersOfTheLibrary) {
  for (const CoefficientTable& table : explicit_tables()) {
    for (const std::size_t n : {1u, 2u, 3u, 4u, 7u, 8u, 17u, 60u}) {
      SpringChain chain(n);
      const State project = run(chain, table.name, VectorOperations::project, 0.05);
      const State library = run(chain, table.name, VectorOperations::library, 0.05);
      EXPECT_LE(largest_difference(project, library), 1e-13) << table.name << ", " << n;
    }
  }
}

TEST(VectorOperations, OfTheProjectChooseTheStepsOfTheLibrary) {
  for (const CoefficientTable& table : explicit_tables()) {
    SpringChain chain(13);
    long project_steps = 0, library_steps = 0;
    const State project = run(chain, table.name, VectorOperations::project, {}, &project_steps);
    const State library = run(chain, table.name, VectorOperations::library, {}, &library_steps);
    EXPECT_EQ(project_steps, library_steps) << table.name;
    EXPECT_LE(largest_difference(project, library), 1e-9) << table.name;
  }
}

// How the method of a table fails on a motion that begins at 1 with the rate 2.
IntegrationFailure failure_of(SecondOrderOde& motion, const std::string& table) {
  const auto integrator = make_arkode_erk(motion, {.table = table});
  integrator->restart(0.0, {1.0, 2.0});
  try {
    for (int i = 0; i < 200000; ++i) integrator->step();
  } catch (const IntegrationFailure& failure) {
    EXPECT_TRUE(std::string(failure.what()).starts_with(failure.function + " failed with "));
    return failure;
  }
  throw std::logic_error("went on to t = " + std::to_string(integrator->time()));
}

TEST(ArkodeErk, FailsByTheNamesOfTheLibrarysFunctionAndFlag) {
  AnyMotion motion(1, [](std::span<const double>, std::span<double> a) { a[0] = std::nan(""); });
  for (const CoefficientTable& table : explicit_tables()) {
    const IntegrationFailure failure = failure_of(motion, table.name);
    EXPECT_EQ(failure.function, "ERKStepEvolve");
    EXPECT_TRUE(failure.flag.starts_with("ARK_")) << failure.flag;
    EXPECT_EQ(failure.time, 0.0);
  }
}

TEST(ArkodeErk, FailsByNameWhereTheMotionBecomesNoNumber) {
  // s'' = 6 s^2 with s = 1/(1 - t)^2, which is at 1e4 at t = 0.99 and no number from there on.
  AnyMotion motion(1, [](std::span<const double> q, std::span<double> a) {
    a[0] = q[0] < 1e4 ? 6.0 * q[0] * q[0] : std::nan("");
  });
  for (const CoefficientTable& table : explicit_tables()) {
    const IntegrationFailure failure = failure_of(motion, table.name);
    const bool by_library = failure.function == "ERKStepEvolve" && failure.flag.starts_with("ARK_");
    const bool by_us = failure.function == "ARKODE" && failure.flag == "step size too small";
    EXPECT_TRUE(by_library || by_us) << failure.what();
    EXPECT_NEAR(failure.time, 0.99, 1e-6);
  }
}

TEST(ArkodeErk, GoesOnFarFromZeroWhereRoundingIsAboveTheTolerance) {
  AnyMotion motion(1, [](std::span<const double>, std::span<double> a) { a[0] = 0.5; });
  for (const CoefficientTable& table : explicit_tables()) {
    const auto integrator = make_arkode_erk(motion, {.table = table.name});
    integrator->restart(0.0, {1e12, 3.0});
    while (integrator->time() < 2.0) ASSERT_NO_THROW(integrator->step()) << table.name;
    State end;
    integrator->state_at(2.0, end);
    EXPECT_NEAR(end[0], 1e12 + 7.0, 1e-2) << table.name;
    EXPECT_NEAR(end[1], 4.0, 1e-12) << table.name;
  }
}

// An earlier integrator of the same tolerance leaves its weights in memory that is given out again,
// partly overwritten.
TEST(ArkodeErk, TakesTheSameStepsWhateverMemoryHeldBefore) {
  constexpr std::size_t n = 17;
  SpringChain chain(n);
  const std::string table = explicit_tables().front().name;
  const State clean = run(chain, table, VectorOperations::project, {});
  const auto scales = chain.scales();
  std::vector<double> left(2 * n, 0.0);
  left[0] = 1.0 / (1e-7 * scales.position);
  left[n] = 1.0 / (1e-7 * scales.velocity);
  std::vector<std::vector<double>>(100, left).clear();
  EXPECT_EQ(run(chain, table, VectorOperations::project, {}), clean);
}

TEST(ExplicitTables, AreFoundByNameAndNoOtherNameIs) {
  SpringChain chain(2);
  for (const CoefficientTable& table : explicit_tables()) {
    EXPECT_GT(table.order, table.embedded_order) << table.name;
    EXPECT_NO_THROW(make_arkode_erk(chain, {.table = table.name}));
  }
  EXPECT_THROW(make_arkode_erk(chain, {.table = "no-such-table"}), std::invalid_argument);
}

TEST(ExplicitTables, TheFirstIsTakenWhereNoneIsNamed) {
  SpringChain chain(3);
  const auto by_name = run(chain, explicit_tables().front().name, VectorOperations::project, 0.1);
  EXPECT_EQ(run(chain, "", VectorOperations::project, 0.1), by_name);
}

}  // namespace
}  // namespace subimpact
