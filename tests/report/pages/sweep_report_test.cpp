#include "subimpact/report/pages.h"

#include <nlohmann/json.hpp>
#include <random>

#include "io/records/run_tables.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

SweptRuns three_runs() {
  SweptRuns runs;
  runs.numbers = {0, 1, 2};
  runs.columns = {{"striker.mass", true, {0.1, 0.2, 0.3}, {}},
                  {"outcome", false, {}, {"completed", "completed", "</script>"}},
                  {"n_sub_impacts", false, {7.0, 9.0, none}, {}},
                  {"all_certain", false, {1.0, 0.0, none}, {}}};
  runs.sub_impacts.resize(3);
  runs.sub_impacts[0].resize(7);
  return runs;
}

TEST(SweepReport, StatesFirstWhatIsCertainAndWhatIsNot) {
  const std::string page = sweep_report(three_runs(), "here", "base.toml");
  expect_in(page, "count and order of the sub-impacts in 1 of 3 runs.",
            "the counts of 1 run, which the map marks with a cross",
            "1 run with the outcome &quot;&lt;/script&gt;&quot;",
            "<b>7 to 9</b><span>sub-impacts per run</span>", "3 different, 0.1 to 0.3 kg");
}

TEST(SweepReport, OfRunsWithoutErrorBarsStatesThatNoCountIsCertain) {
  SweptRuns runs = three_runs();
  runs.columns.pop_back();
  expect_in(sweep_report(runs, "here", "base.toml"), "the sweep was made without error bars");
}

TEST(SweepReport, NeedsNothingFromOutsideAndShowsNamesAsText) {
  const std::string page = sweep_report(three_runs(), "a\"<script>`b`\n'c'", "base.toml");
  expect_in(page, "<h1>Sweep: a&quot;&lt;script&gt;`b`\n'c'</h1>");
  // The page's own scripts and its data, none that a name brings in or ends.
  const std::size_t n_scripts =
      count_in(page, "<script>/*<![CDATA[*/") + count_in(page, "id=\"data\"");
  EXPECT_EQ(count_in(page, "<script"), n_scripts);
  EXPECT_EQ(count_in(page, "</script"), n_scripts);
  expect_not_in(page, "src=\"", "href=\"");
}

TEST(SweepReport, LeavesOutSubImpactsOfHugeSweepsAndStatesIt) {
  SweptRuns runs = three_runs();
  runs.sub_impacts[0].resize(79'999);
  runs.sub_impacts[1].resize(2);
  runs.sub_impacts[2].resize(1);
  const std::string page = sweep_report(runs, "here", "base.toml");
  expect_in(page, "the sub-impacts of 1 run are left out; sub_impacts.csv has them",
            "\"counts\":[79999,-1,1]");
  EXPECT_LT(page.size(), 6e6);
}

// One change of a table: a byte, a cut, a line lost or twice, another value.
std::string damaged(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const std::size_t at = below(text.size());
  const std::size_t line = text.rfind('\n', at) + 1;
  const std::size_t next = std::min(text.find('\n', at), text.size() - 1) + 1;
  static const std::vector<std::string> values = {"nan",   "inf", "-1", "",
                                                  "1e308", "<b>", "0",  "\""};
  switch (below(6)) {
    case 0:
      text[at] = static_cast<char>(below(256));
      break;
    case 1:
      text.resize(at);
      break;
    case 2:
      text.erase(line < next ? line : 0, next - std::min(line, next));
      break;
    case 3:
      text.insert(line, text.substr(line < next ? line : 0, next - std::min(line, next)));
      break;
    default: {
      const std::size_t from = text.find_last_of(",\n", at) + 1;
      const std::size_t to = std::min(text.find_first_of(",\n", from), text.size());
      text.replace(from, to - from, values[below(values.size())]);
    }
  }
  return text;
}

TEST(SweepReport, OfDamagedTablesIsAMessageOrAWholePage) {
  Result result;
  for (int i = 0; i < 3; ++i) {
    SubImpact s;
    s.start = 1e-3 * i;
    s.end = 1e-3 * i + 1e-4;
    s.zone = s.subzone = 1;
    result.sub_impacts.push_back(s);
  }
  const std::string events = csv_of<SubImpact>(result);
  std::string sub_impacts = "run," + events.substr(0, events.find('\n') + 1);
  for (const char run : {'0', '1', '2'}) {
    for (std::size_t at = events.find('\n') + 1; at < events.size();) {
      const std::size_t end = events.find('\n', at) + 1;
      sub_impacts += run + std::string(",") + events.substr(at, end - at);
      at = end;
    }
  }
  const std::string runs =
      "run,striker.mass,solver.method,outcome,time_s,n_sub_impacts,n_certain,all_certain,message\n"
      "0,0.1,erk,completed,0.008,3,3,1,\n1,0.2,erk,completed,0.008,3,2,0,\n"
      "2,0.3,nystrom,refused,,,,,why\n";
  std::mt19937 random(19);
  int refused = 0, accepted = 0;
  const TemporaryDirectory directory;
  for (int i = 0; i < 400; ++i) {
    const bool first = i % 2 == 0;
    std::ofstream(directory.path / "runs.csv") << (first ? damaged(runs, random) : runs);
    std::ofstream(directory.path / "sub_impacts.csv")
        << (first ? sub_impacts : damaged(sub_impacts, random));
    try {
      const std::string page = sweep_report(read_sweep(directory.path), "here", "base.toml");
      const std::string mark = "id=\"data\">";
      const std::size_t from = page.find(mark) + mark.size();
      const auto json =
          nlohmann::json::parse(page.substr(from, page.find("</script", from) - from));
      EXPECT_EQ(json.at("numbers").size(), json.at("sub_impacts").at("counts").size());
      ++accepted;
    } catch (const ResultsError& error) {
      expect_in(std::string(error.what()), ".csv");
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(accepted, 50);
}

}  // namespace
}  // namespace subimpact
