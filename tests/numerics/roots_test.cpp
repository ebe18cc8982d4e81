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

TEST(Bisect, NarrowsToWhereTheConditionChanges) {
  for (const double limit : {1e-6, 0.3, 0.999}) {
    const auto holds = [&](double x) { return x < limit; };
    const auto [holding, failing] = bisect(holds, 0.0, 1.0, 1e-9);
    EXPECT_TRUE(holds(holding));
    EXPECT_FALSE(holds(failing));
    EXPECT_LE(failing - holding, 1e-9 * failing);
  }
}

constexpr double rounding = std::numeric_limits<double>::epsilon();

EventValue value(double value, double rate) { return {value, rate}; }

struct Search {
  double found = 0.0;
  double last_evaluated = std::numeric_limits<double>::quiet_NaN();
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

Search search(const std::function<EventValue(double)>& guard, double a, double b, double guess,
              double tolerance, int most_evaluations = 60) {
  Search result;
  result.found = find_rise(
      [&](double t) {
        ++result.evaluations;
        result.last_evaluated = t;
        result.lowest = std::min(result.lowest, t);
        result.highest = std::max(result.highest, t);
        return guard(t);
      },
      a, b, guess, tolerance, most_evaluations);
  return result;
}

struct NastyCase {
  const char* name;
  double allowed;  // distance from the root, for a tolerance of 1e-12
  std::function<EventValue(double t, double root)> guard;
};

const NastyCase nasty_cases[] = {
    {"straight", 1e-15, [](double t, double r) { return value(t - r, 1.0); }},
    {"steep", 1e-12,
     [](double t, double r) {
       const double c = std::cosh(std::min(300.0, std::abs(1e8 * (t - r))));
       return value(std::tanh(1e8 * (t - r)), 1e8 / (c * c));
     }},
    {"jump", 1e-12, [](double t, double r) { return value(t < r ? -1.0 : 1.0, 0.0); }},
    {"flat at the root: third power", 1e-11,
     [](double t, double r) { return value(std::pow(t - r, 3), 3.0 * std::pow(t - r, 2)); }},
    // Newton stalls here and every halving costs two evaluations: the budget buys 30 of them.
    {"flat at the root: seventh power", 1e-9,
     [](double t, double r) { return value(std::pow(t - r, 7), 7.0 * std::pow(t - r, 6)); }},
    {"vertical at the root: cube root", 1e-11,
     [](double t, double r) {
       return value(std::cbrt(t - r), std::pow(std::abs(t - r) + 1e-300, -2.0 / 3.0) / 3.0);
     }},
    {"rate of the wrong sign", 1e-12, [](double t, double r) { return value(t - r, -1.0); }},
    {"rate a thousand times too small", 1e-11,
     [](double t, double r) { return value(t - r, 1e-3); }},
    // The Newton step that ends the search is a thousand times too short.
    {"rate a thousand times too large", 1e-9, [](double t, double r) { return value(t - r, 1e3); }},
    {"at zero from the start on, then falls, then rises", 1e-12,
     [](double t, double r) { return value(t * (t - r), 2.0 * t - r); }},
};

TEST(FindRise, FindsTheRootOfNastyFunctionsWithinItsBudget) {
  for (const NastyCase& nasty : nasty_cases) {
    for (const double root : {1e-6, 0.1234567, 0.5, 0.87654321, 1.0 - 1e-6}) {
      for (const double guess : {-3.0, 0.0, 0.01, 0.5, 0.999, 1.0, 7.0}) {
        const Search result =
            search([&](double t) { return nasty.guard(t, root); }, 0.0, 1.0, guess, 1e-12);
        SCOPED_TRACE(testing::Message() << nasty.name << ", root " << root << ", guess " << guess);
        EXPECT_NEAR(result.found, root, nasty.allowed);
        EXPECT_LE(result.evaluations, 60);
        EXPECT_GE(result.lowest, 0.0);
        EXPECT_LE(result.highest, 1.0);
      }
    }
  }
}

TEST(FindRise, ReturnsTheTimeAtWhichTheGuardWasEvaluatedLast) {
  for (const NastyCase& nasty : nasty_cases) {
    const Search result =
        search([&](double t) { return nasty.guard(t, 0.3); }, 0.0, 1.0, 0.4, 1e-9);
    EXPECT_EQ(result.found, result.last_evaluated) << nasty.name;
  }
}

TEST(FindRise, ConvergesQuadraticallyOnASmoothFunction) {
  const double root = std::log(2.0);
  const Search result = search([](double t) { return value(std::exp(t) - 2.0, std::exp(t)); }, 0.0,
                               1.0, 0.6, 4.0 * rounding);
  EXPECT_NEAR(result.found, root, 4.0 * rounding);
  EXPECT_LE(result.evaluations, 6);
}

TEST(FindRise, WorksInMicrosecondsAsInYears) {
  for (const double unit : {1e-9, 1e-3, 1.0, 1e7}) {
    const double start = 3.0 * unit;
    const double tolerance = 8.0 * rounding * 4.0 * unit;
    const Search result = search(
        [&](double t) {
          const double s = t / unit - 3.4;
          return value(s + s * s * s, (1.0 + 3.0 * s * s) / unit);
        },
        start, 4.0 * unit, 3.9 * unit, tolerance);
    EXPECT_NEAR(result.found, 3.4 * unit, 4.0 * tolerance);
    EXPECT_LE(result.evaluations, 12);
  }
}

TEST(FindRise, StopsAtItsBudgetWhateverTheFunction) {
  const Search result =
      search([](double t) { return value(t < 0.123 ? -1.0 : 1.0, 0.0); }, 0.0, 1.0, 0.5, 0.0, 7);
  EXPECT_EQ(result.evaluations, 7);
  EXPECT_NEAR(result.found, 0.123, std::ldexp(1.0, -6));
}

}  // namespace
}  // namespace subimpact
