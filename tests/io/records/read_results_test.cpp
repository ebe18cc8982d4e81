#include <fmt/format.h>

#include "case_with.h"
#include "io/records/record.h"
#include "io/records/row_thinning.h"
#include "io/records/run_tables.h"
#include "print.h"
#include "reseal.h"
#include "sample_result.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "subimpact/simulate/error.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string refusal_of(const std::filesystem::path& directory) {
  return answer_of<ResultsError>([&] { read_results(directory); });
}

Case small_case() { return read_case_text(small_case_text(), "small.toml").value; }

TEST(ReadResults, IsTheInverseOfWritingThem) {
  const Case paper =
      paper_case_with({"time.end=2e-5", "output.sections=0.5,0.3", "output.points=0.1,0.9",
                       "output.gauges=[{position=0.3}, {position='0.5 m', face='front'}]"});
  Case linear = small_case();
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
    EXPECT_EQ(csv_of<SubImpact>(run.result), csv_of<SubImpact>(result));
    EXPECT_EQ(csv_of<Transition>(run.result), csv_of<Transition>(result));
    EXPECT_EQ(csv_of<HistoryRow>(run.result), csv_of<HistoryRow>(result));
    EXPECT_EQ(csv_of<SectionRow>(run.result), csv_of<SectionRow>(result));
    EXPECT_EQ(run.result.section_history.empty(), input.output.sections.empty());
    ASSERT_EQ(run.result.history.size(), result.history.size());
    for (std::size_t i = 0; i < result.history.size(); ++i) {
      EXPECT_EQ(run.result.history[i].gauge_strains, result.history[i].gauge_strains);
    }
    EXPECT_EQ(result.history.back().gauge_strains.size(), input.output.gauges.size());
    EXPECT_EQ(csv_of<EnvelopeRow>(run.result), csv_of<EnvelopeRow>(result));
    ASSERT_EQ(run.result.shapes.size(), result.shapes.size());
    const ShapeRow& last = result.shapes.back();
    EXPECT_EQ(run.result.shapes.back().time, last.time);
    EXPECT_NEAR(run.result.shapes.back().velocity, last.velocity, 1e-8 * std::abs(last.velocity));
    EXPECT_EQ(run.result.point_history.size(), input.output.points.size() * result.history.size());
  }
}

TEST(ReadResults, RefusesNumbersThatAreNoIntegersWhereIntegersStand) {
  for (const char* number : {"1e300", "-1e300", "0.5", "18446744073709551616"}) {
    EXPECT_THROW(integer<int>(nlohmann::json::parse(number)), std::out_of_range) << number;
  }
  EXPECT_THROW(integer<std::size_t>(nlohmann::json::parse("-1")), std::out_of_range);
  EXPECT_EQ(integer<int>(nlohmann::json::parse("-7")), -7);
  EXPECT_EQ(integer<long>(nlohmann::json::parse("9007199254740993")), 9007199254740993L);
}

// A result written with the small case and read back.
FinishedRun written_and_read(const Result& result) {
  const TemporaryDirectory directory;
  const Case input = small_case();
  write_results(directory.path, input, result);
  FinishedRun run = read_results(directory.path);
  EXPECT_EQ(summary_json(run.input, run.result), summary_json(input, result));
  EXPECT_EQ(csv_of<SubImpact>(run.result), csv_of<SubImpact>(result));
  return run;
}

TEST(ReadResults, KeepsWarningsFailuresNearMissesAndTheClosestApproach) {
  Result result = sample_result();
  result.warnings = {"beam.length is 711.2 m"};
  result.outcome.kind = OutcomeKind::inaccurate;
  result.outcome.first_failure = Interval{1e-3, 2e-3};
  for (const bool is_over : {true, false}) {
    result.contact_over = is_over;
    result.closest_approach = ClosestApproach{6e-3, 2.1e-8 / 3.0, {}};
    if (is_over) result.closest_approach->error = 1e-9 / 3.0;
    const Result read = written_and_read(result).result;
    EXPECT_EQ(read.warnings, result.warnings);
    ASSERT_TRUE(read.outcome.first_failure);
    EXPECT_EQ(read.outcome.first_failure->to, 2e-3);
    EXPECT_EQ(read.contact_over, is_over);
    ASSERT_TRUE(read.closest_approach.has_value());
    EXPECT_EQ(read.closest_approach->time, result.closest_approach->time);
    EXPECT_EQ(read.closest_approach->gap, result.closest_approach->gap);
    EXPECT_EQ(read.closest_approach->error, result.closest_approach->error);
    ASSERT_EQ(read.near_misses.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(read.near_misses[i].time, result.near_misses[i].time);
      EXPECT_EQ(read.near_misses[i].margin, result.near_misses[i].margin);
      EXPECT_EQ(read.near_misses[i].kind, result.near_misses[i].kind);
    }
  }
}

TEST(ReadResults, KeepsAWishAndThatNoneWasMade) {
  Result result = sample_result();
  for (const bool met : {true, false}) {
    result.tolerance = ToleranceOutcome{
        1e-6, met, met ? 3e-7 : infinity, 8.4e-4, Reason{{}, "too coarse"}, {}, "model.mesh"};
    const FinishedRun run = written_and_read(result);
    ASSERT_TRUE(run.result.tolerance);
    EXPECT_EQ(run.result.tolerance->met, met);
    EXPECT_EQ(run.result.tolerance->asked, 1e-6);
    EXPECT_EQ(run.result.tolerance->reached, met ? 3e-7 : infinity);
    EXPECT_EQ(run.result.tolerance->horizon, 8.4e-4);
    EXPECT_EQ(words_of(run.result.tolerance->reason), "too coarse");
    EXPECT_EQ(run.result.tolerance->key, "model.mesh");
    expect_in(summary_json(run.input, result), met ? "\"wish_met\": true" : "\"wish_met\": false");
  }
  const FinishedRun run = written_and_read(sample_result());
  EXPECT_FALSE(run.result.tolerance);
  expect_in(summary_json(run.input, run.result), "\"wish_met\": null");
}

TEST(ReadResults, KeepWhichSubImpactsAreCertainWithTheirErrors) {
  for (const std::size_t n : {0u, 1u, 3u}) {
    Result result = sample_result_with_errors(n);
    for (SubImpact& s : result.sub_impacts) s.start_mesh_limit = s.start + 1e-10;
    const Result read = written_and_read(result).result;
    EXPECT_EQ(read.n_certain(), n);
    EXPECT_EQ(read.all_certain(), n == 3);
    ASSERT_EQ(read.sub_impacts.size(), 3u);
    EXPECT_FALSE(read.sub_impacts.back().end);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(read.sub_impacts[i].certain, i < n);
      EXPECT_EQ(read.sub_impacts[i].probability, i < n ? 1.0 : 0.75);
      EXPECT_EQ(words_of(read.sub_impacts[i].doubt), i < n ? "" : "they part");
      EXPECT_EQ(read.sub_impacts[i].impulse_error, result.sub_impacts[i].impulse_error);
    }
    ASSERT_TRUE(read.error_estimate);
    const ErrorEstimate::Part& part = read.error_estimate->parts.at(0);
    EXPECT_EQ(part.source, ErrorSource::mesh);
    for (const auto& unresolved : {part.first_unresolved, read.error_estimate->first_unresolved}) {
      EXPECT_EQ(unresolved, n < 3 ? std::optional(n) : std::nullopt);
    }
    EXPECT_EQ(words_of(read.error_estimate->reason), n < 3 ? "they part" : "");
  }
}

TEST(ReadResults, KeepTotalsZonesAndUncertainFlights) {
  Result result = sample_result_with_an_uncertain_flight(1);
  result.error_estimate->totals.at(2).total.error.reset();
  const FinishedRun run = written_and_read(result);
  ASSERT_TRUE(run.result.error_estimate);
  const ErrorEstimate& read = *run.result.error_estimate;
  const ErrorEstimate& written = *result.error_estimate;
  ASSERT_EQ(read.uncertain_flights.size(), 1u);
  EXPECT_EQ(read.uncertain_flights.front().after, 1u);
  EXPECT_EQ(words_of(read.uncertain_flights.front().reason),
            words_of(written.uncertain_flights.front().reason));
  ASSERT_EQ(read.totals.size(), written.totals.size());
  for (std::size_t i = 0; i < read.totals.size(); ++i) {
    EXPECT_EQ(read.totals[i].name, written.totals[i].name);
    EXPECT_EQ(read.totals[i].total.value, written.totals[i].total.value);
    EXPECT_EQ(read.totals[i].total.error, written.totals[i].total.error);
  }
  ASSERT_EQ(read.zones.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    for (const auto member :
         {&ZoneTotals::start, &ZoneTotals::end, &ZoneTotals::impulse, &ZoneTotals::sub_impacts}) {
      EXPECT_EQ((read.zones[k].*member).value, (written.zones[k].*member).value);
      EXPECT_EQ((read.zones[k].*member).error, (written.zones[k].*member).error);
    }
  }
}

TEST(ReadResults, SaysWhichFileIsMissingOrSpoilt) {
  const TemporaryDirectory directory;
  expect_in(refusal_of(directory.path / "nowhere"), "nowhere: is not a directory");
  expect_in(refusal_of(directory.path), "summary.json: cannot be read (No such file");
  write_results(directory.path, small_case(), sample_result());
  EXPECT_EQ(refusal_of(directory.path), "(accepted)");
  const std::string summary = read_file(directory.path / "summary.json");
  const auto refusal_with = [&](const char* name, const std::string& text) {
    const std::string before = read_file(directory.path / name);
    std::ofstream(directory.path / name) << text;
    reseal(directory.path);
    const std::string refusal = refusal_of(directory.path);
    std::ofstream(directory.path / name) << before;
    return refusal;
  };
  expect_in(refusal_with("events.csv", "index,zone\n1,2\n"), "events.csv: has no column subzone");
  const std::string heading = "time_s,kind,section,value\n";
  expect_in(refusal_with("transitions.csv", heading + "1\n"),
            "transitions.csv:2: has 1 cell where the header has 4");
  expect_in(refusal_with("transitions.csv", heading + "0,contact_begins,,0\n1,contact_melts,,0\n"),
            "transitions.csv:3: kind is \"contact_melts\"");
  expect_in(refusal_with("transitions.csv", heading + ",,,\n"),
            "transitions.csv:2: time_s is \"\"; allowed: a finite number");
  expect_in(refusal_with("summary.json", "{}"), "summary.json: is not the summary of a run");
  std::string older = summary;
  const std::string layout = fmt::format("\"layout\": {}", summary_layout);
  older.replace(older.find(layout), layout.size(), "\"layout\": 3");
  expect_in(refusal_with("summary.json", older), "summary.json: has layout 3, but this program");
  std::filesystem::remove(directory.path / "manifest.json");
  expect_in(refusal_of(directory.path), "has no manifest.json of a run");
}

TEST(ReadResults, RefuseFilesThatWereChangedSince) {
  for (const std::string name : {"events.csv", "transitions.csv", "history.csv", "summary.json"}) {
    const TemporaryDirectory directory;
    write_results(directory.path, small_case(), sample_result());
    std::ofstream(directory.path / name, std::ios::app) << " ";
    expect_in(refusal_of(directory.path), name + ": is not the file that the run wrote",
              "checksum");
    std::filesystem::remove(directory.path / name);
    expect_in(refusal_of(directory.path), name + ": is not the file that the run wrote");
  }
}

TEST(ReadResults, RefuseTheFilesOfTwoRuns) {
  const TemporaryDirectory one, other;
  write_results(one.path, small_case(), sample_result());
  Result later = sample_result();
  later.sub_impacts.pop_back();
  write_results(other.path, small_case(), later);
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
  for (const double time : {0.0, 12'345.0, 54'321.0, 99'999.0}) {
    EXPECT_EQ(std::ranges::count(kept, time, &HistoryRow::time), 1) << time;
  }
  EXPECT_TRUE(std::ranges::is_sorted(kept, {}, &HistoryRow::time));
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
