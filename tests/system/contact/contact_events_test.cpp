// Event functions of the contact, and where they cross zero within a step.

#include "system/contact/contact_events.h"
#include "beam_under_test.h"
#include "system/section/section_correction.h"

namespace subimpact {
namespace {

constexpr double unit = 1.56337e-5;  // yield indentation

TEST(EventFunctions, RatesAreThoseOfTheirValuesAlongTheFlow) {
  for (const Model& model : models()) {
    for (const auto& [kind, branch] :
         {std::pair(EventKind::contact_begins, ContactBranch::separated),
          std::pair(EventKind::contact_ends, ContactBranch::elastic),
          std::pair(EventKind::contact_yields, ContactBranch::elastic),
          std::pair(EventKind::contact_unloads, ContactBranch::plastic)}) {
      StruckBeam beam = make_beam(model);
      enter(beam, branch, 2.0 * unit);
      const EventFunction function{kind};
      const State y = smooth_state(beam, 5, 2.0, 3.0 * unit, 4.0);
      const double h = 1e-9;
      const EventValue at = beam.evaluate(function, y);
      const double earlier = beam.evaluate(function, along_the_flow(beam, y, -h)).value;
      const double later = beam.evaluate(function, along_the_flow(beam, y, h)).value;
      EXPECT_NEAR(at.rate, (later - earlier) / (2.0 * h), 1e-5 * std::abs(at.rate))
          << model.name << ", " << to_string(kind);
      EXPECT_NE(at.rate, 0.0);
    }
  }
}

// The indentation over a step is the cubic through these ends.
class ContactCrossing : public testing::Test {
 protected:
  // Puts the contact into a branch, with a given largest indentation.
  void enter(ContactBranch branch, double max_indentation) {
    contact_.set(branch, {max_indentation * unit});
  }
  // At both ends of a step, in yield indentations, and such a step.
  struct Path {
    double from, rate_from, to, rate_to;
  };
  bool find(const Path& path, const std::vector<EventFunction>& without = {}) {
    const double rate = unit / step_;
    const auto found = find_crossing(contact_,
                                     {2.0, 2.0 + step_, path.from * unit, path.rate_from * rate,
                                      path.to * unit, path.rate_to * rate},
                                     {without, true, 1e-18});
    if (found) crossing_ = *found;
    return found.has_value();
  }
  // The estimate, as a part of the step.
  double part() const { return (crossing_.guess - 2.0) / step_; }

  ContactState contact_{make_contact_law(paper_scene())};
  double step_ = 1e-6;
  Crossing crossing_{EventKind::contact_begins};
};

TEST_F(ContactCrossing, IsWhereTheConditionOfTheEventIsMet) {
  using enum EventKind;
  using enum ContactBranch;
  struct Event {
    EventKind kind;
    ContactBranch branch;
    double largest;
    Path path;
    double part, tolerance;
    std::optional<Path> short_of_it;
  };
  // The indentation meets the residual one, exceeds the largest, closes the gap, stops growing.
  const Event events[] = {
      {contact_ends, elastic, 3.0, {2.25, -1.0, 1.25, -1.0}, 0.25, 1e-6, {}},
      {contact_yields, elastic, 0.0, {0.5, 1.0, 1.5, 1.0}, 0.5, 1e-4, Path{0.1, 0.5, 0.6, 0.5}},
      {contact_begins, separated, 3.0, {1.6, 1.0, 2.6, 1.0}, 0.4, 1e-4, Path{1.0, 0.5, 1.5, 0.5}},
      {contact_unloads, plastic, 3.0, {4.0, 3.0, 5.0, -1.0}, 0.75, 1e-6, Path{6.0, 3.0, 8.0, 1.0}}};
  for (const auto& [kind, branch, largest, path, at, tolerance, short_of_it] : events) {
    SCOPED_TRACE(to_string(kind));
    enter(branch, largest);
    ASSERT_TRUE(find(path));
    EXPECT_EQ(crossing_.function.kind, kind);
    EXPECT_FALSE(crossing_.unresolved);
    EXPECT_NEAR(part(), at, tolerance);
    EXPECT_LE(crossing_.t_lower, crossing_.guess);
    EXPECT_GE(crossing_.t_upper, crossing_.guess);
    EXPECT_FALSE(short_of_it && find(*short_of_it));
  }
}

TEST_F(ContactCrossing, ABranchLeftAndRegainedWithinOneStepIsNotMissed) {
  enter(ContactBranch::elastic, 3.0);
  // A parabola that dips by 0.25 at half the step: below the residual 2, barely above, far above.
  ASSERT_TRUE(find({2.1, -1.0, 2.1, 1.0}));
  EXPECT_EQ(crossing_.function.kind, EventKind::contact_ends);
  EXPECT_TRUE(crossing_.unresolved);
  EXPECT_NEAR(part(), 0.5, 1e-5);
  ASSERT_TRUE(find({2.2501, -1.0, 2.2501, 1.0}));
  EXPECT_TRUE(crossing_.unresolved);
  EXPECT_FALSE(find({2.9, -1.0, 2.9, 1.0}));
}

TEST_F(ContactCrossing, TheEarlierOfTwoIsFound) {
  enter(ContactBranch::elastic, 2.1);    // residual 1.1, yields again at 2.1
  const Path path{2.0, 2.0, 1.0, -6.0};  // first up through 2.1, at the end below 1.1
  ASSERT_TRUE(find(path));
  EXPECT_EQ(crossing_.function.kind, EventKind::contact_yields);
  const std::vector<EventFunction> yields{crossing_.function};
  ASSERT_TRUE(find(path, yields));
  EXPECT_EQ(crossing_.function.kind, EventKind::contact_ends);
}

TEST(FirstFlow, IsWhenTheFirstSectionLeavesItsWindow) {
  StruckBeam beam = make_beam(models()[1]);
  const State y0 = smooth_state(beam, 6, 0.6, 0.0, 0.0);
  const State y1 = smooth_state(beam, 6, 1.4, 0.0, 0.0);
  const std::size_t n = beam.n_positions();
  State a = y0, b = y1;  // uniform motion from one to the other
  const double step = 1e-6;
  for (std::size_t i = 0; i < n; ++i) a[n + i] = b[n + i] = (y1[i] - y0[i]) / step;
  beam.commit(a);
  FirstFlow first_flow(beam.sections().size());
  const auto first = first_flow.find(beam, {0.0, step, a, b});
  ASSERT_TRUE(first.has_value());
  EXPECT_NEAR(*first, 0.5 * step, 1e-6 * step);
  EXPECT_FALSE(first_flow.find(beam, {0.0, step, a, a}).has_value());
}

}  // namespace
}  // namespace subimpact
