#include "subimpact/case/case_keys.h"

#include "refusal.h"
#include "small_case.h"
#include "subimpact/io/case_file.h"
#include "testing.h"

namespace subimpact {
namespace {

Case small_case() { return read_case_text(small_case_text(), "small.toml").value; }

std::string refused_key(const Case& input) {
  return refusal_of([&] { check(input); }).key;
}

TEST(CaseKeys, HaveNamesThatDiffer) {
  std::set<std::string> names;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_EQ(find_case_key(key.name), &key);
    EXPECT_EQ(key.table().empty() ? key.leaf() : key.table() + "." + key.leaf(), key.name);
  }
}

TEST(CaseKeys, SayWhatTheyMeanAndEitherHaveADefaultOrAreRequired) {
  for (const CaseKey& key : case_keys()) {
    EXPECT_FALSE(key.meaning.empty()) << key.name;
    EXPECT_FALSE(allowed_values(key).empty()) << key.name;
    EXPECT_EQ(key.required, key.default_text.empty()) << key.name;
  }
}

TEST(CaseKeys, AcceptEachOfTheirOwnChoices) {
  for (const CaseKey& key : case_keys()) {
    for (const Choice& choice : key.choices) {
      Case target = small_case();
      const KeyValue value = key.type == KeyType::pair
                                 ? KeyValue(std::vector<std::string>{choice.name, choice.name})
                                 : KeyValue(choice.name);
      assign(target, key, value);
      EXPECT_EQ(key.get(target), value) << key.name << " = " << choice.name;
    }
  }
}

TEST(CaseKeys, RefuseNotANumberEverywhereAndInfinityButForStressesAndModuliWithALimit) {
  // inf: never yields; rigid.
  const std::set<std::string> without_limit = {"beam.yield_stress", "contact.striker_modulus"};
  for (const CaseKey& key : case_keys()) {
    if (key.type != KeyType::number) continue;
    EXPECT_TRUE(problem_with(key, std::numeric_limits<double>::quiet_NaN())) << key.name;
    EXPECT_EQ(problem_with(key, std::numeric_limits<double>::infinity()).has_value(),
              !without_limit.contains(key.name))
        << key.name;
  }
}

TEST(CaseKeys, LeaveTheCaseAsItWasWhenTheyRefuse) {
  Case target = small_case();
  const CaseKey& key = *find_case_key("beam.length");
  EXPECT_THROW(assign(target, key, -1.0), InvalidCase);
  EXPECT_EQ(target.scene.beam.length, 0.7112);
}

TEST(CheckOfACase, AcceptsTheSmallCase) { EXPECT_NO_THROW(check(small_case())); }

TEST(CheckOfACase, NamesTheFirstKeyThatIsNotAllowed) {
  Case input = small_case();
  input.solver.rtol = std::nan("");
  EXPECT_EQ(refused_key(input), "solver.rtol");
  input.scene.striker.mass = 0.0;
  EXPECT_EQ(refused_key(input), "striker.mass");
}

TEST(CheckOfACase, LooksAtSettingsThatMayBeLeftOpenOnlyIfTheyAreNot) {
  Case input = small_case();
  input.solver.step = std::nullopt;
  EXPECT_EQ(refused_key(input), "");
  input.solver.step = -1e-7;
  EXPECT_EQ(refused_key(input), "solver.step");
}

TEST(CheckOfACase, RefusesANegativeNumberOfSegments) {
  Case input = small_case();
  input.model.segments = -501;
  EXPECT_EQ(refused_key(input), "model.segments");
}

TEST(CheckOfACase, IsMadeBeforeARunAndAnExplanation) {
  Case input = small_case();
  input.scene.beam.width = 0.0;
  EXPECT_THROW(simulate(input), InvalidCase);
  EXPECT_THROW(resolve(input), InvalidCase);
}

TEST(NearestName, IsTheOneASlipAway) {
  const std::vector<std::string> names = {"length", "width", "thickness"};
  EXPECT_EQ(nearest_name("lenght", names), "length");
  EXPECT_EQ(nearest_name("widht", names), "width");
  EXPECT_EQ(nearest_name("thicknes", names), "thickness");
}

TEST(NearestName, IsEmptyForAnotherWord) {
  EXPECT_EQ(nearest_name("colour", {"length", "width"}), "");
  EXPECT_EQ(nearest_name("", {"length"}), "");
}

}  // namespace
}  // namespace subimpact
