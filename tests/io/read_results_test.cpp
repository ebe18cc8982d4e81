#include "subimpact/io/read_results.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "print.h"
#include "sample_result.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

std::string refusal_of(const std::filesystem::path& directory) {
  try {
    read_results(directory);
  } catch (const ResultsError& error) {
    return error.what();
  }
  return "(accepted)";
}

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not in: " << text;
}

TEST(ReadResults, IsTheInverseOfWritingThem) {
  const Case paper =
      read_case_file(SUBIMPACT_PAPER_CASE,
                     {parse_override("time.end=2e-5"), parse_override("output.sections=0.5,0.3")})
          .value;
  Case linear = read_case_text(small_case_text(), "small.toml").value;
  linear.scene.contact = {ContactKind::linear, 1e8, {}, {}, {}};
  linear.model.section = SectionKind::elastic;
  linear.solver.method = Method::central_difference;
  Case pinned = linear;
  pinned.scene.beam.ends = {EndSupport::pinned, EndSupport::clamped};
  for (const Case& input : {paper, linear, pinned}) {
    const TemporaryDirectory directory;
    const Result result = simulate(input);
    write_results(directory.path, input, result);
    const FinishedRun run = read_results(directory.path);
    for (const CaseKey& key : case_keys()) {
      EXPECT_EQ(key.get(run.input), key.get(input)) << key.name;
    }
    EXPECT_EQ(summary_json(run.input, run.result), summary_json(input, result));
    EXPECT_EQ(events_csv(run.result.sub_impacts), events_csv(result.sub_impacts));
    EXPECT_EQ(transitions_csv(run.result.transitions), transitions_csv(result.transitions));
    EXPECT_EQ(history_csv(run.result.history), history_csv(result.history));
    EXPECT_EQ(sections_csv(run.result.section_history), sections_csv(result.section_history));
    EXPECT_EQ(run.result.section_history.empty(), input.output.sections.empty());
  }
}

TEST(ReadResults, TakesAKeyUnderTheNameItHadBefore) {
  const TemporaryDirectory directory;
  Case input = read_case_text(small_case_text(), "small.toml").value;
  input.solver.rtol = 3e-7;
  write_results(directory.path, input, sample_result());
  std::string text = summary_json(input, sample_result());
  const std::string key = "\"rtol\"";
  text.replace(text.find(key), key.size(), "\"tolerance\"");
  std::ofstream(directory.path / "summary.json") << text;
  EXPECT_EQ(read_results(directory.path).input.solver.rtol, 3e-7);
}

TEST(ReadResults, KeepsWarningsAndTheFirstFailure) {
  const TemporaryDirectory directory;
  Result result = sample_result();
  result.warnings = {"beam.length is 711.2 m"};
  result.outcome.kind = OutcomeKind::inaccurate;
  result.outcome.first_failure = Interval{1e-3, 2e-3};
  write_results(directory.path, read_case_text(small_case_text(), "small.toml").value, result);
  const FinishedRun run = read_results(directory.path);
  EXPECT_EQ(run.result.warnings, result.warnings);
  ASSERT_TRUE(run.result.outcome.first_failure);
  EXPECT_EQ(run.result.outcome.first_failure->to, 2e-3);
}

TEST(ReadResults, KeepsErrorBarsAndOpenSubImpacts) {
  const TemporaryDirectory directory;
  Result result = sample_result();
  for (SubImpact& s : result.sub_impacts) {
    s.start_error = s.end_error = 1e-9;
    s.error_mesh = 0.9e-9;
    s.start_mesh_limit = s.start + 1e-10;
  }
  result.error_estimate = ErrorEstimate{
      "the same, finer", 2, "they part", 3e-9, {{"mesh", "the same, finer", 2, "they part", 3e-9}}};
  write_results(directory.path, read_case_text(small_case_text(), "small.toml").value, result);
  const FinishedRun run = read_results(directory.path);
  EXPECT_EQ(events_csv(run.result.sub_impacts), events_csv(result.sub_impacts));
  ASSERT_TRUE(run.result.error_estimate);
  EXPECT_EQ(run.result.error_estimate->first_unresolved, 2u);
  EXPECT_EQ(run.result.error_estimate->reason, "they part");
  ASSERT_EQ(run.result.error_estimate->parts.size(), 1u);
  EXPECT_EQ(run.result.error_estimate->parts.front().name, "mesh");
  EXPECT_EQ(run.result.error_estimate->parts.front().first_unresolved, 2u);
  EXPECT_FALSE(run.result.sub_impacts.back().end);
}

TEST(ReadResults, OfLayout2HaveOtherNamesAndTheOppositeMoment) {
  const TemporaryDirectory directory;
  Result result = sample_result();
  result.error_estimate = ErrorEstimate{"the same, finer", 2, "they part", 3e-9, {}};
  result.section_history = {{0.0, 0.3556, 0.1, 25.0, 0.0}};
  Case input = read_case_text(small_case_text(), "small.toml").value;
  input.output.sections = {0.5};
  write_results(directory.path, input, result);
  std::string text = summary_json(input, result);
  const auto rename = [&](const std::string& name, const std::string& before) {
    ASSERT_NE(text.find(name), std::string::npos) << name;
    text.replace(text.find(name), name.size(), before);
  };
  rename("\"layout\": 3", "\"layout\": 2");
  rename("\"refined_run\"", "\"companion\"");
  rename("\"first_unresolved_index\"", "\"first_undecided_index\"");
  std::ofstream(directory.path / "summary.json") << text;
  const FinishedRun run = read_results(directory.path);
  ASSERT_TRUE(run.result.error_estimate);
  EXPECT_EQ(run.result.error_estimate->refined_run, "the same, finer");
  EXPECT_EQ(run.result.error_estimate->first_unresolved, 2u);
  EXPECT_EQ(run.result.section_history.front().moment, -25.0);
}

TEST(ReadResults, SaysWhichFileIsMissingOrSpoilt) {
  const TemporaryDirectory directory;
  expect_in(refusal_of(directory.path / "nowhere"), "nowhere: is not a directory");
  expect_in(refusal_of(directory.path), "summary.json: cannot be read (No such file");
  write_results(directory.path, read_case_text(small_case_text(), "small.toml").value,
                sample_result());
  EXPECT_EQ(refusal_of(directory.path), "(accepted)");
  std::ofstream(directory.path / "events.csv") << "index,zone\n1\n";
  expect_in(refusal_of(directory.path), "events.csv:2: has 1 cell where the header has 2");
  std::ofstream(directory.path / "events.csv") << "index,zone\n1,2\n";
  expect_in(refusal_of(directory.path), "events.csv: has no column subzone");
  std::ofstream(directory.path / "events.csv") << events_csv({});
  std::ofstream(directory.path / "transitions.csv")
      << "time_s,kind,section,value\n0,contact_begins,,0\n1e-6,contact_melts,,0\n";
  expect_in(refusal_of(directory.path), "transitions.csv:3: kind is \"contact_melts\"");
  std::ofstream(directory.path / "transitions.csv") << "time_s,kind,section,value\n,,,\n";
  expect_in(refusal_of(directory.path), "transitions.csv:2: time_s is \"\"; allowed: a number");
  std::ofstream(directory.path / "transitions.csv") << "time_s,kind,section,value\n";
  std::ofstream(directory.path / "events.csv") << events_csv({});
  std::ofstream(directory.path / "summary.json") << "{}";
  expect_in(refusal_of(directory.path), "summary.json: is not the summary of a run");
}

}  // namespace
}  // namespace subimpact
