// The implicit and multistep methods on the paper's example, and what they refuse.

#include "paper_case.h"
#include "settings.h"

namespace subimpact {
namespace {

struct Setting {
  const char* name;
  Method method;
  std::optional<std::string> table;
  std::optional<int> max_order;
  double rtol;
  double bound_us;  // on starts and ends of the first four sub-impacts

  Case on(SectionKind section, double end_time) const {
    Case input = paper_case(section, end_time, 501, method);
    input.solver.table = table;
    input.solver.max_order = max_order;
    input.solver.rtol = rtol;
    return input;
  }
};

std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

class AMethod : public testing::TestWithParam<Setting> {};

const Setting settings[] = {{"dirk", Method::dirk, {}, {}, 1e-6, 2e-3},
                            {"dirk_esdirk437", Method::dirk, "esdirk437", {}, 1e-6, 2e-2},
                            {"adams", Method::adams, {}, {}, 1e-8, 5e-4},
                            {"bdf", Method::bdf, {}, {}, 1e-8, 5e-4},
                            {"bdf2", Method::bdf, {}, 2, 1e-6, 0.2}};
INSTANTIATE_TEST_SUITE_P(, AMethod, testing::ValuesIn(settings), NamedAsPrinted{});

void expect_first_four(const Result& result, double bound_us) {
  ASSERT_EQ(result.sub_impacts.size(), 4u);
  EXPECT_LT(std::ranges::max(errors_us(result, reference_table("seed_elastic"), 4)), bound_us);
}

TEST_P(AMethod, FindsTheFirstFourSubImpacts) {
  const Setting& setting = GetParam();
  const Result result = completed(setting.on(SectionKind::elastic, 0.35e-3));
  expect_first_four(result, setting.bound_us);
  // Work of the kind the method does.
  const bool newton = setting.method != Method::adams;
  EXPECT_EQ(result.work.jacobians > 0, newton);
  EXPECT_EQ(result.work.factorisations > 10, newton);
  EXPECT_GT(result.work.nonlinear_iterations, result.work.steps);
  EXPECT_GE(result.work.right_hand_sides, result.work.nonlinear_iterations);
}

TEST_P(AMethod, FindsThemByItsOwnRootFinding) {
  const Setting& setting = GetParam();
  Case input = setting.on(SectionKind::elastic, 0.35e-3);
  input.solver.events = EventHandling::library;
  expect_first_four(completed(input), setting.bound_us);
}

TEST_P(AMethod, GoesThroughAYieldingBeam) {
  const Setting& setting = GetParam();
  const Result result = completed(setting.on(SectionKind::exact, 0.3e-3));
  ASSERT_EQ(result.sub_impacts.size(), 3u);
  EXPECT_NEAR(end_us(result.sub_impacts[0]), reference_table("seed_exact")[0].end_us,
              20.0 * setting.bound_us);
  EXPECT_EQ(result.used.reversals, setting.method == Method::dirk ? ReversalHandling::located
                                                                  : ReversalHandling::step_end);
}

TEST(ImplicitMethods, TakeAFixedStepAboveTheCriticalOne) {
  Case input = Setting{"", Method::dirk, {}, {}, 1e-6, 0.0}.on(SectionKind::elastic, 0.3e-3);
  input.solver.step = 4e-7;
  const Result result = completed(input);
  EXPECT_GT(*result.used.step, 1.4 * result.used.critical_step);
  EXPECT_NEAR(end_us(result.sub_impacts.at(0)), reference_table("seed_elastic")[0].end_us, 0.05);
}

// Fixed steps of multistep methods, root-finding of methods that are not of SUNDIALS, orders and
// tables of other methods.
TEST(Methods, RefuseByItsKeyWhatTheyDoNotHave) {
  const std::string library = "allowed: \"located\"|erk, dirk, adams, bdf";
  const std::tuple<Method, const char*, KeyValue, std::string> refused[] = {
      {Method::adams, "solver.step", 1e-7, "max_step"},
      {Method::bdf, "solver.step", 1e-7, "max_step"},
      {Method::nystrom, "solver.events", "library", library},
      {Method::exponential, "solver.events", "library", library},
      {Method::central_difference, "solver.events", "library", library},
      {Method::bdf, "solver.max_order", 6, ""},
      {Method::dirk, "solver.max_order", 3, ""},
      {Method::dirk, "solver.table", "dop853", ""},
      {Method::bdf, "solver.table", "esdirk547", ""}};
  for (const auto& [method, key, value, words] : refused) {
    SCOPED_TRACE(to_string(method));
    const Case input = paper_case(SectionKind::elastic, 1e-3, 501, method);
    const Refusal refusal = refusal_of(changed(input, {{key, value}}));
    EXPECT_EQ(refusal.key, key);
    expect_all_in(refusal.message, words);
  }
}

}  // namespace
}  // namespace subimpact
