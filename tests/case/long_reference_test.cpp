// The whole strike, every event against the error the reference tables state for it.

#include "paper_case.h"

namespace subimpact {
namespace {

struct Bound {
  const char* table;
  SectionKind section;
  Method method;
  double rtol;
  double allowance_us;   // beside three times the table's own error
  double before_2ms_us;  // absolute, before 2 ms
};

void PrintTo(const Bound& bound, std::ostream* out) { *out << bound.table; }

class TheWholeStrike : public testing::TestWithParam<Bound> {};

TEST_P(TheWholeStrike, AgreesWithTheTableWithinItsErrors) {
  const Bound& bound = GetParam();
  Case input = paper_case(bound.section, 8e-3);
  input.solver.method = bound.method;
  input.solver.rtol = bound.rtol;
  const Result result = simulate(input);
  const auto reference = reference_table(bound.table);
  ASSERT_EQ(result.sub_impacts.size(), reference.size());
  double worst_early = 0.0;
  double worst_share = 0.0;  // of what is allowed
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const ReferenceEvent& row = reference[i];
    const SubImpact& here = result.sub_impacts[i];
    const double difference =
        std::max(std::abs(start_us(here) - row.start_us), std::abs(end_us(here) - row.end_us));
    worst_share = std::max(worst_share, difference / (3.0 * row.error_us + bound.allowance_us));
    if (row.end_us < 2000.0) worst_early = std::max(worst_early, difference);
  }
  printf(
      "%s: before 2 ms to %.2e us (bound %.0e); over 8 ms at most %.2f of the allowed difference\n",
      bound.table, worst_early, bound.before_2ms_us, worst_share);
  EXPECT_LT(worst_early, bound.before_2ms_us);
  EXPECT_LT(worst_share, 1.0);
}

INSTANTIATE_TEST_SUITE_P(
    , TheWholeStrike,
    testing::Values(
        Bound{"seed_elastic", SectionKind::elastic, Method::nystrom, 1e-10, 1e-4, 1e-4},
        Bound{"seed_exact", SectionKind::exact, Method::nystrom, 1e-11, 1e-4, 2e-4},
        Bound{"seed_layers40", SectionKind::layers, Method::nystrom, 1e-11, 1e-3, 1e-3},
        Bound{"seed_exact", SectionKind::exact, Method::erk, 1e-11, 1e-4, 2e-4},
        Bound{"seed_elastic", SectionKind::elastic, Method::exponential, 1e-8, 1e-4, 1e-4},
        Bound{"seed_exact", SectionKind::exact, Method::exponential, 1e-11, 1e-4, 2e-4},
        Bound{"seed_layers40", SectionKind::layers, Method::exponential, 1e-11, 1e-3, 1e-3}),
    [](const auto& info) {
      return std::string(info.param.table) + (info.param.method == Method::erk ? "_erk"
                                              : info.param.method == Method::nystrom
                                                  ? "_nystrom"
                                                  : "_exponential");
    });

}  // namespace
}  // namespace subimpact
