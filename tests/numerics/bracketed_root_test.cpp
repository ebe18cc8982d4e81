#include "numerics/bracketed_root.h"

#include "testing.h"

namespace subimpact {
namespace {

struct Found {
  double root;
  int evaluations = 0;
  bool within = true;  // all evaluations between the ends
};

Found find(const std::function<double(double)>& f, double a, double b) {
  Found result{};
  const auto counted = [&](double x) {
    ++result.evaluations;
    result.within &= x >= std::min(a, b) && x <= std::max(a, b);
    return f(x);
  };
  result.root = root_in(counted, a, b);
  return result;
}

// f has opposite signs (or is zero) two units in the last place to the left and to the right.
void expect_root(const std::function<double(double)>& f, double x) {
  const double step = 2.0 * std::numeric_limits<double>::epsilon() * std::abs(x);
  EXPECT_LE(f(x - step) * f(x + step), 0.0) << "at " << x;
}

struct NamedFunction {
  const char* name;
  int most_evaluations;
  std::function<double(double x, double root)> f;
};

const NamedFunction functions[] = {
    {"straight", 4, [](double x, double r) { return x - r; }},
    {"exponential", 14, [](double x, double r) { return std::expm1(3.0 * (x - r)); }},
    {"steep exponential", 20, [](double x, double r) { return std::expm1(30.0 * (x - r)); }},
    {"falling sine", 14, [](double x, double r) { return std::sin(r - x); }},
    {"steep step", 100, [](double x, double r) { return std::tanh(1e8 * (x - r)); }},
    {"jump", 100, [](double x, double r) { return x < r ? -1.0 : 1.0; }},
    {"cube root", 100, [](double x, double r) { return std::cbrt(x - r); }},
    {"third power", 100, [](double x, double r) { return std::pow(x - r, 3); }},
    {"seventh power", 100, [](double x, double r) { return std::pow(x - r, 7); }},
    {"pole", 100, [](double x, double r) { return x < r ? 1.0 / (x - r) : 1e3; }},
};

TEST(RootIn, FindsTheRootToTheLastDigitsWithinItsBracketAndBudget) {
  for (const NamedFunction& named : functions) {
    for (const double root : {1e-9, 0.1234567, 0.5, 0.87654321, 1.0 - 1e-9}) {
      SCOPED_TRACE(testing::Message() << named.name << ", root " << root);
      const auto f = [&](double x) { return named.f(x, root); };
      const Found up = find(f, 0.0, 1.0);
      expect_root(f, up.root);
      EXPECT_LE(up.evaluations, named.most_evaluations);
      EXPECT_TRUE(up.within);
      const Found down = find(f, 1.0, 0.0);
      expect_root(f, down.root);
      EXPECT_LE(down.evaluations, named.most_evaluations);
    }
  }
}

TEST(RootIn, FindsRootsOfEverySizeToRelativePrecision) {
  for (const double size : {1e-280, 1e-12, 1.0, 1e9}) {
    const auto f = [&](double x) { return x / size * (x / size) - 2.0; };
    EXPECT_NEAR(root_in(f, 0.0, 3.0 * size) / size, std::sqrt(2.0), 5e-16);
    EXPECT_NEAR(root_in(f, -3.0 * size, 0.0) / size, -std::sqrt(2.0), 5e-16);
  }
}

TEST(RootIn, ReturnsAnEndAtWhichTheFunctionIsZero) {
  EXPECT_EQ(root_in([](double x) { return x - 0.25; }, 0.25, 1.0), 0.25);
  EXPECT_EQ(root_in([](double x) { return x - 0.25; }, -1.0, 0.25), 0.25);
}

TEST(RootIn, EndsOnAZeroAtZero) {
  const Found found = find([](double x) { return std::expm1(x) * (2.0 + x); }, -1.0, 0.7);
  EXPECT_NEAR(found.root, 0.0, 1e-300);
  EXPECT_LE(found.evaluations, 20);
}

TEST(Bisect, NarrowsToWhereTheConditionChanges) {
  for (const double limit : {1e-6, 0.3, 0.999}) {
    const auto holds = [&](double x) { return x < limit; };
    const auto [holding, failing] = bisect(holds, 0.0, 1.0, 1e-9);
    EXPECT_TRUE(holds(holding));
    EXPECT_FALSE(holds(failing));
    EXPECT_LE(failing - holding, 1e-9 * failing);
  }
}

TEST(Bisect, TakesTheEndsInEitherOrder) {
  const auto [holding, failing] = bisect([](double x) { return x > 2.0; }, 5.0, 1.0, 1e-12);
  EXPECT_NEAR(holding, 2.0, 1e-11);
  EXPECT_EQ(failing, 2.0);
}

}  // namespace
}  // namespace subimpact
