#include "subimpact/io/read_results.h"
#include "io/json_integer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "io/row_thinning.h"
#include "print.h"
#include "read_file.h"
#include "sample_result.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

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

// As a version before manifest.json left the files.
void make_older(const std::filesystem::path& directory, std::string summary, const char* layout) {
  const std::string now = "\"layout\": 4";
  summary.replace(summary.find(now), now.size(), layout);
  std::ofstream(directory / "summary.json") << summary;
  std::filesystem::remove(directory / "manifest.json");
}

TEST(ReadResults, IsTheInverseOfWritingThem) {
  const Case paper =
      read_case_file(SUBIMPACT_PAPER_CASE,
                     {parse_override("time.end=2e-5"), parse_override("output.sections=0.5,0.3"),
                      parse_override("output.points=0.1,0.9")})
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
    EXPECT_EQ(events_csv(run.result), events_csv(result));
    EXPECT_EQ(transitions_csv(run.result.transitions), transitions_csv(result.transitions));
    EXPECT_EQ(history_csv(run.result.history), history_csv(result.history));
    EXPECT_EQ(sections_csv(run.result.section_history), sections_csv(result.section_history));
    EXPECT_EQ(run.result.section_history.empty(), input.output.sections.empty());
    EXPECT_EQ(envelope_csv(run.result.envelope), envelope_csv(result.envelope));
    ASSERT_EQ(run.result.shapes.size(), result.shapes.size());
    const ShapeRow& last = result.shapes.back();
    EXPECT_EQ(run.result.shapes.back().time, last.time);
    EXPECT_NEAR(run.result.shapes.back().velocity, last.velocity, 1e-8 * std::abs(last.velocity));
    EXPECT_EQ(run.result.point_history.size(), input.output.points.size() * result.history.size());
  }
}

TEST(ReadResults, OfLayout3AreReadWithAWarning) {
  const TemporaryDirectory directory;
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  write_results(directory.path, input, sample_result());
  make_older(directory.path, summary_json(input, sample_result()), "\"layout\": 3");
  const FinishedRun run = read_results(directory.path);
  ASSERT_EQ(run.result.warnings.size(), 1u);
  expect_in(run.result.warnings.front(), "without checksums");
}

TEST(ReadResults, RefusesNumbersThatAreNoIntegersWhereIntegersStand) {
  for (const char* number : {"1e300", "-1e300", "0.5", "18446744073709551616"}) {
    EXPECT_THROW(integer<int>(nlohmann::json::parse(number)), std::out_of_range) << number;
  }
  EXPECT_THROW(integer<std::size_t>(nlohmann::json::parse("-1")), std::out_of_range);
  EXPECT_EQ(integer<int>(nlohmann::json::parse("-7")), -7);
  EXPECT_EQ(integer<long>(nlohmann::json::parse("9007199254740993")), 9007199254740993L);
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

TEST(ReadResults, KeepsNearMisses) {
  const TemporaryDirectory directory;
  const Result result = sample_result();
  write_results(directory.path, read_case_text(small_case_text(), "small.toml").value, result);
  const std::vector<NearMiss> read = read_results(directory.path).result.near_misses;
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].time, result.near_misses[i].time);
    EXPECT_EQ(read[i].margin, result.near_misses[i].margin);
    EXPECT_EQ(read[i].kind, result.near_misses[i].kind);
  }
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
  EXPECT_EQ(events_csv(run.result), events_csv(result));
  ASSERT_TRUE(run.result.error_estimate);
  EXPECT_EQ(run.result.error_estimate->first_unresolved, 2u);
  EXPECT_EQ(run.result.error_estimate->reason, "they part");
  ASSERT_EQ(run.result.error_estimate->parts.size(), 1u);
  EXPECT_EQ(run.result.error_estimate->parts.front().name, "mesh");
  EXPECT_EQ(run.result.error_estimate->parts.front().first_unresolved, 2u);
  EXPECT_FALSE(run.result.sub_impacts.back().end);
}

TEST(ReadResults, KeepsAWishAndThatNoneWasMade) {
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  for (const bool met : {true, false}) {
    const TemporaryDirectory directory;
    Result result = sample_result();
    result.wish = WishOutcome{1e-6, met, met ? 3e-7 : infinity, 8.4e-4, "too coarse", "model.mesh"};
    write_results(directory.path, input, result);
    const FinishedRun run = read_results(directory.path);
    ASSERT_TRUE(run.result.wish);
    EXPECT_EQ(run.result.wish->met, met);
    EXPECT_EQ(run.result.wish->wished, 1e-6);
    EXPECT_EQ(run.result.wish->reached, met ? 3e-7 : infinity);
    EXPECT_EQ(run.result.wish->horizon, 8.4e-4);
    EXPECT_EQ(run.result.wish->reason, "too coarse");
    EXPECT_EQ(run.result.wish->key, "model.mesh");
    expect_in(summary_json(input, result), met ? "\"wish_met\": true" : "\"wish_met\": false");
  }
  const TemporaryDirectory directory;
  write_results(directory.path, input, sample_result());
  EXPECT_FALSE(read_results(directory.path).result.wish);
  expect_in(summary_json(input, sample_result()), "\"wish_met\": null");
}

TEST(ReadResults, OfFilesWithoutAWishHaveNone) {
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  const TemporaryDirectory directory;
  write_results(directory.path, input, sample_result());
  std::string text = summary_json(input, sample_result());
  for (const std::string line : {"  \"wish_met\": null,\n", "  \"wish\": null,\n"}) {
    ASSERT_NE(text.find(line), std::string::npos);
    text.erase(text.find(line), line.size());
  }
  make_older(directory.path, text, "\"layout\": 3");
  EXPECT_FALSE(read_results(directory.path).result.wish);
}

TEST(ReadResults, OfOlderTablesLackErrorsAndWhetherSubImpactsAreDecided) {
  const TemporaryDirectory directory;
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  write_results(directory.path, input, sample_result());
  make_older(directory.path, summary_json(input, sample_result()), "\"layout\": 3");
  std::istringstream lines(events_csv(sample_result()));
  std::ofstream older(directory.path / "events.csv");
  for (std::string line; std::getline(lines, line);) {  // as before: the first 11 columns
    std::size_t end = 0;
    for (int k = 0; k < 11; ++k) end = line.find(',', end) + 1;
    older << line.substr(0, end - 1) << '\n';
  }
  older.close();
  const FinishedRun run = read_results(directory.path);
  ASSERT_EQ(run.result.sub_impacts.size(), 3u);
  EXPECT_FALSE(run.result.sub_impacts.front().start_error);
  EXPECT_FALSE(run.result.n_decided());
  EXPECT_EQ(events_csv(run.result), events_csv(sample_result()));
}

TEST(ReadResults, KeepWhichSubImpactsAreDecided) {
  for (const std::size_t n : {0u, 1u, 3u}) {
    const TemporaryDirectory directory;
    const Result result = sample_result_with_errors(n);
    write_results(directory.path, read_case_text(small_case_text(), "small.toml").value, result);
    const FinishedRun run = read_results(directory.path);
    EXPECT_EQ(run.result.n_decided(), n);
    EXPECT_EQ(events_csv(run.result), events_csv(result));
  }
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
  rename("\"refined_run\"", "\"companion\"");
  rename("\"first_unresolved_index\"", "\"first_undecided_index\"");
  make_older(directory.path, text, "\"layout\": 2");
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
  const std::string summary = read_file(directory.path / "summary.json");
  std::filesystem::remove(directory.path / "manifest.json");
  expect_in(refusal_of(directory.path), "has no manifest.json of a run");
  make_older(directory.path, summary, "\"layout\": 3");
  EXPECT_EQ(refusal_of(directory.path), "(accepted)");
  std::ofstream(directory.path / "events.csv") << "index,zone\n1,2\n";
  expect_in(refusal_of(directory.path), "events.csv: has no column subzone");
  std::ofstream(directory.path / "events.csv") << events_csv({});
  std::ofstream(directory.path / "transitions.csv") << "time_s,kind,section,value\n1\n";
  expect_in(refusal_of(directory.path), "transitions.csv:2: has 1 cell where the header has 4");
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

TEST(ReadResults, RefuseFilesThatWereChangedSince) {
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  for (const char* name : {"events.csv", "transitions.csv", "history.csv", "summary.json"}) {
    const TemporaryDirectory directory;
    write_results(directory.path, input, sample_result());
    std::ofstream(directory.path / name, std::ios::app) << " ";
    expect_in(refusal_of(directory.path),
              std::string(name) + ": is not the file that the run wrote (its length or checksum");
    std::filesystem::remove(directory.path / name);
    expect_in(refusal_of(directory.path),
              std::string(name) + ": is not the file that the run wrote");
  }
}

TEST(ReadResults, RefuseTheFilesOfTwoRuns) {
  const Case input = read_case_text(small_case_text(), "small.toml").value;
  const TemporaryDirectory one, other;
  write_results(one.path, input, sample_result());
  Result later = sample_result();
  later.sub_impacts.pop_back();
  write_results(other.path, input, later);
  std::filesystem::copy_file(other.path / "events.csv", one.path / "events.csv",
                             std::filesystem::copy_options::overwrite_existing);
  expect_in(refusal_of(one.path), "events.csv: is not the file that the run wrote");
}

TEST(ReadResults, KeepTheExtremesOfALongHistory) {
  RowThinning<HistoryRow> rows(100'000, 1, {&HistoryRow::force, &HistoryRow::indentation}, 1000);
  for (int i = 0; i < 100'000; ++i) {
    HistoryRow row{};
    row.time = i;
    row.force = i == 54'321 ? 7.0 : 0.0;
    row.indentation = i == 12'345 ? -7.0 : 1.0;
    rows.add(row);
  }
  const std::vector<HistoryRow> kept = rows.take();
  EXPECT_LE(kept.size(), 1100u);
  const auto has = [&](double time) {
    return std::any_of(kept.begin(), kept.end(),
                       [&](const HistoryRow& row) { return row.time == time; });
  };
  for (const double time : {0.0, 12'345.0, 54'321.0, 99'999.0}) EXPECT_TRUE(has(time)) << time;
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end(),
                             [](const auto& a, const auto& b) { return a.time < b.time; }));
}

TEST(ReadResults, KeepTheSectionsOfAnInstantTogether) {
  RowThinning<SectionRow> rows(30'000, 3, {&SectionRow::curvature}, 600);
  for (int i = 0; i < 30'000; ++i) {
    SectionRow row{};
    row.time = i / 3;
    row.position = i % 3;
    row.curvature = i == 20'000 ? 1.0 : 0.0;
    rows.add(row);
  }
  const std::vector<SectionRow> kept = rows.take();
  ASSERT_EQ(kept.size() % 3, 0u);
  EXPECT_LE(kept.size(), 700u);
  bool has_extreme = false;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].position, static_cast<double>(i % 3));
    EXPECT_EQ(kept[i].time, kept[i - i % 3].time);
    has_extreme = has_extreme || kept[i].curvature == 1.0;
  }
  EXPECT_TRUE(has_extreme);
}

}  // namespace
}  // namespace subimpact
