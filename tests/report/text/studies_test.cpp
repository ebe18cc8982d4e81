#include <fmt/format.h>

#include "print.h"
#include "subimpact/io/read_results.h"
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

TEST(AWorkPrecisionChart, HasAPanelAStudyAndNamesMethodsAxesAndFailures) {
  const TemporaryDirectory directory;
  draw_work_precision(directory.path, studies());
  const std::string svg = directory.read("work_precision.svg");
  expect_in(svg, "elastic section", "erk:dop853", "nystrom", "wall time (ms)",
            "largest error of an event time (µs)", "failed", "lost or invented");
  EXPECT_GT(directory.read("work_precision.png").size(), 10000u);
  EXPECT_GT(directory.read("work_precision_evaluations.svg").size(), 1000u);
}

TEST(AWorkPrecisionTable, SaysWhatEachPointCostsAndWhyItIsWrong) {
  const std::string text = work_precision_table(studies().front());
  expect_in(text, "this beside that", "erk:dop853", "rtol 1e-06", "wrong count",
            "nystrom at rtol 1e-02: at 3 us it grows, without bound", "50 ms");
  const std::string recommendations =
      recommendation_text(recommendations_from(studies().front().points));
  expect_in(recommendations, "0.01 us   nystrom at rtol 1e-04: 10 ms");
}

TEST(StabilityFigures, NameMethodsAndAxesOfTheirTables) {
  const TemporaryDirectory directory;
  std::vector<CriticalStep> steps;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const char* method : {"central-difference", "erk:dop853"}) {
      steps.push_back({method, theory, 101, 1e7, 2.0, 2e-7, 2.01e-7});
      steps.push_back({method, theory, 201, 2e7, 2.0, 1e-7, 1.01e-7});
    }
  }
  write(directory.path, part_of(steps));
  expect_in(directory.read("critical_steps.svg"), "central-difference", "erk:dop853",
            "Euler-Bernoulli", "largest stable step");
  const std::vector<StiffContact> contact = {{1e7, 3e-7, 2e-7, 2e-7}, {1e8, 3e-7, 1e-7, 1e-7}};
  write(directory.path, part_of(contact));
  expect_in(directory.read("stiff_contact.svg"), "beam alone", "measured");
  write(directory.path, part_of({{"dirk:esdirk547", 1.0, 0.9, 0.9}, {"dirk:trbdf2", 2.0, 0.8, 0.8}},
                                {{1, 0.1, 0.99}, {1, 1.0, 0.7}, {5, 0.1, 1.0}, {5, 1.0, 1.1}}));
  expect_in(directory.read("damping.svg"), ">esdirk547<", ">trbdf2<", "order 5");
  const std::vector<MissedPairs> pairs = {{1e-6, 21, 21, 20, 2e-6}, {1e-5, 21, 21, 3, 2e-6}};
  write(directory.path, part_of(pairs));
  expect_in(directory.read("missed_pairs.svg"), "strikes (of 21) wholly found", "ends of steps");
  LayerStudy layers;
  layers.points = {{10, {}}, {20, {}}};
  for (LayerPoint& p : layers.points) p.errors.maximum = p.errors.median = 1e-6 / p.layers;
  write(directory.path, part_of(layers));
  expect_in(directory.read("layers.svg"), "layers − exact (µs)", "lost or invented");
}

TEST(TheFigureOfCriticalSteps, ShowsWhateverNumbersOfCellsThereAre) {
  for (const int segments : {9, 1601}) {
    const TemporaryDirectory directory;
    std::vector<CriticalStep> steps;
    for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
      for (const int n : {segments, segments, 2 * segments - 1}) {  // as coarse meshes have them
        steps.push_back({"central-difference", theory, n, 1e7, 2.0, 2e-5 / n, 2e-5 / n});
      }
    }
    write(directory.path, part_of(steps));
    expect_in(directory.read("critical_steps.svg"), fmt::format(">{}<", segments),
              fmt::format(">{}<", 2 * segments - 1));
  }
}

TEST(AMapOfOutcomes, HasARowPerMethodAndAColumnPerSetting) {
  const TemporaryDirectory directory;
  OutcomeMap map;
  const auto add = [&](const char* group, const char* row, double x, Verdict verdict) {
    OutcomePoint& point = map.points.emplace_back();
    point.group = group;
    point.row = row;
    point.x = x;
    point.verdict = verdict;
  };
  add("fixed step", "central-difference, forced", 0.5, Verdict::right);
  add("fixed step", "central-difference, forced", 64.0, Verdict::unstable);
  add("tolerance", "bdf, order up to 2", 1e-8, Verdict::wrong_count);
  write(directory.path, part_of(map));
  expect_in(directory.read("outcomes.svg"), "central-difference, forced", "bdf, order up to 2",
            ">64<", "1e-08", "wrong count");
}

}  // namespace
}  // namespace subimpact
