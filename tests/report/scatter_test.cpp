// [scatter] of a case file, and what runs and studies of it leave: files and tables.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/records/run_tables.h"
#include "print.h"
#include "sample_result.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/results.h"
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

LoadedCase read(const std::string& more, const std::vector<Override>& overrides = {}) {
  return read_case_text(small_case_text() + more, "small.toml", overrides);
}

std::string refusal_of(const std::string& more) {
  return message_of<CaseFileError>([&] { read(more); });
}

using Scatter = std::map<std::string, double>;

TEST(ScatterOfACase, IsReadByTheFullNamesOfItsKeysInEveryFormOfToml) {
  const Scatter expected = {{"beam.thickness", 1e-3}, {"striker.velocity", 0.01}};
  EXPECT_EQ(read("[scatter]\nbeam.thickness = 1e-3\nstriker.velocity = 0.01\n").value.scatter,
            expected);
  EXPECT_EQ(
      read("[scatter]\n\"beam.thickness\" = 1e-3\n\"striker.velocity\" = 0.01\n").value.scatter,
      expected);
  EXPECT_EQ(
      read("[scatter.beam]\nthickness = 1e-3\n[scatter.striker]\nvelocity = 0.01\n").value.scatter,
      expected);
  EXPECT_EQ(read("", {parse_override("scatter.beam.thickness=1e-3"),
                      parse_override("scatter.striker.velocity=0.01")})
                .value.scatter,
            expected);
}

TEST(ScatterOfACase, LeavesTheRestOfTheCaseAsItIs) {
  const Case with = read("[scatter]\nbeam.thickness = 1e-3\n").value;
  const Case without = read("").value;
  for (const CaseKey& key : case_keys()) {
    if (key.name == "scatter.beam.thickness") continue;
    EXPECT_EQ(key.get(with), key.get(without)) << key.name;
  }
}

TEST(ScatterOfACase, IsRefusedOfWhatIsNoNumberOfTheScene) {
  expect_in(refusal_of("[scatter]\nmodel.segments = 0.01\n"), "\"scatter.model\"", "beam.length");
  expect_in(refusal_of("[scatter]\ndensity = 0.01\n"), "did you mean \"scatter.beam.density\"?");
  expect_in(refusal_of("[scater]\n"), "did you mean [scatter]?");
}

TEST(ScatterOfACase, IsRefusedOutsideItsRange) {
  for (const char* value : {"-0.01", "0.6", "inf", "\"1 %\""}) {
    const std::string text = refusal_of(fmt::format("[scatter]\nbeam.length = {}\n", value));
    expect_in(text, "small.toml:14:6: scatter.beam.length is ", "allowed: a number, from 0 to 0.5");
  }
}

TEST(ScatterOfACase, IsRefusedOfAStrikeAtTheCentreOfASymmetricScene) {
  expect_in(refusal_of("[scatter]\nstriker.position = 0.01\n"),
            "scatter.striker.position is 0.01, but the scene is symmetric");
  EXPECT_NO_THROW(
      read("[scatter]\nstriker.position = 0.01\n", {parse_override("striker.position=0.4")}));
}

TEST(ScatterOfACase, IsNotedWhereItHasNoEffect) {
  const std::vector<std::string> notes =
      read("[scatter]\nbeam.yield_stress = 0.01\nstriker.gap = 0.1\ncontact.stiffness = 0.1\n")
          .notes();
  const std::vector<std::string> expected = {
      "scatter.beam.yield_stress = 0.01 has no effect with beam.yield_stress = inf",
      "scatter.striker.gap = 0.1 has no effect with striker.gap = 0",
      "scatter.contact.stiffness = 0.1 has no effect with contact.stiffness = (not given)"};
  EXPECT_EQ(notes, expected);
}

Result predicted() {
  Result result = sample_result_with_errors(2);
  result.sub_impacts[0].start_scatter = 0.0;
  result.sub_impacts[0].end_scatter = 1.63e-6;
  result.sub_impacts[1].start_scatter = 2.5e-6;
  result.sub_impacts[1].end_scatter = 3e-6;
  result.predictability = Predictability{
      1,
      "its start scatters",
      1.0 / 3.0 * 1e-3,
      1.63e-6,
      {{0.0, 3e-6, 1e-4}, {{}, {}, {}}},
      0.012,
      {{"peak_force_N", 900.0, 12.0, 880.0, 921.0}, {"permanent_set_m", 0.0, 0.0, 0.0, 0.0}},
      64,
      "101 cells"};
  return result;
}

TEST(Predictability, IsInTheSummaryOfARunWithScatterAlone) {
  const Case input = read("").value;
  const auto summary = nlohmann::json::parse(summary_json(input, predicted()));
  EXPECT_EQ(summary.at("predictability").at("first_unpredictable_index"), 2);
  EXPECT_EQ(summary.at("predictability").at("zones").at(0).at("end_scatter_s"), 3e-6);
  EXPECT_TRUE(
      nlohmann::json::parse(summary_json(input, sample_result())).at("predictability").is_null());
}

TEST(Predictability, IsPrintedWithTheReasonWhereItEnds) {
  const std::string table = scatter_table(predicted());
  expect_in(table, "333.3 +- 1.7", "from here on not predictable: its start scatters\n", "zone 1");
  expect_in(predictability_words(predicted()), "1 of 3 sub-impacts, up to 333.3 us");
  Result result = predicted();
  make_answers(read("").value, result);
  expect_in(run_summary(read("").value, result), "predictable", "scatter: force", "900 +- 12 N");
}

TEST(Samples, ArePrintedWithTheirNumberAndMeshAndWithoutWhatThereIsNot) {
  const std::vector<LabelledText> answers = scatter_answers(predicted());
  ASSERT_EQ(answers.size(), 1u);  // there is no permanent set
  EXPECT_EQ(answers[0].label, "scatter: force");
  EXPECT_EQ(answers[0].text, "900 +- 12 N");
  expect_in(answers[0].note, "from 880 to 921", "64 runs on 101 cells");
}

Sensitivity sample_study() {
  Sensitivity study;
  study.base = sample_result();
  study.keys = {"striker.velocity", "beam.thickness"};
  study.rows = {
      {EventQuantity::start, 0, 0.0, {Derivative{}, Derivative{}}, ""},
      {EventQuantity::end,
       0,
       1e-3 / 3.0,
       {Derivative{1.654e-6, 0x1p-32}, std::nullopt},
       "merges, splits or vanishes within the shifts of beam.thickness"},
      {EventQuantity::peak_force, 1, 8796.25, {Derivative{-12.5, 0.5}, Derivative{2.0, 0.25}}, ""}};
  return study;
}

TEST(SensitivityCsv, HasARowPerNumberAndTwoColumnsPerKey) {
  EXPECT_EQ(sensitivity_csv(sample_study()),
            "quantity,sub_impact,value,d_striker.velocity,error_striker.velocity,d_beam.thickness,"
            "error_beam.thickness,flag\n"
            "start_s,1,0,0,0,0,0,\n"
            "end_s,1,0.00033333333333333332,1.654e-06,2.3283064365386963e-10,,,merges; splits or "
            "vanishes within the "
            "shifts of beam.thickness\n"
            "peak_force_N,2,8796.25,-12.5,0.5,2,0.25,\n");
}

TEST(SensitivityTable, ShowsMicrosecondsPerPercentWithTheDigitsOfTheErrors) {
  const std::string table = sensitivity_table(sample_study());
  expect_in(table, "333.3333  0.016540         -  ! merges, splits or vanishes", "velocity");
  expect_not_in(table, "start");
}

}  // namespace
}  // namespace subimpact
