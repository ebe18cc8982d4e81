#include <fmt/format.h>

#include "print.h"
#include "subimpact/io/results.h"
#include "subimpact/report/studies.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

using ALogOfPoints = InADirectory;

Trial point(const std::string& method, double rtol, double error, double seconds,
            Verdict verdict = Verdict::right) {
  Trial p;
  p.setting = {method, false, rtol};
  p.verdict = verdict;
  p.errors.maximum = error;
  p.errors.median = 0.5 * error;
  p.errors.n_reference = p.errors.n_found = p.errors.n_corresponding = 7;
  p.seconds = seconds;
  p.repeats = 3;
  p.work.right_hand_sides = 1234;
  if (verdict == Verdict::unstable) p.message = "at 3 us it grows, without bound";
  if (verdict == Verdict::wrong_count) p.errors.unmatched = UnmatchedSubImpact{1e-3, 2e-6, "lost"};
  return p;
}

std::vector<WorkPrecision> studies() {
  WorkPrecision study;
  study.label = "elastic section";
  study.reference.description = "this beside that";
  study.reference.error = 1e-15;
  study.points = {point("erk:dop853", 1e-4, 1e-8, 0.02), point("erk:dop853", 1e-6, 1e-10, 0.05),
                  point("nystrom", 1e-2, 0.0, 0.01, Verdict::unstable),
                  point("nystrom", 1e-3, 1e-7, 0.01, Verdict::wrong_count),
                  point("nystrom", 1e-4, 2e-9, 0.01)};
  return {study, study};
}

TEST_F(ALogOfPoints, GivesBackWhatAnInterruptedStudyLeft) {
  const std::vector<WorkPrecision> all = studies();
  {
    OutputDirectory files(directory.path, "work-precision", "a-b");
    PointLog log(files, {"a", "b"});
    EXPECT_EQ(log.n_known(), 0u);
    for (const Trial& p : all.front().points) log.append("a", "elastic", p);
  }
  OutputDirectory files(directory.path, "work-precision", "a-b");
  const PointLog log(files, {"a", "b"});
  EXPECT_EQ(log.n_known(), 5u);
  const auto unstable = log.known("a", {"nystrom", false, 1e-2});
  ASSERT_TRUE(unstable.has_value());
  EXPECT_EQ(unstable->verdict, Verdict::unstable);
  EXPECT_EQ(unstable->message, "at 3 us it grows; without bound");
  const auto wrong = log.known("a", {"nystrom", false, 1e-3});
  ASSERT_TRUE(wrong && wrong->errors.unmatched);
  EXPECT_EQ(wrong->errors.unmatched->duration, 2e-6);
  EXPECT_EQ(wrong->errors.maximum, 1e-7);
  EXPECT_EQ(wrong->seconds, 0.01);
  EXPECT_EQ(wrong->work.right_hand_sides, 1234);
  EXPECT_FALSE(log.known("b", {"nystrom", false, 1e-3}).has_value());
  EXPECT_FALSE(log.known("a", {"nystrom", true, 1e-3}).has_value());
}

TEST_F(ALogOfPoints, IsNotMixedWithThatOfAnotherCase) {
  OutputDirectory files(directory.path, "work-precision");
  PointLog(files, {"a"}).append("a", "elastic", studies().front().points.front());
  EXPECT_THROW(PointLog(files, {"b"}), OutputError);
  EXPECT_EQ(PointLog(files, {"a"}).n_known(), 1u);
}

TEST_F(ALogOfPoints, ThatWasChangedIsRefused) {
  OutputDirectory files(directory.path, "work-precision");
  PointLog(files, {"a"}).append("a", "elastic", studies().front().points.front());
  std::ofstream(directory.path / "work_precision.csv", std::ios::app) << "a,elastic,erk,rt";
  EXPECT_THROW(PointLog(files, {"a"}), ResultsError);
}

TEST_F(ALogOfPoints, HasSettingsThatWereNotRunTriedAgain) {
  OutputDirectory files(directory.path, "work-precision");
  PointLog(files, {"a"}).append("a", "elastic", point("erk", 1e-9, 0.0, 0.0, Verdict::not_run));
  EXPECT_EQ(PointLog(files, {"a"}).n_known(), 0u);
}

TEST(CasesOfDifferentScenes, HaveDifferentIdsButSettingsDoNotMatter) {
  Case input;
  Case other = input;
  other.solver.rtol = 1e-4;
  other.solver.method = Method::bdf;
  other.title = "another";
  EXPECT_EQ(case_id(input), case_id(other));
  other.scene.striker.mass = 2.0;
  EXPECT_NE(case_id(input), case_id(other));
}

TEST(AWorkPrecisionTable, SaysWhatEachPointCostsAndWhyItIsWrong) {
  const std::string text = work_precision_table(studies().front());
  expect_in(text, "this beside that", "erk:dop853", "rtol 1e-06", "wrong count",
            "nystrom at rtol 1e-02: at 3 us it grows, without bound", "50 ms");
  const std::string recommendations =
      recommendation_text(recommendations_from(studies().front().points));
  expect_in(recommendations, "0.01 us   nystrom at rtol 1e-04: 10 ms");
}

}  // namespace
}  // namespace subimpact
