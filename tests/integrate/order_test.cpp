// Every method has the order its table claims, at whole steps and inside them, no less and no more.

#include "methods.h"
#include "order_table.h"
#include "test_systems.h"
#include "testing.h"

namespace subimpact {
namespace {

// Between these the error is neither too coarse to be asymptotic nor rounding.
constexpr double largest_error = 2e-4;
constexpr double smallest_error = 5e-12;

class Order : public testing::TestWithParam<ExplicitMethod> {
 protected:
  // `error_of(n)` is the error with n steps; n grows by the cube root of 2 until rounding shows,
  // and the order is taken over the last doubling.
  template <class ErrorOf>
  void expect_order(const std::string& title, ErrorOf error_of) {
    OrderTable table(GetParam().name + ", " + title + ": largest error over steps");
    for (int thirds = 6; thirds < 45; ++thirds) {
      const auto n = static_cast<int>(std::lround(std::pow(2.0, thirds / 3.0)));
      const double error = error_of(n);
      if (!(error < largest_error)) continue;
      if (error < smallest_error) break;
      table.add(n, error);
    }
    table.print();
    const double band = GetParam().order_band;
    table.expect_finest_order_within(4, GetParam().order - band, GetParam().order + band);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, Order, testing::ValuesIn(all_methods()), NamedAsPrinted{});

TEST_P(Order, OnAChainOfSpringsIsTheMethodsOwn) {
  SpringChain chain(5);
  expect_order("spring chain",
               [&](int n) { return error_in_steps(GetParam(), chain, 20.0, n, 1.0); });
}

TEST_P(Order, OnACurvedMotionIsTheMethodsOwn) {
  CurvedMotion motion;
  expect_order("curved motion",
               [&](int n) { return error_in_steps(GetParam(), motion, 4.0, n, 1.0); });
}

TEST_P(Order, InsideStepsIsTheMethodsOwn) {
  CurvedMotion motion;
  expect_order("inside steps",
               [&](int n) { return error_in_steps(GetParam(), motion, 4.0, n, 0.37); });
}

}  // namespace
}  // namespace subimpact
