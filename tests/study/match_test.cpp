#include "subimpact/study/match.h"

#include "testing.h"

namespace subimpact {
namespace {

std::vector<SubImpact> sub_impacts(const std::vector<std::pair<double, double>>& times) {
  std::vector<SubImpact> list;
  for (const auto& [start, end] : times) {
    list.push_back({});
    list.back().start = start;
    list.back().end = end;
  }
  return list;
}

using Pairs = std::vector<std::pair<int, int>>;

Pairs match(const std::vector<std::pair<double, double>>& a,
            const std::vector<std::pair<double, double>>& b) {
  Pairs pairs;
  for (const MatchedPair& pair : match_sub_impacts(sub_impacts(a), sub_impacts(b))) {
    pairs.push_back({pair.first ? static_cast<int>(*pair.first) : -1,
                     pair.second ? static_cast<int>(*pair.second) : -1});
  }
  return pairs;
}

TEST(MatchedSubImpacts, CorrespondOneToOneWhereTheyOverlap) {
  EXPECT_EQ(match({{0, 10}, {20, 25}}, {{0, 10.2}, {19.8, 25}}), (Pairs{{0, 0}, {1, 1}}));
}

TEST(MatchedSubImpacts, ShowOneThatOnlyTheFirstOrTheSecondRunHas) {
  EXPECT_EQ(match({{0, 10}, {12, 13}, {20, 25}}, {{0, 10}, {20, 25}}),
            (Pairs{{0, 0}, {1, -1}, {2, 1}}));
  EXPECT_EQ(match({{0, 10}, {20, 25}}, {{0, 10}, {12, 13}, {20, 25}}),
            (Pairs{{0, 0}, {-1, 1}, {1, 2}}));
  EXPECT_EQ(match({}, {{0, 1}}), (Pairs{{-1, 0}}));
}

TEST(MatchedSubImpacts, DoNotTakeOneOfTwoHalvesForTheWhole) {
  const Pairs pairs = match({{0, 10}, {20, 40}}, {{0, 10}, {20, 29}, {31, 40}});
  EXPECT_EQ(pairs.size(), 3u);
  const auto list = match_sub_impacts(sub_impacts({{0, 10}, {20, 40}}),
                                      sub_impacts({{0, 10}, {20, 29}, {31, 40}}));
  EXPECT_LE(n_leading_matches(list), 2u);
}

TEST(MatchedSubImpacts, CountTheLeadingOnesUpToTheFirstOddOne) {
  const auto list = match_sub_impacts(sub_impacts({{0, 1}, {2, 3}, {4, 5}, {6, 7}}),
                                      sub_impacts({{0, 1}, {2, 3}, {6, 7}}));
  EXPECT_EQ(n_leading_matches(list), 2u);
}

TEST(MatchedSubImpacts, PairTwoThatAreStillOpenAtTheEnd) {
  auto a = sub_impacts({{0, 1}, {2, 3}});
  auto b = sub_impacts({{0, 1}, {2.1, 3}});
  a.back().end.reset();
  b.back().end.reset();
  EXPECT_EQ(n_leading_matches(match_sub_impacts(a, b)), 2u);
}

}  // namespace
}  // namespace subimpact
