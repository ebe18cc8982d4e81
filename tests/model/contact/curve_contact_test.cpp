// A contact law from measured points: the curve, its energies, loading and unloading.

#include "model/contact/curve_contact.h"
#include <fmt/format.h>
#include <cmath>
#include "testing.h"

namespace subimpact {
namespace {

// Hertz's contact, sampled.
MeasuredCurve sampled(double exponent, int n, double last = 1e-4, double stiffness = 1e9) {
  MeasuredCurve curve;
  for (int i = 1; i <= n; ++i) {
    const double x = last * i / n;
    curve.indentations.push_back(x);
    curve.forces.push_back(stiffness * std::pow(x, exponent));
  }
  return curve;
}

// From half of the largest indentation, in proportion.
MeasuredCurve straight_back(const MeasuredCurve& loading) {
  const double last = loading.indentations.back(), force = loading.forces.back();
  return {{0.5 * last, 0.75 * last, last}, {0.0, 0.5 * force, force}};
}

TEST(AMonotoneCurve, GoesThroughItsPointsWithoutOvershooting) {
  const std::vector<double> x = {0.0, 1.0, 1.1, 3.0}, y = {0.0, 0.1, 5.0, 5.1};
  const MonotoneCurve curve(x, y);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(curve.value(x[i]), y[i], 1e-14);
  double last = -1.0;
  for (double t = 0.0; t <= 3.0; t += 0.01) {
    EXPECT_GT(curve.value(t), last);
    EXPECT_LE(curve.slope(t), curve.largest_slope() * (1.0 + 1e-12));
    last = curve.value(t);
  }
}

TEST(AMonotoneCurve, HasTheSlopeAndTheIntegralOfItsValues) {
  const std::vector<double> x = {0.0, 0.3, 1.0, 2.0}, y = {0.0, 1.0, 1.5, 6.0};
  const MonotoneCurve curve(x, y);
  for (double t = 0.05; t < 2.3; t += 0.1) {
    const double h = 1e-5;
    EXPECT_NEAR((curve.value(t + h) - curve.value(t - h)) / (2.0 * h), curve.slope(t), 1e-6);
    EXPECT_NEAR((curve.integral(t + h) - curve.integral(t - h)) / (2.0 * h), curve.value(t), 1e-8);
  }
}

TEST(ACurveContact, OfManyPointsOfHertzIsHertz) {
  const CurveContact contact(sampled(1.5, 400), {});
  for (const double x : {1.3e-5, 7.77e-5, 1e-4}) {
    const double force = 1e9 * std::pow(x, 1.5);
    EXPECT_NEAR(contact.force({0.0}, x), force, 1e-4 * force + 1e-4);
    EXPECT_NEAR(contact.recoverable_energy({0.0}, x), 0.4 * force * x, 1e-4 * force * x + 1e-10);
  }
  EXPECT_NEAR(contact.scales().exponent, 1.5, 1e-3);
  EXPECT_EQ(contact.largest_indentation(), 1e-4);
}

TEST(ACurveContact, ReturnsTheMeasuredShareOfItsWork) {
  const MeasuredCurve loading = sampled(1.0, 10);
  const CurveContact contact(loading, straight_back(loading));
  for (const double largest : {1e-5, 5e-5, 1e-4}) {
    const double work = 0.5 * 1e9 * largest * largest;
    EXPECT_NEAR(contact.recoverable_energy({largest}, largest), 0.5 * work, 1e-9 * work);
    EXPECT_NEAR(contact.dissipated_energy({largest}), 0.5 * work, 1e-9 * work);
    EXPECT_NEAR(contact.residual_indentation({largest}), 0.5 * largest, 1e-18);
  }
}

TEST(ACurveContact, RefusesPointsThatAreNone) {
  const MeasuredCurve good = sampled(1.5, 5);
  MeasuredCurve falls = good, short_list = good, apart = straight_back(good);
  falls.forces[2] = falls.forces[1];
  short_list.forces.pop_back();
  apart.forces.back() *= 1.01;
  EXPECT_EQ(fault_of(good, {}), "");
  EXPECT_EQ(fault_of(good, straight_back(good)), "");
  const std::string fall = fmt::format("force 3 is {0:g}, after {0:g}", good.forces[1]);
  for (const auto& [bad, fault] : {std::pair(falls, fall),
                                   {short_list, "there are 5 indentations and 4 forces"},
                                   {MeasuredCurve{}, "there are 0 indentations and 0 forces"},
                                   {{{1.0}, {0.0}}, "the first point is 1, 0"}}) {
    expect_in(fault_of(bad, {}), "no curve of loading", fault);
  }
  expect_in(fault_of(good, falls), "no curve of unloading", fall);
  expect_in(fault_of(good, apart), "the same last point");
  // Unloading above the loading.
  const MeasuredCurve bent = sampled(3.0, 8);
  EXPECT_THROW(CurveContact(bent, {{0.0, 1e-4}, {0.0, bent.forces.back()}}), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
