#include "report/text/uncertain.h"
#include "sample_result.h"
#include "subimpact/report/text.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(SubImpactTable, SetsZonesApartAndMarksAnOpenEndInMicrosecondsMillimetresAndNewtons) {
  const std::string table = sub_impact_table(sample_result());
  expect_in(table, "333.3333", "8796.31", "0.1696389");  // end in us, force in N, indentation in mm
  std::size_t at = 0;                                    // in this order
  for (const char* mark : {"zone 1\n", "sub-zone 2\n", "\nzone 2\n", "(open)"}) {
    at = table.find(mark, at);
    ASSERT_NE(at, std::string::npos) << mark << table;
  }
}

// The line of a table that begins with that number.
std::string row_of(const std::string& table, const std::string& number) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::string first;
    std::istringstream(line) >> first;
    if (first == number) return line;
  }
  ADD_FAILURE() << "no row " << number << " in:\n" << table;
  return {};
}

TEST(SubImpactTable, GivesTimesTheirErrorsAndNoDigitBelow) {
  const std::string table = sub_impact_table(sample_result_with_errors(2));
  std::istringstream words(row_of(table, "1"));
  std::string number, start;
  words >> number >> start;
  EXPECT_EQ(start, "0") << "the first start is exact";
  expect_in(row_of(table, "1"), " 333.333 +- 0.017");
  expect_in(row_of(table, "2"), "500.0 +- 0.3", "600.0   +- 0.3");
  // errors of 0.26 + 0.26 us, 46 N, 5.2e-4 N s, 0.9 um, 0.068 m/s
  expect_in(row_of(table, "2"), " 100.0 ", " 8800", "0.1000");
  expect_not_in(row_of(table, "2"), "0.10000");
  expect_in(row_of(table, "2"), "0.1696 ", "13.05");
  // 0.43 N and 8e-9 m
  expect_in(row_of(table, "1"), " 8796.3 ", "0.169639 ", "13.0500");
}

TEST(SubImpactTable, MarksUncertainRowsAndGivesThemThreeDigitsAndNoErrors) {
  const std::string table = sub_impact_table(sample_result_with_errors(1));
  const std::string second = row_of(table, "2?");
  expect_in(second, " 500.0 ");  // a tenth of the duration's last digit
  expect_in(second, " 600.0 ", " 100 ", " 8800 ", " 0.170 ");
  expect_in(row_of(table, "3?"), " 5000.0 ");
  for (const char* number : {"2?", "3?"}) {
    expect_not_in(row_of(table, number), "+-");
    EXPECT_EQ(row_of(table, number).find('?'), row_of(table, number).rfind('?')) << table;
  }
  expect_in(row_of(table, "1"), "333.333 +- 0.017");
  EXPECT_EQ(row_of(table, "1").find('?'), std::string::npos) << table;
}

// Three uncertain ones in a sub-zone after the certain first one.
Result result_with_many_uncertain() {
  Result result = sample_result_with_errors(1);
  std::vector<SubImpact>& all = result.sub_impacts;
  all[1].peak_force = 1234.5;
  SubImpact next = all[1];
  next.start = 0.61e-3;
  next.end = 0.62e-3;
  next.impulse = 0.02;
  SubImpact last = next;
  last.start = 0.63e-3;
  last.end = 0.66e-3;
  last.peak_force = 2345.6;
  all.insert(all.begin() + 2, {next, last});
  return result;
}

TEST(SubImpactTable, FoldsThreeUncertainRowsInSuccessionIntoTheirSums) {
  const Result result = result_with_many_uncertain();
  const std::string table = sub_impact_table(result);
  expect_in(table, "  2-4? 500.0 to 660.0 us: 3 in this run", "up to 2350 N", "0.140 N s in all");
  for (const char* number : {"2?", "3?", "4?"}) expect_not_in(table, std::string(" ") + number);
  EXPECT_GT(table.find("2-4?"), table.find("sub-zone 2\n"));
  EXPECT_LT(table.find("2-4?"), table.find("zone 2\n   5?"));
  row_of(table, "1");
  row_of(table, "5?");
  const std::string unfolded = sub_impact_table(result, false);
  expect_not_in(unfolded, "2-4?");
  for (const char* number : {"1", "2?", "3?", "4?", "5?"}) row_of(unfolded, number);
}

TEST(SubImpactTable, FoldsNoSumWhoseErrorExceedsIt) {
  Result result = result_with_many_uncertain();
  for (SubImpact& s : result.sub_impacts) s.impulse_error = 0.1;
  result.sub_impacts[3].peak_force_error = 400.0;
  expect_in(sub_impact_table(result), "up to 2300 +- 400 N", "impulse ? (at most 0.5) N s in all");
}

TEST(SubImpactTable, FoldsNeitherTwoUncertainRowsNorThoseOfTwoSubZones) {
  Result two = result_with_many_uncertain();
  two.sub_impacts.erase(two.sub_impacts.begin() + 3);
  for (const char* number : {"2?", "3?", "4?"}) row_of(sub_impact_table(two), number);
  Result apart = result_with_many_uncertain();
  apart.sub_impacts[3].subzone = 3;
  for (const char* number : {"2?", "3?", "4?"}) row_of(sub_impact_table(apart), number);
}

TEST(SubImpactTable, EndsWithTheReasonIfThereMayBeAnotherSubImpactAfterTheLast) {
  const std::string table = sub_impact_table(sample_result_with_an_uncertain_flight(2));
  expect_in(table, "after the last one there may be another");
  EXPECT_TRUE(table.ends_with("there is another one with the same, coarser\n")) << table;
  expect_not_in(table, "3?");
  expect_not_in(sub_impact_table(sample_result_with_an_uncertain_flight(1)), "after the last");
}

TEST(SubImpactTable, WithErrorsLargerThanTheTimesStillHasARowPerSubImpact) {
  Result result = sample_result_with_errors(3);
  for (SubImpact& s : result.sub_impacts) s.start_error = s.end_error = 7.0;
  expect_in(row_of(sub_impact_table(result), "2"), " ? ");
  expect_not_in(row_of(sub_impact_table(result), "2"), "500", "600");
}

TEST(SubImpactTable, HasTheLargerErrorOfTheBodyOfStartAndEndWhereItIsKnown) {
  Result result = sample_result_with_errors(3);
  expect_not_in(sub_impact_table(result), "+- real");
  result.sub_impacts[0].end_body_error = 12.4e-6;
  result.sub_impacts[1].start_body_error = 30e-6;
  result.sub_impacts[1].end_body_error = 20e-6;
  const SubImpactRows rows = sub_impact_rows(result);
  ASSERT_EQ(rows.columns.at(3).name, std::string_view("+- real"));
  EXPECT_EQ(rows.rows[0].cells.at(3), "12");
  EXPECT_EQ(rows.rows[1].cells.at(3), "30");
  EXPECT_EQ(rows.rows[2].cells.at(3), "  ");
}

}  // namespace
}  // namespace subimpact
