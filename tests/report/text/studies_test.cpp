#include <fmt/format.h>

#include "print.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

Trial point(const std::string& method, double rtol, double error, double seconds,
            Verdict verdict = Verdict::right) {
  Trial p;
  p.setting = {method, false, rtol};
  p.verdict = verdict;
  p.errors.maximum = error;
  p.errors.median = 0.5 * error;
  p.errors.n_reference = p.errors.n_found = p.errors.n_corresponding = p.errors.n_times = 7;
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

TEST(AWorkPrecisionFile, HasAllPointsWithWhatIsWrongOfThem) {
  const std::string text = work_precision_csv(studies());
  EXPECT_EQ(std::ranges::count(text, '\n'), 1 + 2 * 5);
  expect_in(text, "label,method,kind,setting,verdict,",
            "\nelastic section,erk:dop853,rtol,0.0001,right,7,7,7,,,5.0000000000000001e-09,1e-08,",
            ",0.001,wrong count,7,7,7,0.001,1.9999999999999999e-06,", ",1234,",
            "at 3 us it grows, without bound");
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
