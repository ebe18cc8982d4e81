// Events found by the library's own root-finding: their times, and the traps of such root-finding.

#include "integrate/sundials.h"
#include "mechanical_systems.h"
#include "print.h"

namespace subimpact {
namespace {

struct Finder {
  std::string name;
  std::string table;
  int max_order;
  std::function<std::unique_ptr<Integrator>(MechanicalSystem&, const IntegratorOptions&)> make;

  bool has_fixed_steps() const { return max_order == 0; }
  std::unique_ptr<Integrator> with(MechanicalSystem& system, IntegratorOptions options) const {
    options.table = table;
    options.max_order = max_order;
    return make(system, options);
  }
};

std::ostream& operator<<(std::ostream& out, const Finder& finder) { return out << finder.name; }

const Finder one_step_methods[] = {{"dop853", "dop853", 0, make_arkode_erk},
                                   {"dormand_prince", "dormand-prince", 0, make_arkode_erk},
                                   {"dirk", "", 0, make_arkode_dirk}};
const Finder multistep_methods[] = {{"adams", "", adams_order_limit, make_cvode_adams},
                                    {"bdf", "", bdf_order_limit, make_cvode_bdf}};

class RootFinding : public testing::TestWithParam<Finder> {};
INSTANTIATE_TEST_SUITE_P(OneStep, RootFinding, testing::ValuesIn(one_step_methods),
                         NamedAsPrinted{});
INSTANTIATE_TEST_SUITE_P(Multistep, RootFinding, testing::ValuesIn(multistep_methods),
                         NamedAsPrinted{});

using Evaluate = std::function<std::vector<EventValue>(std::span<const double>)>;

// Event functions of a test, which may exchange them before a restart.
struct Functions final : EventFunctions {
  std::size_t n;
  Evaluate values;
  Functions(std::size_t n, Evaluate values) : n(n), values(std::move(values)) {}
  std::size_t size() const override { return n; }
  void evaluate(std::span<const double> y, std::span<EventValue> result) const override {
    const std::vector<EventValue> all = values(y);
    ASSERT_EQ(all.size(), result.size());
    std::copy(all.begin(), all.end(), result.begin());
  }
};

// The first position against a level, and back.
Evaluate above(double level) {
  return [level](std::span<const double> y) {
    return std::vector<EventValue>{{y[0] - level, y[y.size() / 2]}};
  };
}
Evaluate below(double level) {
  return [level](std::span<const double> y) {
    return std::vector<EventValue>{{level - y[0], -y[y.size() / 2]}};
  };
}

// One unit mass on a unit spring: q = cos t.
Oscillators oscillator() { return {Eigen::VectorXd::Ones(1), Eigen::VectorXd::Ones(1)}; }

IntegratorOptions options_with(std::shared_ptr<const EventFunctions> functions) {
  IntegratorOptions options;
  options.relative_tolerance = 1e-10;
  options.max_step = 0.03;
  options.event_functions = std::move(functions);
  return options;
}

// Steps to the next root or to the end.
bool next_root(Integrator& integrator, double end) {
  while (integrator.time() < end) {
    integrator.step();
    if (integrator.root()) return true;
  }
  return false;
}

TEST_P(RootFinding, FindsEveryCrossingOnceAtItsTime) {
  const double level = 0.3;
  // A restart on either side of the root, within rounding, as corrections of sections leave it.
  for (const double off : {-1e-15, 0.0, 1e-15}) {
    Oscillators system = oscillator();
    const auto functions = std::make_shared<Functions>(1, below(level));
    const auto integrator = GetParam().with(system, options_with(functions));
    integrator->restart(0.0, system.initial());
    int n_found = 0;
    while (next_root(*integrator, 30.0)) {
      const bool falls = n_found % 2 == 0;
      const double exact =
          (falls ? 1.0 : -1.0) * std::acos(level) + 2.0 * M_PI * (n_found / 2 + (falls ? 0 : 1));
      ASSERT_NEAR(integrator->time(), exact, 1e-6) << "root " << n_found;
      EXPECT_EQ(integrator->root()->function, 0u);
      EXPECT_LE(std::abs(integrator->state()[0] - level), 2.0 * integrator->root()->tolerance);
      ++n_found;
      // The function that now applies, sometimes beside another one.
      functions->n = falls ? 2 : 1;
      functions->values = falls ? Evaluate([level](std::span<const double> y) {
        return std::vector<EventValue>{{y[0] - level, y[1]}, {y[0] - 2.0, y[1]}};
      })
                                : below(level);
      State y = integrator->state();
      y[0] += off;
      integrator->restart(integrator->time(), y);
    }
    EXPECT_EQ(n_found, 9);
  }
}

TEST_P(RootFinding, FindsTwoRootsWithinOneStepWhereTheRateIsKnown) {
  const double level = 1.0 - 1e-5;  // exceeded for 9e-3 around 2 pi
  for (const bool with_rate : {true, false}) {
    Oscillators system = oscillator();
    const auto functions = std::make_shared<Functions>(1, [&](std::span<const double> y) {
      const double unknown = std::numeric_limits<double>::quiet_NaN();
      return std::vector<EventValue>{{y[0] - level, with_rate ? y[1] : unknown}};
    });
    IntegratorOptions options = options_with(functions);
    options.relative_tolerance = 1e-9;
    options.max_step = 0.04;
    if (GetParam().has_fixed_steps()) options.fixed_step = 0.04;
    const auto integrator = GetParam().with(system, options);
    integrator->restart(1.02, system.exact(1.02));  // no step of 0.04 ends near 2 pi
    const bool found = next_root(*integrator, 7.0);
    EXPECT_EQ(found, with_rate);
    if (found) {
      EXPECT_NEAR(integrator->time(), 2.0 * M_PI - std::acos(level), 1e-4);
    }
  }
}

TEST_P(RootFinding, MaximaThatStayBelowAreNoEvents) {
  Oscillators system = oscillator();
  const auto functions = std::make_shared<Functions>(1, above(1.0 + 1e-6));
  const auto integrator = GetParam().with(system, options_with(functions));
  const auto plain = GetParam().with(system, options_with(nullptr));
  integrator->restart(0.0, system.initial());
  plain->restart(0.0, system.initial());
  EXPECT_FALSE(next_root(*integrator, 20.0));
  EXPECT_FALSE(next_root(*plain, 20.0));
  EXPECT_EQ(integrator->work().steps, plain->work().steps);
  EXPECT_EQ(integrator->state(), plain->state());
}

// The library would search for ever.
TEST_P(RootFinding, EndsWhereValuesBlewUp) {
  for (const double beyond :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    Oscillators system = oscillator();
    const auto functions = std::make_shared<Functions>(1, [beyond](std::span<const double> y) {
      return std::vector<EventValue>{{y[0] < 0.0 ? beyond : -beyond, -beyond}};
    });
    const auto integrator = GetParam().with(system, options_with(functions));
    integrator->restart(0.0, system.initial());
    const bool found = next_root(*integrator, 3.0);
    EXPECT_EQ(found, !std::isnan(beyond));
  }
}

TEST_P(RootFinding, TakesFunctionsThatStayAtZero) {
  Oscillators system = oscillator();
  const auto functions = std::make_shared<Functions>(1, [](std::span<const double> y) {
    return std::vector<EventValue>{{std::max(0.0, -y[0]), -y[1]}};
  });
  const auto integrator = GetParam().with(system, options_with(functions));
  integrator->restart(0.0, system.initial());
  ASSERT_TRUE(next_root(*integrator, 3.0));
  EXPECT_NEAR(integrator->time(), 0.5 * M_PI, 1e-6);
  functions->values = [](std::span<const double> y) {
    return std::vector<EventValue>{{std::min(0.0, y[0]), 0.0}};
  };
  State y = integrator->state();
  y[0] = 0.0;
  integrator->restart(integrator->time(), y);
  EXPECT_FALSE(next_root(*integrator, 20.0));
}

TEST_P(RootFinding, FindsAtTheRestartWhatHasRisenThere) {
  Oscillators system = oscillator();
  const auto functions = std::make_shared<Functions>(1, below(0.5));
  const auto integrator = GetParam().with(system, options_with(functions));
  integrator->restart(1.2, system.exact(1.2));  // below already, and falling
  integrator->step();
  ASSERT_TRUE(integrator->root().has_value());
  EXPECT_EQ(integrator->time(), 1.2);
  EXPECT_EQ(integrator->state(), system.exact(1.2));
  integrator->restart(4.0, system.exact(4.0));  // below, but rising: its event is long past
  integrator->step();
  EXPECT_FALSE(integrator->root().has_value());
  EXPECT_GT(integrator->time(), 4.0);
}

struct Mishap {};
TEST_P(RootFinding, WhatAnEventFunctionThrowsComesOutWhole) {
  Oscillators system = oscillator();
  int calls = 0;
  const auto functions = std::make_shared<Functions>(1, [&](std::span<const double> y) {
    if (++calls == 20) throw Mishap{};
    return above(2.0)(y);
  });
  const auto integrator = GetParam().with(system, options_with(functions));
  integrator->restart(0.0, system.initial());
  EXPECT_THROW(next_root(*integrator, 3.0), Mishap);
  integrator->restart(0.0, system.initial());
  integrator->step();
  EXPECT_GT(integrator->time(), 0.0);
}

}  // namespace
}  // namespace subimpact
