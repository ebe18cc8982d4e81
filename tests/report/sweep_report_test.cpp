#include "subimpact/report/sweep_report.h"

#include <gtest/gtest.h>

#include <limits>

namespace subimpact {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not there";
}

SweptRuns three_runs() {
  SweptRuns runs;
  runs.numbers = {0, 1, 2};
  runs.columns = {{"striker.mass", true, {0.1, 0.2, 0.3}, {}},
                  {"outcome", false, {}, {"completed", "completed", "</script>"}},
                  {"n_sub_impacts", false, {7.0, 9.0, none}, {}},
                  {"all_decided", false, {1.0, 0.0, none}, {}}};
  runs.sub_impacts.resize(3);
  runs.sub_impacts[0].resize(7);
  return runs;
}

TEST(SweepReport, StatesFirstWhatIsCertainAndWhatIsNot) {
  const std::string page = sweep_report(three_runs(), "here");
  expect_in(page, "count and order of the sub-impacts in 1 of 3 runs.");
  expect_in(page, "the counts of 1 run, which the map marks with a cross");
  expect_in(page, "1 run with the outcome &quot;&lt;/script&gt;&quot;");
  expect_in(page, "<b>7 to 9</b><span>sub-impacts per run</span>");
  expect_in(page, "3 different, 0.1 to 0.3 kg");
}

TEST(SweepReport, OfRunsWithoutErrorBarsStatesThatNoCountIsCertain) {
  SweptRuns runs = three_runs();
  runs.columns.pop_back();
  expect_in(sweep_report(runs, "here"), "the sweep was made without error bars");
}

TEST(SweepReport, NeedsNothingFromOutsideAndShowsNamesAsText) {
  const std::string page = sweep_report(three_runs(), "a\"<script>`b`\n'c'");
  expect_in(page, "<h1>Sweep: a&quot;&lt;script&gt;`b`\n'c'</h1>");
  std::size_t n_scripts = 0;
  for (std::size_t at = page.find("</script"); at != page.npos;
       at = page.find("</script", at + 1)) {
    ++n_scripts;
  }
  EXPECT_EQ(n_scripts, 5u);  // data, and four of the page
  EXPECT_EQ(page.find("src=\""), std::string::npos);
  EXPECT_EQ(page.find("href=\""), std::string::npos);
}

TEST(SweepReport, LeavesOutSubImpactsOfHugeSweepsAndStatesIt) {
  SweptRuns runs = three_runs();
  runs.sub_impacts[0].resize(79'999);
  runs.sub_impacts[1].resize(2);
  runs.sub_impacts[2].resize(1);
  const std::string page = sweep_report(runs, "here");
  expect_in(page, "the sub-impacts of 1 run are left out; sub_impacts.csv has them");
  expect_in(page, "\"counts\":[79999,-1,1]");
  EXPECT_LT(page.size(), 6e6);
}

}  // namespace
}  // namespace subimpact
