#include "subimpact/simulate/records.h"

#include "testing.h"

namespace subimpact {
namespace {

std::vector<SubImpact> sub_impacts(std::initializer_list<std::pair<double, double>> times) {
  std::vector<SubImpact> list;
  for (const auto& [start, end] : times) {
    SubImpact one;
    one.start = start;
    one.end = end;
    list.push_back(one);
  }
  return list;
}

std::vector<std::pair<int, int>> zones(std::vector<SubImpact> list, double zone_gap,
                                       double subzone_gap) {
  assign_zones(list, zone_gap, subzone_gap);
  std::vector<std::pair<int, int>> numbers;
  for (const SubImpact& one : list) numbers.emplace_back(one.zone, one.subzone);
  return numbers;
}

using Numbers = std::vector<std::pair<int, int>>;

TEST(Zones, ALoneSubImpactIsZoneOneSubZoneOne) {
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}}), 10.0, 2.0), (Numbers{{1, 1}}));
}

TEST(Zones, NoSubImpactsMakeNoZones) { EXPECT_TRUE(zones({}, 10.0, 2.0).empty()); }

TEST(Zones, SeparationsShorterThanBothGapsStayTogether) {
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {2.0, 3.0}, {4.5, 5.0}}), 10.0, 2.0),
            (Numbers{{1, 1}, {1, 1}, {1, 1}}));
}

TEST(Zones, ALongerSeparationBeginsASubZoneAndAStillLongerOneAZone) {
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {2.0, 3.0}, {6.0, 7.0}, {20.0, 21.0}, {22.0, 23.0}}),
                  10.0, 2.0),
            (Numbers{{1, 1}, {1, 1}, {1, 2}, {2, 1}, {2, 1}}));
}

TEST(Zones, SubZonesAreNumberedAnewInEveryZone) {
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {5.0, 6.0}, {10.0, 11.0}, {30.0, 31.0}, {35.0, 36.0}}),
                  10.0, 2.0),
            (Numbers{{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}}));
}

TEST(Zones, SeparationIsMeasuredFromEndToStartAndNotFromStartToStart) {
  // Starts 12 apart, but the first contact lasts 11.
  EXPECT_EQ(zones(sub_impacts({{0.0, 11.0}, {12.0, 13.0}}), 10.0, 2.0), (Numbers{{1, 1}, {1, 1}}));
}

TEST(Zones, ASeparationAsLongAsTheGapParts) {
  // Together while separation lasts less than the gap.
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {3.0, 4.0}}), 10.0, 2.0), (Numbers{{1, 1}, {1, 2}}));
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {11.0, 12.0}}), 10.0, 2.0), (Numbers{{1, 1}, {2, 1}}));
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {2.9999999, 4.0}}), 10.0, 2.0),
            (Numbers{{1, 1}, {1, 1}}));
  EXPECT_EQ(zones(sub_impacts({{0.0, 1.0}, {10.9999999, 12.0}}), 10.0, 2.0),
            (Numbers{{1, 1}, {1, 2}}));
}

TEST(Zones, ASubImpactStillOpenAtTheEndHasAZone) {
  std::vector<SubImpact> list = sub_impacts({{0.0, 1.0}, {20.0, 21.0}});
  list.back().end.reset();
  EXPECT_EQ(zones(list, 10.0, 2.0), (Numbers{{1, 1}, {2, 1}}));
}

TEST(EventKinds, EveryKindHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const EventKind kind :
       {EventKind::contact_begins, EventKind::contact_yields, EventKind::contact_unloads,
        EventKind::contact_ends, EventKind::section_reverses}) {
    names.insert(to_string(kind));
  }
  EXPECT_EQ(names.size(), 5u);
  EXPECT_EQ(names.count("unknown"), 0u);
}

}  // namespace
}  // namespace subimpact
