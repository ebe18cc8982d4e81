#include "report/text/uncertain.h"

#include <random>

#include "testing.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// "201.476 +- 0.017".
std::string text_of(double value, double error) {
  const auto rounding = rounding_of(error, 6);
  if (!rounding) return "not known";
  return with_decimals(value, rounding->decimals) + " +- " + rounding->error;
}

TEST(Rounding, LeavesTheErrorOneDigitAndTwoIfItStartsWithOneAndTheValueNoDigitBelow) {
  const std::tuple<double, double, const char*> all[] = {
      {201.4763, 0.026, "201.48 +- 0.03"},
      {201.4763, 0.0163, "201.476 +- 0.017"},
      {201.4763, 0.1, "201.48 +- 0.10"},
      {201.4763, 2.0, "201 +- 2"},
      {201.4763, 12.0, "201 +- 12"},
      // Errors that round up to the next digit.
      {201.4763, 0.0097, "201.476 +- 0.010"},
      {201.4763, 0.0199, "201.48 +- 0.02"},
      {201.4763, 9.99, "201 +- 10"},
      {8796.3, 234.0, "8800 +- 300"},
      {8796.3, 4e3, "9000 +- 4000"},
      // Larger than the value.
      {12.3, 234.0, "0 +- 300"},
      {-12.3, 234.0, "0 +- 300"},
      {63.0, 234.0, "100 +- 300"},
      {0.0, 0.3, "0.0 +- 0.3"},
      // Below the last decimal, and none.
      {201.4763, 1e-12, "201.476300 +- 0.000001"},
      {201.4763, std::numeric_limits<double>::denorm_min(), "201.476300 +- 0.000001"},
      {201.4763, 0.0, "201.476300 +- 0"}};
  for (const auto& [value, error, text] : all) EXPECT_EQ(text_of(value, error), text);
  for (const double error : {infinity, std::nan(""), -1.0, 1e15, 1e300}) {
    EXPECT_EQ(text_of(1.0, error), "not known") << error;
  }
}

TEST(ANumber, IsNotStatedWithAnErrorThatAsPrintedExceedsIt) {
  int n_stated = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double value = 1e-3 * std::pow(1.0005, i), error = value * (0.3 + 0.0007 * (i % 1001));
    const std::string text = number_in({}, {value, error}, 6);
    const std::size_t sign = text.find(" +- ");
    if (sign == text.npos) continue;
    ++n_stated;
    EXPECT_GE(std::stod(text), std::stod(text.substr(sign + 4))) << text;
  }
  EXPECT_GT(n_stated, 10'000);
}

TEST(Rounding, NeverStatesLessThanTheErrorNorMoreThanHalfAsMuchAgain) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-5.0, 6.0);
  for (int i = 0; i < 20'000; ++i) {
    const double error = std::pow(10.0, exponent(random));
    const auto rounding = rounding_of(error, 6);
    ASSERT_TRUE(rounding);
    const double stated = std::stod(rounding->error);
    ASSERT_GE(stated, error * (1.0 - 1e-8)) << error;
    ASSERT_LE(stated, 1.5 * error) << error;
    // The number loses at most half of a unit of the error's last digit.
    const double value = 1000.0 * error + 0.123456789;
    ASSERT_LE(std::abs(std::stod(with_decimals(value, rounding->decimals)) - value),
              0.51 * std::pow(10.0, -rounding->decimals))
        << error;
    ASSERT_LE(std::pow(10.0, -rounding->decimals), 1.01 * error) << error;
  }
}

TEST(Digits, HaveNoRowOfZerosNoFourthWhereTheyRoundUpAndNoNegativeZero) {
  EXPECT_EQ(with_digits(8796.3, 2), "8800");
  EXPECT_EQ(with_digits(-5.7933e-4, 2), "-0.00058");
  EXPECT_EQ(with_digits(1.93e-33, 2), "1.9e-33");
  EXPECT_EQ(with_digits(99.99, 3), "100");
  EXPECT_EQ(with_digits(0.09996, 3), "0.100");
  EXPECT_EQ(with_digits(-9996.0, 3), "-10000");
  EXPECT_EQ(with_decimals(-0.001, 2), "0.00");
  EXPECT_EQ(with_decimals(-0.006, 2), "-0.01");
}

TEST(UnitFor, IsTheUsualOneInItsRangeAndElseHasAPrefixOrAPowerOfTen) {
  const std::tuple<double, Measure, const char*> all[] = {
      {8796.0, as_force, "N"},          {8.8e-6, as_force, "uN"},     {8.8e-9, as_force, "nN"},
      {8.8e8, as_force, "MN"},          {8.8e13, as_force, "1e13 N"}, {3e-4, as_time, "us"},
      {3e-10, as_time, "ps"},           {3e-9, as_time, "us"},        {300.0, as_time, "s"},
      {3e6, as_time, "1e6 s"},          {1e-4, as_length, "mm"},      {3e-7, as_length, "nm"},
      {2e-27, as_impulse, "1e-27 N s"}, {0.0, as_gap, "um"},          {2e-5, as_ratio, "1e-5"}};
  for (const auto& [size, measure, name] : all) {
    EXPECT_EQ(unit_for(size, measure).name, name) << size;
  }
  EXPECT_EQ(with_unit("2.5", unit_for(2e-27, as_impulse)), "2.5e-27 N s");
  EXPECT_EQ(with_unit("2.5 +- 0.1", unit_for(2e-27, as_impulse)), "(2.5 +- 0.1)e-27 N s");
}

TEST(CountText, StatesNoCountBelowItsError) {
  EXPECT_EQ(count_text({12.0, 0.0}), "12");
  EXPECT_EQ(count_text({48.0, 1.2}), "48 +- 2");
  EXPECT_EQ(count_text({3.0, 51.0}), "3 here, at most 54");
  EXPECT_EQ(count_text({3.0, {}}), "3");
}

TEST(ErrorText, ChoosesTheUnit) {
  EXPECT_EQ(error_text(0.26e-12), "300 fs");
  EXPECT_EQ(error_text(0.26e-6), "0.3 us");
  EXPECT_EQ(error_text(0.0), "0 us");
  EXPECT_EQ(error_text(2e-3), "2 ms");
  EXPECT_EQ(error_text(infinity), "an unknown time");
}

}  // namespace
}  // namespace subimpact
