// Event times are as accurate as the method, when they are located by the method itself.

#include "lumped.h"
#include "order_table.h"
#include "print.h"

namespace subimpact {
namespace {

// An impact on the residual of an earlier one: between begin and end the force is smooth.
struct SmoothImpact {
  static TwoBodies bodies() {
    TwoBodies bodies;
    bodies.yield_indentation = 1e-4;
    bodies.velocity = 0.2;
    bodies.target_mass = 0.4;  // and a spring: unloading does not mirror loading
    bodies.spring = 3e6;
    return bodies;
  }
  static constexpr double largest = 4e-4;
  static constexpr double residual = 3e-4;

  // The end of the contact that begins at t = 0.
  static double end(const Way& way) {
    StruckBeam beam = bodies().make(way.in_modes());
    beam.contact().set(ContactBranch::elastic, {largest});
    const auto integrator = way.make(beam);
    struct Ends final : RunObserver {
      double time = 0.0;
      void on_step(const ObservedStep&, StruckBeam&) override {}
      void before_event(const Transition& event, const State&, StruckBeam&) override {
        if (event.kind == EventKind::contact_ends) time = event.time;
      }
      void after_event(const Transition&, const State&, StruckBeam&) override {}
    } observer;
    const State from = in_unknowns_of(beam, {0.0, residual, -0.05, bodies().velocity});
    Audit audit(beam, from);
    EventLoop loop(beam, *integrator, observer, audit,
                   {1.0, way.events, std::numeric_limits<double>::infinity(), 1e30});
    loop.start_from(from);
    while (observer.time == 0.0) loop.advance();
    return observer.time;
  }
};

double exact_end() { return SmoothImpact::end({"dprkn12", 1e-14, {}, EventHandling::located}); }

struct Order {
  const char* table;
  EventHandling events;
  int coarsest;  // steps a contact
  double low, high;
};

void PrintTo(const Order& order, std::ostream* out) {
  constexpr const char* names[] = {"located", "interpolated", "library"};
  *out << order.table << '_' << names[static_cast<int>(order.events)];
}

class EventTimes : public testing::TestWithParam<Order> {};

TEST_P(EventTimes, HaveTheExpectedOrderInTheStep) {
  const Order& expected = GetParam();
  const double exact = exact_end();
  OrderTable table("error of the contact's end, s, over halvings of the step");
  for (const double refined : {1.0, 2.0, 4.0}) {
    // The contact's end falls inside a step, always at the same part of it.
    const double steps = expected.coarsest * refined + 0.37;
    const Way way{expected.table, 1e-12, exact / steps, expected.events};
    table.add(refined, std::abs(SmoothImpact::end(way) - exact));
  }
  table.print();
  table.expect_overall_order_within(expected.low, expected.high);
}

constexpr EventHandling located = EventHandling::located;
constexpr EventHandling interpolated = EventHandling::interpolated;
constexpr EventHandling library = EventHandling::library;

INSTANTIATE_TEST_SUITE_P(
    , EventTimes,
    testing::Values(
        Order{"bogacki-shampine", located, 80, 2.7, 3.4},
        Order{"dormand-prince", located, 96, 4.5, 5.5}, Order{"dop853", located, 8, 7.3, 8.9},
        Order{"dirk:esdirk547", located, 24, 4.5, 5.5}, Order{"dprkn8", located, 12, 7.3, 8.9},
        // Its force is a cubic within a step, its second integral of order six.
        Order{"exponential", located, 8, 5.4, 6.8},
        // The library's dense output has degree four at most: what it interpolates
        // within a step is off by the fifth power of the step.
        Order{"bogacki-shampine", library, 80, 2.7, 3.4},
        Order{"dormand-prince", library, 96, 4.5, 5.5}, Order{"dop853", library, 8, 4.5, 5.5},
        Order{"dirk:esdirk547", library, 24, 4.5, 5.5},
        // The last stage of an explicit part is not the step's end, which ARKODE takes it for; the
        // dense output is further off for it, but no order is lost.
        // Without location the step that contains the end sees the force's kink, and
        // the end itself comes from a cubic through that step.
        Order{"dormand-prince", interpolated, 12, 2.5, 3.5},
        Order{"dop853", interpolated, 4, 2.5, 3.5}),
    NamedAsPrinted{});

// Multistep methods choose their steps themselves.
class EventTimesOfMultistepMethods : public testing::TestWithParam<const char*> {};

TEST_P(EventTimesOfMultistepMethods, FallWithTheToleranceHoweverEventsAreFound) {
  const double exact = exact_end();
  const auto error = [&](double rtol, EventHandling events) {
    return std::abs(SmoothImpact::end({GetParam(), rtol, {}, events}) - exact);
  };
  for (const EventHandling events : {located, library}) {
    EXPECT_LT(error(1e-11, events), 1e-2 * error(1e-7, events));
  }
  // Both follow the method's own polynomial.
  for (const double rtol : {1e-7, 1e-11}) {
    EXPECT_NEAR(error(rtol, library), error(rtol, located), 0.1 * error(rtol, located));
  }
}

INSTANTIATE_TEST_SUITE_P(, EventTimesOfMultistepMethods, testing::Values("adams", "bdf"),
                         NamedAsPrinted{});

}  // namespace
}  // namespace subimpact
