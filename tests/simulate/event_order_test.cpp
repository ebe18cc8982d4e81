// Event times are as accurate as the method, when they are located by the method itself.

#include <gtest/gtest.h>

#include <cmath>

#include "lumped.h"

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

struct Order {
  const char* table;
  EventHandling events;
  int coarsest;  // steps a contact
  double low, high;
};

void PrintTo(const Order& order, std::ostream* out) { *out << order.table; }

class EventTimes : public testing::TestWithParam<Order> {};

TEST_P(EventTimes, HaveTheExpectedOrderInTheStep) {
  const Order& expected = GetParam();
  const double exact = SmoothImpact::end({"dprkn12", 1e-14, {}, EventHandling::located});
  printf("%s, events %s: contact ends at %.15g s\n   steps  error, s   ratio  order\n",
         expected.table, expected.events == EventHandling::located ? "located" : "interpolated",
         exact);
  // The contact's end falls inside a step, always at the same part of it.
  double sum = 0.0;
  double previous = 0.0;
  constexpr int n_halvings = 2;
  for (int k = 0; k <= n_halvings; ++k) {
    const double steps = expected.coarsest * std::exp2(k) + 0.37;
    const double error =
        std::abs(SmoothImpact::end({expected.table, 1e-8, exact / steps, expected.events}) - exact);
    const double order = previous > 0.0 ? std::log2(previous / error) : 0.0;
    printf("%8.2f  %.2e  %6.1f  %.2f\n", steps, error, previous / error, order);
    sum += order;
    previous = error;
  }
  const double order = sum / n_halvings;
  EXPECT_GT(order, expected.low);
  EXPECT_LT(order, expected.high);
}

INSTANTIATE_TEST_SUITE_P(
    , EventTimes,
    testing::Values(Order{"bogacki-shampine", EventHandling::located, 80, 2.7, 3.4},
                    Order{"dormand-prince", EventHandling::located, 96, 4.5, 5.5},
                    Order{"dop853", EventHandling::located, 8, 7.3, 8.9},
                    Order{"dprkn8", EventHandling::located, 12, 7.3, 8.9},
                    // Its force is a cubic within a step, its second integral of order six.
                    Order{"exponential", EventHandling::located, 8, 5.4, 6.8},
                    // Without location the step that contains the end sees the force's kink, and
                    // the end itself comes from a cubic through that step.
                    Order{"dormand-prince", EventHandling::interpolated, 12, 2.5, 3.5},
                    Order{"dop853", EventHandling::interpolated, 4, 2.5, 3.5}),
    [](const auto& info) {
      std::string name =
          std::string(info.param.table) +
          (info.param.events == EventHandling::located ? "_located" : "_interpolated");
      for (char& c : name) {
        if (c == '-') c = '_';
      }
      return name;
    });

}  // namespace
}  // namespace subimpact
