#include "subimpact/report/pages.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "report/page.h"
#include "sample_result.h"
#include "subimpact/io/case_file.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not there";
}

FinishedRun small_run(const std::vector<Override>& settings = {}) {
  std::vector<Override> all = {parse_override("time.end=9e-4"), parse_override("model.segments=51"),
                               parse_override("output.sections=0.5"),
                               parse_override("title=\"Beam <A> & \\\"B\\\"\"")};
  all.insert(all.end(), settings.begin(), settings.end());
  FinishedRun run;
  run.input = read_case_file(SUBIMPACT_PAPER_CASE, all).value;
  run.result = simulate(run.input);
  run.program_version = "1.2.3";
  run.libraries = {{"SUNDIALS", "6.4.1"}};
  return run;
}

std::string page_of(const FinishedRun& run, const std::string& dygraphs = {}) {
  const TemporaryDirectory directory;
  const DrawnFigures figures = draw_figures(directory.path, run.input, run.result);
  return html_report(run, figures, directory.path, dygraphs);
}

// The first thing wrong with a page as XML: a tag left open or closed twice, a bare & or <, an
// attribute without quotes, an id used twice. Empty if nothing is.
std::string xml_problem(const std::string& page) {
  std::vector<std::string> open;
  std::vector<std::string> ids;
  std::size_t at = page.find('>') + 1;  // past the document type
  while (at < page.size()) {
    const char c = page[at];
    if (c == '&') {
      const std::size_t end = page.find(';', at);
      if (end == std::string::npos || end - at > 6) return "bare & at " + page.substr(at, 30);
      at = end;
    }
    if (c != '<') {
      ++at;
      continue;
    }
    if (page.compare(at, 9, "<![CDATA[") == 0) {
      at = page.find("]]>", at) + 3;
      continue;
    }
    if (page.compare(at, 4, "<!--") == 0) {
      at = page.find("-->", at) + 3;
      continue;
    }
    std::size_t end = at + 1;
    char quote = 0;
    for (; end < page.size() && (quote != 0 || page[end] != '>'); ++end) {
      if (quote != 0) {
        if (page[end] == quote) quote = 0;
      } else if (page[end] == '"' || page[end] == '\'') {
        if (page[page.find_last_not_of(' ', end - 1)] != '=')
          return "a quote out of place in " + page.substr(at, 60);
        quote = page[end];
      } else if (page[end] == '<') {
        return "< within " + page.substr(at, 60);
      }
    }
    const std::string tag = page.substr(at + 1, end - at - 1);
    const std::size_t name_end = tag.find_first_of(" \t\n/", tag[0] == '/' ? 1 : 0);
    const std::string name = tag.substr(0, name_end);
    const std::size_t id = tag.find(" id=");
    if (id != std::string::npos) {
      const std::string value = tag.substr(id + 5, tag.find(tag[id + 4], id + 5) - id - 5);
      if (std::find(ids.begin(), ids.end(), value) != ids.end()) return "id twice: " + value;
      ids.push_back(value);
    }
    if (name[0] == '/') {
      if (open.empty() || "/" + open.back() != name) return "closed but not open: " + name;
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
    at = end + 1;
  }
  return open.empty() ? "" : "left open: " + open.back();
}

TEST(HtmlReport, ShowsAWishUnderTheTitle) {
  FinishedRun run = small_run();
  EXPECT_EQ(html_report(run, {}, ".").find("Wish:"), std::string::npos);
  run.result.wish = WishOutcome{1e-6, false, 2e-6, 8.4e-4, "cells < 51", "model.segments"};
  const std::string page = html_report(run, {}, ".");
  expect_in(page, "Wish: event times within 1 µs: not met; 2 µs reached up to 840 µs");
  expect_in(page, "cells &lt; 51; free model.segments.");
  EXPECT_LT(page.find("Wish:"), page.find("<h2>"));
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
  EXPECT_EQ(xml_problem(page_of(small_run())), "");
  const std::string page = page_of(small_run(), "/nowhere");  // without the library of charts
  EXPECT_EQ(xml_problem(page), "");
  for (const char* outside : {"http:", "https:", "src=", "<link", "@import", "<img", "<iframe",
                              "url(\"", "url('", "file:"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  // References within figures lead to ids of the same figure.
  expect_in(page, "href='#response-gp");
  expect_in(page, "id='response-gp");
}

TEST(HtmlReport, HoldsCaseSummaryTableFiguresAndConservation) {
  const FinishedRun run = small_run();
  const std::string page = page_of(run);
  for (const char* piece :
       {"Beam &lt;A&gt; &amp; &quot;B&quot;", "Summary", "Figures", "figure-response",
        "figure-bending", "figure-shapes", "figure-envelope", "Figure 8.", "Sub-impacts",
        "peak force", "Case", "[striker]", "velocity = 15.9  # m/s", "erk, table dop853",
        "no error bars were computed", "conservation        energy to", "contact over",
        "subimpact 1.2.3, SUNDIALS 6.4.1"}) {
    expect_in(page, piece);
  }
  std::size_t n_rows = 0;
  for (std::size_t at = page.find("<tr data-hit"); at != std::string::npos;
       at = page.find("<tr data-hit", at + 1)) {
    ++n_rows;
  }
  EXPECT_EQ(n_rows, run.result.sub_impacts.size());
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
  const FinishedRun run = small_run({parse_override("beam.damping.mass=2000")});
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
  const std::string page = html_report(small_run(), {}, ".", directory.path);
  EXPECT_EQ(xml_problem(page), "");
  expect_in(page, "a[b[0]] >1;'<\\/script>';\n\nlast()");
  expect_in(page, ".dygraph {}");
  EXPECT_EQ(page.find("charts are missing"), std::string::npos);
  expect_in(html_report(small_run(), {}, ".", "/nowhere"), "apt-get install libjs-dygraphs");
}

TEST(HtmlReport, StatesFirstWhatIsCertainAndWhatIsNot) {
  FinishedRun run = small_run();
  const auto page_with = [&](const Result& result) {
    run.result = result;
    return html_report(run, {}, ".");
  };
  expect_in(html_report(run, {}, "."), "Not certain:</b> event times, count and order");
  const std::string page = page_with(sample_result_with_errors(1));
  expect_in(page, "Certain:</b> 1 of 3 sub-impacts, each start and end within 0.017 µs.</li>");
  expect_in(page, "Not certain:</b> sub-impact 2: they part.</li>");
  EXPECT_LT(page.find("Certain:</b>"), page.find("class=\"tiles\""));
  Result over = sample_result_with_errors(3);
  over.contact_over = true;
  const std::string certain = page_with(over);
  expect_in(certain, "Certain:</b> the end of contact: proven");
  expect_in(certain,
            "Certain:</b> all 3 sub-impacts, each start and end within 0.3 µs, and that there are "
            "no others.</li>");
  EXPECT_EQ(certain.find("Not certain:</b>"), std::string::npos);
  EXPECT_EQ(page_with(sample_result_with_errors(0)).find("0 of 3"), std::string::npos);
}

TEST(HtmlReport, NamesTheFlightsThatMayHoldAnotherSubImpact) {
  FinishedRun run = small_run();
  run.result = sample_result_with_an_uncertain_flight(1);
  const std::string page = html_report(run, {}, ".");
  EXPECT_EQ(xml_problem(page), "");
  expect_in(page,
            "Not certain:</b> after sub-impact 2: there is another one with the same, coarser.");
  expect_in(page,
            "<p>After sub-impact 2 there may be another one: there is another one with the same, "
            "coarser.</p>");
  expect_in(page, "<b>3 in 2 zones, 3 certain, which may not be all</b>");
}

TEST(HtmlReport, BeginsWithABannerOfFailedChecksAndWarnings) {
  FinishedRun run = small_run();
  EXPECT_EQ(page_of(run).find("class=\"failed\""), std::string::npos);
  run.result.outcome.kind = OutcomeKind::unstable;
  run.result.outcome.first_failure = Interval{1e-4, 2e-4};
  run.result.warnings = {"beam.length is 711 m & long"};
  const std::string page = page_of(run);
  EXPECT_EQ(xml_problem(page), "");
  const auto banner = page.find(
      "<p class=\"failed\">unstable: results up to 100 µs passed every check; first failure "
      "between "
      "100 and 200 µs.</p>");
  ASSERT_NE(banner, std::string::npos);
  EXPECT_LT(banner, page.find("class=\"tiles\""));
  expect_in(page, "Warning: beam.length is 711 m &amp; long.");
}

TEST(HtmlReport, CountsOneAsOne) {
  FinishedRun run = small_run({parse_override("time.end=1e-5")});
  const std::string page = page_of(run);
  expect_in(page, "<b>1 in 1 zone");
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
  estimate.reason = "they <part>";
  estimate.largest_error = 3e-7;
  estimate.parts = {{"time", "rtol = 1e-7", {}, "", 2e-9},
                    {"mesh", "43 cells", 1, "they <part>", 3e-7}};
  run.result.error_estimate = estimate;
  const std::string page = page_of(run);
  EXPECT_EQ(xml_problem(page), "");
  for (const char* piece : {"all times to 0.002 µs up to 900 µs (runs beside: rtol = 1e-7)",
                            "as above (runs beside: 43 cells)",
                            "times of the certain ones to 0.3 µs; sub-impact 2: they &lt;part&gt;",
                            "Not certain:</b> sub-impact 2: they &lt;part&gt;."}) {
    expect_in(page, piece);
  }
}

TEST(HtmlReport, StatesNoErrorOfTimesWhereNoSubImpactIsCertain) {
  FinishedRun run = small_run();
  run.result = sample_result_with_errors(0);
  const std::string page = html_report(run, {}, ".");
  expect_in(page, "no sub-impact is certain; sub-impact 1: they part");
  expect_in(page, "as above (runs beside: the same, coarser)");
  EXPECT_EQ(page.find("their times to"), std::string::npos);
}

TEST(HtmlReport, CountsAndMarksUncertainSubImpacts) {
  FinishedRun run = small_run();
  run.result = sample_result_with_errors(1);
  const std::string page = html_report(run, {}, ".");
  EXPECT_EQ(xml_problem(page), "");
  expect_in(page, "<b>3 in 2 zones, 1 certain</b>");
  expect_in(page, "333.333 ± 0.017");
  EXPECT_NE(page.find("<tr data-hit=\"0\" title=\"\">"), std::string::npos);
  const auto second = page.find("<tr data-hit=\"1\" class=\"uncertain\" title=\"they part\">");
  const auto third = page.find("<tr data-hit=\"2\" class=\"uncertain\" title=\"they part\">");
  ASSERT_NE(second, std::string::npos);
  ASSERT_NE(third, std::string::npos);
  EXPECT_LT(page.find("<td>333.333 ±"), second);
  EXPECT_LT(second, third);
  EXPECT_EQ(page.substr(second, page.find("</table>", second) - second).find("±"),
            std::string::npos);
  expect_in(page, "<b>3 in 2 zones, 1 certain</b><small>times of the certain ones to 0.017 µs");
  expect_in(page, "3 in 2 zones, 1 certain");
}

TEST(HtmlReport, WithoutErrorBarsMarksNoSubImpact) {
  FinishedRun run = small_run();
  run.result = sample_result();
  const std::string page = html_report(run, {}, ".");
  EXPECT_EQ(page.find("class=\"uncertain\""), std::string::npos);
  expect_in(page, "<span>sub-impacts</span><b>3 in 2 zones</b>");
  expect_in(page, "errors are not known");
}

TEST(HtmlReport, OfARunThatFailedSaysSo) {
  FinishedRun run = small_run();
  run.result.outcome = {OutcomeKind::solver_failed, 5e-4, "the step became too small", {}};
  const std::string page = page_of(run);
  expect_in(page, "solver-failed");
  expect_in(page, "the step became too small");
  EXPECT_EQ(xml_problem(page), "");
}

TEST(HtmlReport, ShowsNoDigitBelowTheErrorOfWhatARunEndsWith) {
  FinishedRun run = small_run();
  run.result = sample_result_with_errors(3);
  run.result.striker_velocity = 5.76912;
  const std::string known = page_of(run);
  expect_in(known, "striker 5.7691 ± 0.0007 m/s");
  expect_in(known, "<span>largest force</span><b>8796.3 ± 0.5 N</b>");
  run.result.error_estimate->totals.at(2).total.error.reset();
  const std::string unknown = page_of(run);
  expect_in(unknown, "striker 5.77 m/s, beam");
  const std::string above_stored_digits = unknown.substr(0, unknown.find("<details>"));
  EXPECT_EQ(above_stored_digits.find("5.769"), std::string::npos);
}

TEST(HtmlReport, StatesWhatTheTheoryLeavesOut) {
  FinishedRun run = small_run();
  run.result.neglected_shear = {200e-6, 210e-6};
  expect_in(page_of(run),
            "left out            shear, which on a coarse mesh moves the end of the first contact "
            "from 200 to\n");
}

TEST(HtmlReport, ShowsTheScatterOfTimesAndTheHorizon) {
  FinishedRun run = small_run();
  run.result = sample_result_with_errors(3);
  run.result.sub_impacts[1].start_scatter = 2.5e-6;
  run.result.predictability = Predictability{1, "contacts merge", 1e-3 / 3.0, 2e-6, {}, {}};
  const std::string page = page_of(run);
  expect_in(page, "500 ± 3");
  expect_in(page, "from here on not predictable: contacts merge");
  expect_in(page, "\"horizon\":0.000333");
  expect_in(page, "\"start_scatter\":2.5e-06");
}

TEST(ComparisonReport, ListsTheKeysThatDifferAndMatchesSubImpacts) {
  const std::vector<FinishedRun> runs = {
      small_run(), small_run({parse_override("solver.method=central-difference")})};
  const std::string page = comparison_report(runs, {"a<b", "second"}, "/nowhere");
  EXPECT_EQ(xml_problem(page), "");
  for (const char* piece : {"a&lt;b", "<tr><td>solver.method</td>", "Sub-impacts of B beside those",
                            "correspond one to one", "Beam &lt;A&gt;", "libjs-dygraphs"}) {
    expect_in(page, piece);
  }
  EXPECT_EQ(page.find("<td>striker.mass"), std::string::npos);
  const std::string same = comparison_report({runs[0], runs[0]}, {"one", "two"}, "/nowhere");
  expect_in(same, "None: the cases are the same.");
  expect_in(same, "+0.0000");
}

}  // namespace
}  // namespace subimpact
