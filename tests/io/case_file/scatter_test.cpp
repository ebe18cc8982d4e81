// [scatter] of a case file.

#include <fmt/format.h>

#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "testing.h"

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

}  // namespace
}  // namespace subimpact
