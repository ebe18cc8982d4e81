// A striker that starts at a distance from the beam.

#include "paper_case.h"

namespace subimpact {
namespace {

struct Strike {
  const char* name;
  Method method;
  SectionKind section;
  std::optional<EventHandling> events;
};

std::ostream& operator<<(std::ostream& out, const Strike& strike) { return out << strike.name; }

class AGap : public testing::TestWithParam<Strike> {};

const Strike strikes[] = {
    {"erk", Method::erk, SectionKind::exact, {}},
    {"nystrom", Method::nystrom, SectionKind::exact, {}},
    {"exponential", Method::exponential, SectionKind::elastic, {}},
    {"exponential_yielding", Method::exponential, SectionKind::exact, {}},
    {"dirk", Method::dirk, SectionKind::elastic, {}},
    {"adams", Method::adams, SectionKind::elastic, {}},
    {"bdf", Method::bdf, SectionKind::elastic, {}},
    {"central_difference", Method::central_difference, SectionKind::exact, {}},
    {"erk_library", Method::erk, SectionKind::elastic, EventHandling::library}};
INSTANTIATE_TEST_SUITE_P(, AGap, testing::ValuesIn(strikes), NamedAsPrinted{});

Case strike_of(const Strike& strike) {
  Case input = paper_case(strike.section, 0.4e-3, 101, strike.method);
  input.solver.events = strike.events;
  input.solver.rtol = 1e-7;
  return input;
}

TEST_P(AGap, ShiftsTheTableOfSubImpactsByTheFlightToRounding) {
  const double gap = 0.003;
  const Case touching = strike_of(GetParam());
  const double flight = gap / touching.scene.striker.velocity;
  Case apart = touching;
  apart.scene.striker.gap = gap;
  apart.end_time += flight;
  const Result expected = simulate(touching);
  const Result shifted = completed(apart);
  ASSERT_EQ(shifted.sub_impacts.size(), expected.sub_impacts.size());
  ASSERT_GE(expected.sub_impacts.size(), 3u);
  EXPECT_EQ(shifted.sub_impacts[0].start, flight);
  // s, grown from contact to contact; the library's own root-finding stops at 100 roundings.
  const bool is_library = GetParam().events == EventHandling::library;
  const double rounding = is_library ? 1e-11 : 1e-13;
  const double relative = is_library ? 1e-6 : 1e-8;
  for (std::size_t i = 0; i < expected.sub_impacts.size(); ++i) {
    const SubImpact& a = expected.sub_impacts[i];
    const SubImpact& b = shifted.sub_impacts[i];
    EXPECT_NEAR(b.start - flight, a.start, rounding) << i;
    ASSERT_EQ(b.end.has_value(), a.end.has_value());
    if (a.end) {
      EXPECT_NEAR(*b.end - flight, *a.end, rounding) << i;
    }
    EXPECT_NEAR(b.peak_force, a.peak_force, relative * a.peak_force) << i;
    EXPECT_NEAR(b.impulse, a.impulse, relative * a.impulse) << i;
    EXPECT_NEAR(b.max_indentation, a.max_indentation, relative * a.max_indentation) << i;
    EXPECT_EQ(b.zone, a.zone);
    EXPECT_EQ(b.subzone, a.subzone);
  }
}

TEST(AStrikerThatStartsApart, IsRefusedWhereItDoesNotReachTheBeamBeforeTheEnd) {
  Case input = paper_case(SectionKind::elastic, 1e-3);
  input.scene.striker.gap = 0.0159;
  expect_refused(input, "striker.gap", "below 0.0159 m");
}

}  // namespace
}  // namespace subimpact
