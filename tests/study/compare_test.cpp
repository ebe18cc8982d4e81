#include "subimpact/study/compare.h"

#include "elastic_case.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(ComparedMethods, AllFindTheSameSubImpactsOfAnElasticBeam) {
  const Comparison comparison =
      compare(elastic_case(0.6e-3),
              {"central-difference", "erk", "erk:dormand-prince", "erk:dormand-prince+library",
               "erk+library", "nystrom", "exponential", "adams", "bdf", "bdf+library"});
  ASSERT_EQ(comparison.runs.size(), 10u);
  EXPECT_EQ(comparison.reference.sub_impacts.size(), 8u);
  for (const ComparedRun& run : comparison.runs) {
    EXPECT_EQ(run.errors.n_corresponding, 8u) << run.setting.method << ": " << run.message;
    EXPECT_EQ(run.message, "every sub-impact corresponds");
    const bool accurate = run.setting.method.rfind("erk", 0) == 0 ||
                          run.setting.method == "nystrom" || run.setting.method == "exponential";
    EXPECT_LT(1e6 * run.errors.ends, accurate ? 1e-3 : 0.5) << run.setting.method;
    EXPECT_GT(run.result.work.steps, 0) << run.setting.method;
  }
}

TEST(AMethodThatMissesASubImpact, IsToldFromWhereOn) {
  Case input = elastic_case(8e-3);
  const Comparison comparison = compare(input, {"central-difference"});
  const ComparedRun& run = comparison.runs.front();
  EXPECT_EQ(comparison.reference.sub_impacts.size(), 26u);
  EXPECT_NE(run.result.sub_impacts.size(), 26u);
  EXPECT_LT(run.errors.n_corresponding, 26u);
  expect_in(run.message, "instead of 26", " us");
}

TEST(ATreatmentOfEvents, IsNamedAfterAPlusSign) {
  Case input = elastic_case(1e-5);
  input.solver.events = EventHandling::library;
  const Comparison comparison = compare(input, {"erk", "erk:verner+interpolated", "adams+located",
                                                "nystrom", "nystrom+interpolated"});
  const auto used = [&](std::size_t i) { return comparison.runs[i].result.used.events; };
  EXPECT_EQ(used(0), EventHandling::library);
  EXPECT_EQ(used(1), EventHandling::interpolated);
  EXPECT_EQ(comparison.runs[1].result.used.table, "verner");
  EXPECT_EQ(used(2), EventHandling::located);
  EXPECT_EQ(used(3), EventHandling::located);  // it has no root-finding
  EXPECT_EQ(used(4), EventHandling::interpolated);
  EXPECT_EQ(comparison.reference.result.used.events, EventHandling::located);
  EXPECT_THROW(compare(input, {"nystrom+library"}), InvalidCase);
  EXPECT_THROW(compare(input, {"erk+librari"}), InvalidCase);
}

TEST(AnInterruptedComparison, HasTheMethodsThatHadEnded) {
  std::string running;
  const auto note = [&](const std::string& name) { running = name; };
  const Case input = elastic_case(1e-4);
  const Comparison cut_short = compare(input, {"erk", "nystrom", "exponential"}, note,
                                       [&](double) { return running != "nystrom"; });
  EXPECT_TRUE(cut_short.interrupted);
  ASSERT_EQ(cut_short.runs.size(), 1u);
  EXPECT_EQ(cut_short.runs.front().setting.method, "erk");
  const Comparison whole = compare(input, {"erk"}, note, [](double) { return true; });
  EXPECT_FALSE(whole.interrupted);
  EXPECT_EQ(cut_short.runs.front().errors.ends, whole.runs.front().errors.ends);
  const Comparison none = compare(input, {"erk"}, note, [](double) { return false; });
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(none.runs.empty());
}

TEST(AComparison, WithAReferenceThatFailedIsNotMade) {
  Case input = elastic_case(0.1e-3);
  input.scene.beam.yield_stress = 150.0;  // MPa were meant
  input.model.section = SectionKind::exact;
  input.model.segments = 21;
  try {
    compare(input, {"erk"});
    ADD_FAILURE() << "was made";
  } catch (const std::runtime_error& error) {
    expect_in(std::string(error.what()), "the reference of the comparison");
  }
}

TEST(AnUnknownMethodOrTable, IsRefusedBeforeAnythingRuns) {
  EXPECT_THROW(compare(elastic_case(1e-5), {"erk", "leapfrog"}), InvalidCase);
  EXPECT_THROW(compare(elastic_case(1e-5), {"erk:dprkn8"}), InvalidCase);
}

}  // namespace
}  // namespace subimpact
