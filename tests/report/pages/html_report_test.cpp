#include "subimpact/report/pages.h"

#include <fmt/format.h>

#include "case_with.h"
#include "report/pages/page.h"
#include "sample_result.h"
#include "subimpact/io/output_directory.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

FinishedRun small_run(const std::vector<std::string>& settings = {}) {
  FinishedRun run;
  run.input = paper_case_with(
      {"time.end=9e-4", "model.segments=51", "output.sections=0.5", R"(title="Beam <A> & \"B\"")"},
      settings);
  run.result = simulate(run.input);
  run.program_version = "1.2.3";
  run.libraries = {{"SUNDIALS", "6.4.1"}};
  return run;
}

// What Python's parser finds wrong with a page as XML, or an id used twice; empty if nothing is.
std::string xml_problem(const std::string& page) {
  const TemporaryDirectory directory;
  directory.write("parse.py", R"(
import sys, xml.etree.ElementTree
try:
    ids = [e.get("id") for e in xml.etree.ElementTree.parse("page").iter() if e.get("id")]
    print([i for i in ids if ids.count(i) > 1] or "")
except xml.etree.ElementTree.ParseError as error:
    print(error)
)");
  directory.write("page", page);
  const std::string go = "cd " + directory.path.string() + " && python3 parse.py > problem 2>&1";
  EXPECT_EQ(std::system(go.c_str()), 0) << directory.read("problem");
  const std::string problem = directory.read("problem");
  return problem.substr(0, problem.find('\n'));
}

// A figure whose names are those of another.
const DrawnFigures two_figures = {{{"response", "Force <over> time.", R"svg(<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"><defs>
<path id="m1" d="M0 0"/></defs><use xlink:href="#m1" clip-path="url(#m1)"/></svg>)svg"},
                                   {"bending", "Loops.", "<svg><path id=\"m1\"/></svg>"}},
                                  {"shapes: none"}};

std::string page_of(const FinishedRun& run, const std::string& dygraphs = {}) {
  std::string page = html_report(run, {}, dygraphs);
  EXPECT_EQ(xml_problem(page), "");
  return page;
}

std::string page_of(const Result& result) {
  FinishedRun run = small_run();
  run.result = result;
  return page_of(run);
}

TEST(HtmlReport, ShowsAWishUnderTheTitle) {
  FinishedRun run = small_run();
  expect_not_in(page_of(run), "Tolerance:");
  run.result.tolerance =
      ToleranceOutcome{1e-6, false, 2e-6, 8.4e-4, Reason{{}, "cells < 51"}, {}, "model.segments"};
  const std::string page = page_of(run);
  expect_in(page.substr(0, page.find("<h2>")), "Tolerance:", "not met; 2 µs reached up to 840 µs",
            "cells &lt; 51; free model.segments");
}

TEST(XmlProblem, IsFoundWhereThereIsOne) {
  EXPECT_EQ(xml_problem("<!DOCTYPE html><a b=\"c\"><d/>&amp;</a>"), "");
  for (const char* spoilt :
       {"<!DOCTYPE html><a><b></a>", "<!DOCTYPE html><a>x & y</a>", "<!DOCTYPE html><a>x < y</a>",
        "<!DOCTYPE html><a>", "<!DOCTYPE html><a id=\"x\"><b id='x'/></a>"}) {
    EXPECT_NE(xml_problem(spoilt), "") << spoilt;
  }
}

TEST(HtmlReport, IsWellFormedAndNeedsNothingFromOutside) {
  const std::string page = html_report(small_run(), two_figures, "/nowhere");  // no charts
  EXPECT_EQ(xml_problem(page), "");
  expect_not_in(page, "http:", "https:", "src=", "<link", "@import", "<img", "<iframe", "url(\"",
                "url('", "file:");
  // References within figures lead to ids of the same figure.
  expect_in(page, "href=\"#response-m1\"", "url(#response-m1)", "id=\"response-m1\"",
            "id=\"bending-m1\"");
}

TEST(HtmlReport, HoldsCaseSummaryTableFiguresAndConservation) {
  const FinishedRun run = small_run();
  const std::string page = html_report(run, two_figures);
  expect_in(page, "Beam &lt;A&gt; &amp; &quot;B&quot;", "Summary", "Figures", "figure-response",
            "Figure 2.</b> Loops.", "Force &lt;over&gt; time.", "Not drawn: shapes: none",
            "Sub-impacts", "peak force", "Case", "[striker]", "velocity = 15.9  # m/s",
            "erk, table dop853", "no error bars were computed", "conservation        energy to",
            "contact over", "subimpact 1.2.3, SUNDIALS 6.4.1");
  EXPECT_EQ(count_in(page, "<tr data-hit"), run.result.sub_impacts.size());
  expect_not_in(page, "None: <code>subimpact plot</code>");
  expect_in(html_report(run), "None: <code>subimpact plot</code> draws them");
}

TEST(FiguresOfARun, AreThoseThatWereDrawnOfItAndNotChangedSince) {
  const TemporaryDirectory directory;
  {
    OutputDirectory files(directory.path, "figures", "1");
    const std::string list =
        R"({"figures": [{"name": "a", "caption": "A."}, {"name": "b", "caption": "B."},
                        {"name": "active", "caption": "C."}], "left_out": ["c: no data"], "failed": []})";
    for (const auto& [name, text] : {std::pair<std::string, std::string>("figures.json", list),
                                     {"a.svg", "<svg/>"},
                                     {"b.svg", "<svg/>"},
                                     {"active.svg", "<svg onload='run()'/>"}}) {
      std::ofstream(files.staging() / name) << text;
    }
    files.commit();
  }
  EXPECT_EQ(read_figures(directory.path, "1").drawn.size(), 2u);
  EXPECT_TRUE(read_figures(directory.path, "2").drawn.empty());
  EXPECT_TRUE(read_figures(directory.path / "none", "1").drawn.empty());
  directory.write("b.svg", "<script/>");
  const DrawnFigures figures = read_figures(directory.path, "1");
  ASSERT_EQ(figures.drawn.size(), 1u);
  EXPECT_EQ(figures.drawn[0].caption, "A.");
  EXPECT_EQ(figures.left_out.size(), 3u);
}

TEST(HtmlReport, ListsEveryNumberOfTheSummary) {
  const FinishedRun run = small_run();
  const std::string page = page_of(run);
  const Json summary = Json::parse(summary_json(run.input, run.result)).flatten();
  std::size_t n_numbers = 0;
  for (const auto& [path, value] : summary.items()) {
    const bool is_of_case = path.starts_with("/case");
    const bool is_in_list = path.find_first_of("0123456789") != path.npos;
    if (!value.is_number() || is_of_case || is_in_list) continue;
    std::string name = path.substr(1);
    std::ranges::replace(name, '/', '.');
    if (name.starts_with("counts.transitions.")) continue;  // named by the kinds of events
    ++n_numbers;
    expect_in(page, fmt::format("<code>{}</code></td><td>{}</td>", name, value.dump()));
  }
  EXPECT_GT(n_numbers, 40u);
}

TEST(HtmlReport, ListsEnergiesThatAddUpToTheInitialOneWhereTheBeamIsDamped) {
  const FinishedRun run = small_run({"beam.damping.mass=2000"});
  const std::string page = page_of(run);
  const std::string heading = "<span>energy</span>";
  const std::size_t at = page.find(heading);
  ASSERT_NE(at, std::string::npos);
  std::istringstream shares(page.substr(page.find("<small>", at) + 7, 200));
  double sum = 0.0;
  for (std::string word; shares >> word && word.find('<') == word.npos;) {
    double share = 0.0;
    if (std::istringstream(word) >> share) sum += share;
  }
  EXPECT_NEAR(sum, run.result.used.initial_energy, 1e-3 * run.result.used.initial_energy);
  EXPECT_GT(run.result.beam_damping_loss, 0.01 * run.result.used.initial_energy);
}

TEST(HtmlReport, HoldsTheLibraryOfChartsOrStatesHowToGetIt) {
  const TemporaryDirectory directory;
  std::ofstream(directory.path / "dygraph.min.js")
      << "a[b[0]]>1;'</script>';\n//# sourceMappingURL=dygraph.min.js.map\nlast()";
  std::ofstream(directory.path / "dygraph.css") << ".dygraph {}";
  const std::string page = page_of(small_run(), directory.path);
  expect_in(page, "a[b[0]] >1;'<\\/script>';\n\nlast()", ".dygraph {}");
  expect_not_in(page, "charts are missing");
  expect_in(page_of(small_run(), "/nowhere"), "apt-get install libjs-dygraphs");
}

TEST(HtmlReport, StatesFirstWhatIsCertainAndWhatIsNot) {
  expect_in(page_of(small_run()), "Not certain:</b> event times, count and order");
  const std::string page = page_of(sample_result_with_errors(1));
  expect_in(page.substr(0, page.find("class=\"tiles\"")), "Certain:</b> 1 of 3 sub-impacts",
            "within 0.017 µs", "Not certain:</b> sub-impact 2: they part");
  Result over = sample_result_with_errors(3);
  over.contact_over = true;
  const std::string certain = page_of(over);
  expect_in(certain, "Certain:</b> the end of contact", "Certain:</b> all 3 sub-impacts",
            "within 0.3 µs");
  expect_not_in(certain, "Not certain:</b>");
  expect_not_in(page_of(sample_result_with_errors(0)), "0 of 3");
}

TEST(HtmlReport, NamesTheFlightsThatMayHoldAnotherSubImpact) {
  expect_in(page_of(sample_result_with_an_uncertain_flight(1)),
            "Not certain:</b> after sub-impact 2", "After sub-impact 2 there may be another",
            "3 in 2 zones, 3 certain, which may not be");
}

TEST(HtmlReport, BeginsWithABannerOfFailedChecksAndWarnings) {
  FinishedRun run = small_run();
  expect_not_in(page_of(run), "class=\"failed\"");
  run.result.outcome.kind = OutcomeKind::unstable;
  run.result.outcome.first_failure = Interval{1e-4, 2e-4};
  run.result.warnings = {"beam.length is 711 m & long"};
  const std::string page = page_of(run);
  const std::string banner = page.substr(0, page.find("class=\"tiles\""));
  expect_in(banner, "unstable", "up to 100 µs", "between 100 and 200 µs",
            "beam.length is 711 m &amp; long");
}

TEST(HtmlReport, CountsOneAsOne) {
  expect_in(page_of(small_run({"time.end=1e-5"})), "<b>1 in 1 zone");
}

TEST(HtmlReport, ListsErrorBarsByTheirSource) {
  FinishedRun run = small_run();
  for (SubImpact& s : run.result.sub_impacts) {
    s.start_error = s.error_time = 2e-9;
    s.certain = true;
  }
  run.result.sub_impacts.at(1).certain = false;
  ErrorEstimate estimate;
  estimate.first_unresolved = 1;
  estimate.reason = Reason{{}, "they <part>"};
  estimate.largest_error = 3e-7;
  estimate.parts = {{{"rtol = 1e-7", {}, {}, 2e-9}, ErrorSource::time},
                    {{"43 cells", 1, estimate.reason, 3e-7}, ErrorSource::mesh}};
  run.result.error_estimate = estimate;
  expect_in(page_of(run), "to 0.002 µs up to 900 µs (runs beside: rtol = 1e-7)",
            "(runs beside: 43 cells)", "to 0.3 µs; sub-impact 2: they &lt;part&gt;");
}

TEST(HtmlReport, StatesNoErrorOfTimesWhereNoSubImpactIsCertain) {
  const std::string page = page_of(sample_result_with_errors(0));
  expect_in(page, "no sub-impact is certain; sub-impact 1: they part");
  expect_not_in(page, "their times to");
}

TEST(HtmlReport, CountsAndMarksUncertainSubImpacts) {
  const std::string page = page_of(sample_result_with_errors(1));
  expect_in(page,
            "<b>3 in 2 zones, 1 certain</b><small>2 parted by more than 1 µm, 2 by more than 10 "
            "µm; times of the certain ones to 0.017 µs",
            "333.333 ± 0.017", "<tr data-hit=\"0\" title=\"\">");
  EXPECT_EQ(count_in(page, "class=\"uncertain\" title=\"they part\""), 2u);
  const auto second = page.find("<tr data-hit=\"1\" class=\"uncertain\"");
  ASSERT_NE(second, std::string::npos);
  expect_not_in(page.substr(second, page.find("</table>", second) - second), "±");
}

TEST(HtmlReport, WithoutErrorBarsMarksNoSubImpact) {
  const std::string page = page_of(sample_result());
  expect_not_in(page, "class=\"uncertain\"");
  expect_in(page, "<span>sub-impacts</span><b>3 in 2 zones</b>", "errors are not known");
}

TEST(HtmlReport, OfARunThatFailedSaysSo) {
  Result result = sample_result();
  result.outcome = {OutcomeKind::solver_failed, 5e-4, "the step became too small", {}};
  expect_in(page_of(result), "solver-failed", "the step became too small");
}

TEST(HtmlReport, ShowsNoDigitBelowTheErrorOfWhatARunEndsWith) {
  FinishedRun run = small_run();
  run.result = sample_result_with_errors(3);
  run.result.striker_velocity = 5.76912;
  const std::string known = page_of(run);
  expect_in(known, "striker 5.7691 ± 0.0007 m/s", "8796.3 ± 0.5 N");
  run.result.error_estimate->totals.at(2).total.error.reset();
  const std::string unknown = page_of(run);
  expect_in(unknown, "striker 5.77 m/s (error not known), beam");
  expect_not_in(unknown.substr(0, unknown.find("<details>")), "5.769");  // above stored digits
}

TEST(HtmlReport, StatesWhatTheModelLeavesOutTheLargestPartFirst) {
  FinishedRun run = small_run();
  ModelErrors& errors = run.result.model_errors.emplace();
  errors.value.parting = 200e-6;
  errors.error.parting = 10.5e-6;
  errors.parts = {{"width", "", {0.5e-6, {}, {}, {}}},
                  {"hinge length", ""},
                  {"shear", "", {10e-6, {}, {}, {}}}};
  run.input.model_choice = "a cylinder across a solid beam";
  expect_in(page_of(run), "200 ± 11 µs", "shear 10, width 0.50, hinge length not known",
            "a cylinder across");
}

TEST(HtmlReport, ShowsTheScatterOfTimesAndTheHorizon) {
  Result result = sample_result_with_errors(3);
  result.sub_impacts[1].start_scatter = 2.5e-6;
  result.predictability = Predictability{1, "contacts merge", 1e-3 / 3.0, 2e-6, {}, {}, {}, 0, ""};
  expect_in(page_of(result), "500 ± 3", "not predictable: contacts merge", "\"horizon\":0.000333",
            "\"start_scatter\":2.5e-06");
}

TEST(ComparisonReport, ListsTheKeysThatDifferAndMatchesSubImpacts) {
  const std::vector<FinishedRun> runs = {small_run(),
                                         small_run({"solver.method=central-difference"})};
  const std::string page = comparison_report(runs, {"a<b", "second"}, "/nowhere");
  expect_in(page, "a&lt;b", "<tr><td>solver.method</td>", "Sub-impacts of B compared with those",
            "correspond one to one", "Beam &lt;A&gt;", "libjs-dygraphs");
  expect_not_in(page, "<td>striker.mass");
  const std::string same = comparison_report({runs[0], runs[0]}, {"one", "two"}, "/nowhere");
  expect_in(same, "None: the cases are the same.", "+0.0000");
}

}  // namespace
}  // namespace subimpact
