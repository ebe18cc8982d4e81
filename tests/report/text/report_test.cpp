#include "subimpact/report/text.h"

#include <fmt/format.h>

#include "case_with.h"
#include "sample_result.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/options.h"
#include "subimpact/study/run_as_asked.h"
#include "testing.h"
#include "text/summary_lines.h"

namespace subimpact {
namespace {

Case paper_case() { return paper_case_with({}); }

TEST(RunSummary, GivesAReasonOnce) {
  const std::string summary = summary_of(paper_case(), sample_result_with_errors(2), true);
  EXPECT_EQ(count_in(summary, "they part"), 1u) << summary;
  expect_in(line_of(summary, "runs beside"), "the same, coarser");
}

TEST(ErrorWords, NameTheErrorOfCertainTimesOrTheFirstDoubt) {
  Result touch = sample_result_with_errors(3), between = sample_result_with_errors(1);
  touch.sub_impacts.erase(touch.sub_impacts.begin(), touch.sub_impacts.end() - 1);
  between.sub_impacts[2].certain = true;
  const std::pair<Result, std::string> all[] = {
      {sample_result_with_errors(3), "all times to 0.3 us up to 8 ms"},
      {touch, "no event time up to 8 ms but the first touch"},
      {sample_result_with_errors(2), "certain ones to 0.3 us; sub-impact 3: they part"},
      {between, "certain ones to 0.017 us; sub-impact 2: they part"},
      {sample_result_with_an_uncertain_flight(1), "after sub-impact 2: there is another one"},
      {sample_result_with_an_uncertain_flight(2), "after the last sub-impact: there is another"},
      {sample_result(), "errors are not known"}};
  for (const auto& [result, words] : all) expect_in(error_words(result), words);
}

// The options of all advice, in one text.
std::string advice_on(const Result& result, const GivenKeys& given = {}) {
  std::string text;
  for (const Advice& advised : advice(paper_case(), given, result)) {
    EXPECT_GT(advised.seconds, 0.0);
    EXPECT_FALSE(advised.gain.empty());
    for (const auto& [option, value] : advised.options) text += option + ' ' + value + '\n';
  }
  return text;
}

Result result_that_took_a_while(std::size_t n_certain) {
  Result result = sample_result_with_errors(n_certain);
  result.contact_over = true;
  result.used.contact_time = 7e-6;
  result.work.all_seconds = 1.0;
  result.work.right_hand_sides = 1000;
  return result;
}

TEST(Advice, IsNoneWhereAllIsCertainAndOver) {
  Result result = result_that_took_a_while(3);
  EXPECT_EQ(advice_on(result), "");
  result.contact_over = false;
  EXPECT_EQ(advice_on(result), "--set time.end=0.016\n");
  result.largest_rotation = 12.0;
  EXPECT_EQ(advice_on(result), "") << "a run that is no result";
  result.largest_rotation = 0.0;
  result.outcome.kind = OutcomeKind::stopped;
  EXPECT_EQ(advice_on(result), "");
}

TEST(Advice, OnUncertainSubImpactsOfAChosenMeshIsAToleranceBelowTheErrors) {
  Result result = result_that_took_a_while(2);
  result.choice = "sections yield";
  EXPECT_EQ(advice_on(result), "--within 0.05us\n");  // a fifth of 0.26 us
  result = result_that_took_a_while(0);
  result.choice = "sections yield";
  EXPECT_EQ(advice_on(result), "--within 0.7us\n");  // a tenth of the shortest contacts
}

TEST(Advice, IsNoFinerMeshWhereTheLastOneMadeNoMoreCertainAndNoLongerRunOfBodiesAtRest) {
  Result result = result_that_took_a_while(2);
  result.choice = "sections yield";
  result.certainty_grew = false;
  EXPECT_EQ(advice_on(result), "");
  result.certainty_grew = true;
  EXPECT_EQ(advice_on(result), "--within 0.05us\n");
  result.contact_over = false;
  expect_in(advice_on(result), "time.end");
  result.rests_since = 5e-3;
  expect_not_in(advice_on(result), "time.end");
}

TEST(Advice, OnUncertainSubImpactsOfAMeshThatTheCaseFixesFreesIt) {
  GivenKeys given;
  given.in_file = {"model.segments", "model.section", "solver.rtol", "beam.length"};
  EXPECT_EQ(advice_on(result_that_took_a_while(2), given),
            "--set model.segments=default\n--set solver.rtol=default\n");
  EXPECT_EQ(advice_on(result_that_took_a_while(2)), "") << "nothing is fixed";
}

TEST(Advice, OnSearchesThatTheLimitOfWorkEndedRaisesIt) {
  Result result = result_that_took_a_while(2);
  result.choice = "sections yield";
  result.tolerance =
      ToleranceOutcome{1e-6, false, 2e-6, 1e-3, {}, Reason{Reason::Kind::work_limit}, ""};
  expect_in(advice_on(result), "--within 1us\n--set accuracy.work_limit=");
  result.tolerance->obstacle = Reason{Reason::Kind::fixed_key, "model.segments"};
  EXPECT_EQ(advice_on(result), "");
}

TEST(Advice, OnShearIsTimoshenkosTheoryWhereShearMatters) {
  Result result = result_that_took_a_while(3);
  result.body_errors.emplace().value.parting = 200e-6;
  result.body_errors->parts = {{BodyPart::shear, {0.5e-6}}};
  EXPECT_EQ(advice_on(result), "");
  for (const std::optional<double> change : {std::optional(10e-6), std::optional<double>()}) {
    result.body_errors->parts.front().change.parting = change;
    EXPECT_EQ(advice_on(result), "--set beam.theory=timoshenko\n--set beam.poisson=0.3\n");
  }
}

TEST(FailureMessage, NamesTimeModeMethodLastEventAndCause) {
  Result result = sample_result();
  result.outcome = {OutcomeKind::solver_failed, 12.5e-6, "the library gave up", {}};
  const std::string message = failure_message(paper_case(), result);
  expect_in(message, "solver-failed at 12.5 us", "in contact, sub-impact 3", "method erk",
            "last event section_reverses at 0.666667 us", "the library gave up");
  expect_not_in(message, "\n");
  result.sub_impacts.pop_back();
  expect_in(failure_message(paper_case(), result), "separated after sub-impact 2");
}

TEST(RunSummary, WeighsBeamAndStriker) {
  Case input = paper_case();
  expect_in(line_of(summary_of(input, sample_result()), "0.201 kg"), "nose of 10 mm", "foundation",
            "15.9 m/s", "at the middle of a free-free");
  expect_in(summary_of(input, sample_result()), "beam of 0.2261 kg");
  input.scene.beam.length *= 1e3;
  input.scene.beam.width *= 1e3;
  input.scene.beam.thickness *= 1e3;
  expect_in(summary_of(input, sample_result()), "beam of 2.261e+05 t");
}

TEST(RunSummary, WrapsItsLinesAt100ColumnsAndKeepsErrorsWithTheirNumbers) {
  const std::string summary =
      run_summary(paper_case(), answered(paper_case(), sample_result_with_errors(2)), true);
  std::istringstream lines(summary);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_FALSE(line.ends_with("+-")) << line;
    const bool is_heading = line.ends_with("+- computed  +- real beam  mostly of");
    EXPECT_TRUE(line.empty() || is_heading || line.find_first_not_of(" ") != line.find("+-"))
        << line;
  }
}

TEST(AFailedCheck, IsPlacedInTimeBySummaryFailureMessageAndTable) {
  Result result = sample_result();
  result.outcome = {OutcomeKind::inaccurate, 2e-3, "the energy is off", Interval{1e-3, 1.5e-3}};
  const std::string words =
      "results up to 1000 us passed every check; first failure between 1000 and 1500 us";
  expect_in(summary_of(paper_case(), result), words);
  expect_in(failure_message(paper_case(), result), words);
  EXPECT_TRUE(sub_impact_table(result).starts_with("inaccurate: " + words));
  EXPECT_TRUE(sub_impact_table(sample_result()).starts_with("  "));
}

TEST(ATolerance, NamesWhatIsReachedUpToWhichHorizonWithReasonAndKey) {
  const std::pair<ToleranceOutcome, std::string> all[] = {
      {{1e-7, true, 0.3e-7, 8e-3, {}, {}, ""}, "within 0.1 us: met to the end (0.03 us reached)"},
      {{1e-6, true, 0.3e-6, 840e-6, Reason{{}, "its mesh is too coarse"}, {}, "model.segments"},
       "met up to 840 us, 2 of 3 sub-impacts|beyond: its mesh is too coarse|free model.segments"},
      {{1e-6, false, 2.5e-6, 8e-3, Reason{{}, "it parts"},
        Reason{Reason::Kind::fixed_key, "model.segments"}, "model.segments"},
       "not met; 3 us reached to the end; it parts|model.segments is fixed by the case|free model"},
      {{1e-6, false, std::numeric_limits<double>::infinity(), 0.0, {}, {}, ""},
       "not met; the error reached is not known"}};
  Result result = sample_result();  // ends: 0.33, 0.6 and, still open, 8 ms
  expect_not_in(summary_of(paper_case(), result), "  tolerance ");
  for (const auto& [wish, words] : all) {
    expect_all_in(tolerance_words(wish, result), words);
    result.tolerance = wish;
    const std::string summary = summary_of(paper_case(), result);
    expect_in(line_of(summary, "tolerance"), tolerance_words(wish, result));
    EXPECT_LT(summary.find("  tolerance "), summary.find("  sub-impacts "));
  }
}

// Of the mesh of the case.
std::string explanation_of(const Case& input) {
  GivenKeys given;
  given.in_file = {"model.segments"};
  return explanation(input, given);
}

TEST(Explanation, TellsUnknownsSymmetrySectionStepTolerancesAndContact) {
  const std::string text = explanation_of(paper_case());
  expect_in(line_of(text, "half_model"), "true");
  expect_in(line_of(text, "n_unknowns"), "251");
  expect_in(line_of(text, "critical_step_s"), "2.8");
  expect_in(text, "contact_stiffness_N_per_m1.5     2.948976e+10", "1.563369e-05", "0.01247394",
            " of a processor", "MB");
}

TEST(Explanation, FollowsTheCase) {
  const auto with = [](const std::vector<std::string>& settings) {
    return explanation_of(paper_case_with(settings));
  };
  expect_in(with({"beam.yield_stress=inf"}), "none: nothing that yields is given");
  expect_in(with({}), "501 cells, one half by symmetry");
  expect_in(with({"model.spacing=points"}), "501 points, one half by symmetry");
  expect_in(line_of(with({"model.symmetry=off"}), "half_model"), "false");
  expect_in(with({"contact.law=line", "beam.poisson=0.33", "contact.yield_pressure=by-depth"}),
            "rigid nose, since contact.striker_modulus is not given; "
            "indentation from the mid-plane; mean pressure by depth\n");
}

TEST(Listings, NameEveryKeyMethodAndTable) {
  const std::string keys = fmt::format("\n{}", key_listing());
  for (const CaseKey& key : case_keys()) expect_in(keys, fmt::format("\n{} ", key.leaf()));
  const std::string methods = method_listing();
  for (const Choice& method : find_case_key("solver.method")->choices) {
    expect_in(methods, fmt::format("  {} ", method.name));
  }
  for (const MethodTable& table : method_tables())
    expect_in(methods, fmt::format(" {} ", table.name));
}

TEST(Listings, OfKeysWithAWordHaveThoseAndNoOthers) {
  const std::string found = key_listing("Yield");
  expect_in(found, "[beam]", "\nyield_stress ", "[contact]", "\nyield_pressure ");
  expect_not_in(found, "\nlength ", "\nwidth ", "[time]");
  std::size_t n_named = 0;
  for (const CaseKey& key : case_keys()) {
    if (key.name.find("yield") == key.name.npos) continue;
    expect_in(found, fmt::format("\n{} ", key.leaf()));
    ++n_named;
  }
  EXPECT_GE(n_named, 3u);
  expect_in(key_listing("stainless"), "\nmaterial ");  // by one of its choices
  EXPECT_EQ(key_listing("unheard-of"), "");
}

}  // namespace
}  // namespace subimpact
