#include "subimpact/io/results.h"
#include "io/records/run_tables.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "print.h"
#include "sample_result.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;
using WriteResults = InADirectory;

using Table = std::vector<std::vector<std::string>>;

Table parse_csv(const std::string& text) {
  Table rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream text_of_row(line + ',');  // an empty cell at the end is one, too
    for (std::string cell; std::getline(text_of_row, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

Case sample_case() { return read_case_file(SUBIMPACT_PAPER_CASE).value; }

nlohmann::json parsed_summary(const Case& input, const Result& result) {
  return nlohmann::json::parse(summary_json(input, result));
}

TEST(EventsCsv, HasTheAgreedColumns) {
  EXPECT_EQ(
      csv_of<SubImpact>({}),
      "index,zone,subzone,start_s,end_s,duration_s,peak_force_N,impulse_Ns,"
      "max_indentation_m,residual_indentation_m,striker_velocity_m_per_s,certain,"
      "probability,start_error_s,end_error_s,start_body_error_s,end_body_error_s,"
      "peak_force_error_N,impulse_error_Ns,max_indentation_error_m,residual_indentation_error_m,"
      "striker_velocity_error_m_per_s,doubt,peak_time_s,opening_m,opening_error_m\n");
}

TEST(EventsCsv, NumbersReadBackAsTheSameDoublesAndAnOpenEndIsEmpty) {
  const Result result = sample_result();
  const Table rows = parse_csv(csv_of<SubImpact>(result));
  ASSERT_EQ(rows.size(), 4u);
  const SubImpact& first = result.sub_impacts[0];
  EXPECT_EQ(rows[1][0], "1");
  EXPECT_EQ(number(rows[1][4]), *first.end);
  EXPECT_EQ(number(rows[1][5]), *first.end - first.start);
  EXPECT_EQ(number(rows[1][6]), first.peak_force);
  EXPECT_EQ(number(rows[1][7]), first.impulse);
  EXPECT_EQ(number(rows[1][8]), first.max_indentation);
  EXPECT_EQ(number(rows[1][9]), first.residual_indentation);
  EXPECT_EQ(number(rows[1][10]), first.striker_velocity);
  EXPECT_EQ(number(rows[1][24]), *first.opening);
  ASSERT_EQ(rows[3].size(), 26u);
  EXPECT_EQ(rows[3][24], "");
  EXPECT_EQ(rows[3][4], "");
  EXPECT_EQ(rows[3][5], "");
  EXPECT_NE(rows[3][6], "");
}

TEST(EventsCsv, HasTheSameColumnsWhetherErrorsAreKnownOrNot) {
  const Table without = parse_csv(csv_of<SubImpact>(sample_result()));
  const Result result = sample_result_with_errors(1);
  const Table with = parse_csv(csv_of<SubImpact>(result));
  EXPECT_EQ(with[0], without[0]);
  ASSERT_EQ(with[0][11], "certain");
  ASSERT_EQ(with[0][13], "start_error_s");
  ASSERT_EQ(with[0][17], "peak_force_error_N");
  for (std::size_t i = 1; i < 4; ++i) {
    const SubImpact& s = result.sub_impacts[i - 1];
    for (std::size_t column = 11; column < 23; ++column) EXPECT_EQ(without[i].at(column), "");
    EXPECT_EQ(with[i][11], i == 1 ? "1" : "0");
    EXPECT_EQ(number(with[i][12]), i == 1 ? 1.0 : 0.75);
    EXPECT_EQ(number(with[i][13]), *s.start_error);
    EXPECT_EQ(number(with[i][17]), *s.peak_force_error);
    EXPECT_EQ(number(with[i][18]), *s.impulse_error);
    EXPECT_EQ(number(with[i][19]), *s.max_indentation_error);
    EXPECT_EQ(number(with[i][20]), *s.residual_indentation_error);
    EXPECT_EQ(number(with[i][21]), *s.striker_velocity_error);
    EXPECT_EQ(with[i][22], i == 1 ? "" : "they part");
    EXPECT_EQ(with[i][24], without[i][24]);
    EXPECT_EQ(number(with[i][25]), s.opening_error.value_or(0.0));
  }
}

TEST(EventsCsv, QuotesTextsWithCommasAndQuotesAndKeepsEachRowOnOneLine) {
  Result result = sample_result_with_errors(2);
  result.sub_impacts[2].doubt = Reason{{}, "it parts, \"then\"\nends"};
  const std::string text = csv_of<SubImpact>(result);
  EXPECT_NE(text.find(",\"it parts, \"\"then\"\" ends\","), text.npos) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
}

TEST(NumbersOfTables, AreTheSameWhateverWasWrittenBefore) {
  std::mt19937 random(1);
  std::vector<double> values = {0.0, 5e-324, 1e-310, 1e23, 1.7976931348623157e308, HUGE_VAL};
  for (int k = 0; k < 3000; ++k) {
    values.push_back(std::ldexp(std::uniform_real_distribution(0.5, 1.0)(random),
                                std::uniform_int_distribution(-30, 30)(random)));
  }
  NumberWriter numbers;
  for (int k = 0; k < 50000; ++k) {
    // Often one of the few written last.
    const std::size_t i = random() % (k % 2 == 0 ? values.size() : 40);
    const double value = random() % 2 == 0 ? values[i] : -values[i];
    const int digits = random() % 2 == 0 ? 17 : 9;
    std::array<char, 32> expected;
    auto end =
        std::to_chars(expected.begin(), expected.end(), value, std::chars_format::general, digits);
    const std::string_view general(expected.data(), end.ptr);
    const auto zeros = general.find_first_of("123456789") - general.find('0');
    const auto size = static_cast<int>(general.size()) - (std::signbit(value) ? 1 : 0);
    if (general.find("0.0") < 2 && size > digits + 2) {  // no leading zeros before all digits
      end = std::to_chars(expected.begin(), expected.end(), value, std::chars_format::scientific,
                          size - static_cast<int>(zeros) - 1);
    }
    std::string text;
    numbers.append(text, value, digits);
    ASSERT_EQ(text, std::string(expected.begin(), end.ptr));
  }
}

TEST(TransitionsCsv, NamesASectionOnlyForASectionsEvent) {
  const Table rows = parse_csv(csv_of<Transition>(sample_result()));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0], (std::vector<std::string>{"time_s", "kind", "section", "value", "spring"}));
  EXPECT_EQ(rows[2][1], to_string(EventKind::contact_yields));
  EXPECT_EQ(rows[2][2], "");
  EXPECT_EQ(rows[3][2], "17");
  EXPECT_EQ(number(rows[3][0]), sample_result().transitions[2].time);
}

TEST(HistoryCsv, HasTheAgreedColumnsAndAsManyInEveryRow) {
  const Table rows = parse_csv(csv_of<HistoryRow>(sample_result()));
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0],
            (std::vector<std::string>{
                "time_s", "force_N",      "indentation_m",  "w_c_m",       "w_m_m",
                "f_c_m",  "u_mf_m",       "v_c_m_per_s",    "v_m_m_per_s", "stress_back_Pa",
                "U_m_J",  "U_k_J",        "U_e_J",          "U_p_J",       "U_c_J",
                "D_c_J",  "energy_error", "momentum_error", "D_b_J",       "R_0_N",
                "R_l_N",  "W_J"}));
  EXPECT_EQ(rows[1].size(), rows[0].size());
  EXPECT_EQ(number(rows[1][0]), 1e-6 / 3.0);
  EXPECT_EQ(number(rows[1][1]), 1822.9000000000001);
  EXPECT_EQ(number(rows[1][17]), -2.2204460492503131e-16);
}

TEST(ColumnListing, NamesAndExplainsEveryColumnOfEveryTable) {
  const std::string listing = column_listing();
  Result result = sample_result();
  result.sub_impacts[0].start_error = 1e-9;
  for_each_run_table([&](const auto& table) {
    const Table rows = parse_csv(csv_heading(table.columns));
    for (const std::string& column : rows[0]) {
      const std::size_t at = listing.find("\n  " + column + " ");
      ASSERT_NE(at, std::string::npos) << column;
      EXPECT_GT(listing.find('\n', at + 1), at + 32) << column << " is not explained";
    }
  });
}

TEST(SummaryJson, EchoesEveryKeyOfTheCase) {
  const auto json = parsed_summary(sample_case(), sample_result());
  for (const CaseKey& key : case_keys()) {
    const auto& table = key.table().empty() ? json.at("case") : json.at("case").at(key.table());
    EXPECT_TRUE(table.contains(key.leaf())) << key.name;
  }
  EXPECT_EQ(json.at("case").at("beam").at("length"), 0.7112);
  EXPECT_EQ(json.at("case").at("beam").at("ends"), (std::vector<std::string>{"free", "free"}));
  EXPECT_EQ(json.at("case").at("solver").at("method"), "erk");
  EXPECT_TRUE(json.at("case").at("solver").at("step").is_null());
  EXPECT_EQ(json.at("case_units").at("beam.length"), "m");
}

TEST(SummaryJson, TellsOutcomeCountsZonesAndCost) {
  const auto json = parsed_summary(sample_case(), sample_result());
  EXPECT_EQ(json.at("outcome").at("kind"), "completed");
  EXPECT_EQ(json.at("outcome").at("time_s"), 8e-3);
  EXPECT_EQ(json.at("counts").at("sub_impacts"), 3);
  EXPECT_EQ(json.at("counts").at("zones"), 2);
  EXPECT_EQ(json.at("counts").at("subzones"), 3);
  EXPECT_EQ(json.at("zones").size(), 2u);
  EXPECT_EQ(json.at("zones")[0].at("end_s"), 0.6e-3);
  EXPECT_TRUE(json.at("zones")[1].at("end_s").is_null());
  EXPECT_EQ(json.at("work").at("steps"), 1234);
  EXPECT_EQ(json.at("work").at("wall_s"), 0.25);
  EXPECT_EQ(json.at("first_yield").at("contact_s"), 1e-6 / 3.0);
  EXPECT_TRUE(json.at("first_yield").at("section_s").is_null());
}

TEST(SummaryJson, GivesTotalsOfTheRunAndOfItsZonesWithTheirErrors) {
  Result result = sample_result_with_errors(2);
  result.error_estimate->totals.at(3).total.error.reset();
  const auto json = parsed_summary(sample_case(), result).at("totals");
  EXPECT_EQ(json.at("sub_impacts").at("value"), 3.0);
  EXPECT_EQ(json.at("sub_impacts").at("error"), 1.0);
  EXPECT_EQ(json.at("peak_force_N").at("value"), result.max_force);
  EXPECT_EQ(json.at("peak_force_N").at("error"), 0.43);
  EXPECT_TRUE(json.at("beam_mean_velocity_m_per_s").at("error").is_null());
  ASSERT_EQ(json.at("by_zone").size(), 2u);
  EXPECT_EQ(json.at("by_zone")[0].at("end_s").at("value"), 0.6e-3);
  EXPECT_EQ(json.at("by_zone")[0].at("end_s").at("error"), 0.26e-6);
  EXPECT_EQ(json.at("by_zone")[1].at("sub_impacts").at("error"), 1.0);
  EXPECT_TRUE(parsed_summary(sample_case(), sample_result()).at("totals").is_null());
}

TEST(SummaryJson, ListsUncertainFlights) {
  const auto json =
      parsed_summary(sample_case(), sample_result_with_an_uncertain_flight(1)).at("error_bars");
  ASSERT_EQ(json.at("uncertain_flights").size(), 1u);
  EXPECT_EQ(json.at("uncertain_flights")[0].at("after_index"), 2);
  EXPECT_EQ(json.at("uncertain_flights")[0].at("reason"),
            "there is another one with the same, coarser");
  EXPECT_EQ(json.at("first_unresolved_index"), 3);
}

TEST(SummaryJson, StaysValidWhenNumbersAreNot) {
  Case input = sample_case();
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  Result result = sample_result();
  result.max_energy_error = std::numeric_limits<double>::quiet_NaN();
  result.used.yield_indentation = std::numeric_limits<double>::infinity();
  const auto json = parsed_summary(input, result);
  EXPECT_EQ(json.at("case").at("beam").at("yield_stress"), "inf");
  EXPECT_TRUE(json.at("conservation").at("max_energy_error_relative").is_null());
  EXPECT_TRUE(json.at("used").at("yield_indentation_m").is_null());
}

TEST_F(WriteResults, LeavesItsFilesAndNothingElse) {
  write_results(directory.path / "new" / "deep", sample_case(), sample_result());
  EXPECT_EQ(names_in(directory.path / "new" / "deep"),
            (std::vector<std::string>{"case.toml", "events.csv", "history.csv", "manifest.json",
                                      "summary.json", "transitions.csv"}));
}

TEST_F(WriteResults, OfRowsAsTheyAreMadeAreThoseOfTheWholeResult) {
  const TemporaryDirectory at_once, as_made;
  Case input = sample_case();
  input.end_time = 3e-4;
  input.output.interval = 1e-7;
  input.output.sections = {0.5, 0.25};
  input.output.points = {0.3};
  const Result whole = simulate(input);
  write_results(at_once.path, input, whole);
  ResultWriter files(as_made.path, input);
  const Result without_rows = simulate(input, {}, nullptr, &files);
  EXPECT_TRUE(without_rows.history.empty());
  EXPECT_EQ(without_rows.n_history_rows, whole.history.size());
  files.finish(input, without_rows);
  EXPECT_TRUE(without_rows.shapes.empty());
  EXPECT_EQ(without_rows.n_shape_rows, whole.shapes.size());
  for (const char* name : {"events.csv", "transitions.csv", "history.csv", "sections.csv",
                           "points.csv", "shapes.csv", "envelope.csv"}) {
    EXPECT_EQ(read_file(as_made.path / name), read_file(at_once.path / name)) << name;
  }
  EXPECT_GT(fs::file_size(as_made.path / "history.csv"), 1'000'000u);
}

}  // namespace
}  // namespace subimpact
