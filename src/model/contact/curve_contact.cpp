#include "model/contact/curve_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {
namespace {

constexpr double same_point = 1e-6;  // relative: the last of loading and that of unloading
constexpr int n_depths = 64;         // at which an unloading to scale is tried

// The first point after which the values do not rise, counted from 1; empty: none.
std::string fall_in(const char* name, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double before = i > 0 ? values[i - 1] : 0.0;
    if (std::isfinite(values[i]) && (i > 0 ? values[i] > before : values[i] >= 0.0)) continue;
    return fmt::format("{} {} is {:g}{}", name, i + 1, values[i],
                       i > 0 ? fmt::format(", after {:g}", before) : "");
  }
  return {};
}

std::string fault_in(const MeasuredCurve& curve, std::size_t least) {
  const std::size_t n = curve.indentations.size();
  if (n < least || n != curve.forces.size()) {
    return fmt::format("there are {} indentations and {} forces", n, curve.forces.size());
  }
  const std::string fall = fall_in("indentation", curve.indentations);
  return fall.empty() ? fall_in("force", curve.forces) : fall;
}

bool is_same(double a, double b) { return std::abs(a - b) <= same_point * std::abs(b); }

MeasuredCurve from_zero(MeasuredCurve curve) {
  if (curve.indentations.front() > 0.0) {
    curve.indentations.insert(curve.indentations.begin(), 0.0);
    curve.forces.insert(curve.forces.begin(), 0.0);
  }
  return curve;
}

}  // namespace

std::string fault_of(const MeasuredCurve& loading, const MeasuredCurve& unloading) {
  std::string fault = fault_in(loading, 1);
  if (fault.empty() && (loading.indentations.back() == 0.0 ||
                        (loading.forces.front() == 0.0) != (loading.indentations.front() == 0.0))) {
    fault = fmt::format("the first point is {:g}, {:g}", loading.indentations.front(),
                        loading.forces.front());
  }
  if (!fault.empty()) {
    return "are no curve of loading: " + fault +
           "; allowed: as many forces as indentations, each list above 0 and rising (0 and 0 may "
           "come first)";
  }
  if (unloading.indentations.empty() && unloading.forces.empty()) return {};
  fault = fault_in(unloading, 2);
  if (fault.empty() && unloading.forces.front() != 0.0) {
    fault = fmt::format("force 1 is {:g}", unloading.forces.front());
  }
  if (!fault.empty()) {
    return "are no curve of unloading: " + fault +
           "; allowed: as many forces as indentations, both rising, with the force 0 first, at the "
           "indentation that remains";
  }
  if (!is_same(unloading.indentations.back(), loading.indentations.back()) ||
      !is_same(unloading.forces.back(), loading.forces.back())) {
    return "do not end where the curve of loading does; allowed: the same last point";
  }
  return {};
}

CurveContact::CurveContact(const MeasuredCurve& loading, const MeasuredCurve& unloading)
    : last_(loading.indentations.empty() ? 0.0 : loading.indentations.back()),
      yields_(!unloading.indentations.empty()) {
  if (const std::string fault = fault_of(loading, unloading); !fault.empty()) {
    throw std::invalid_argument("indentations and forces " + fault);
  }
  const MeasuredCurve points = from_zero(loading);
  loading_ = MonotoneCurve(points.indentations, points.forces);
  if (!yields_) return;
  residual_share_ = unloading.indentations.front() / unloading.indentations.back();
  std::vector<double> places, shares;
  for (std::size_t i = 0; i < unloading.forces.size(); ++i) {
    places.push_back(place(unloading.indentations.back(), unloading.indentations[i]));
    shares.push_back(unloading.forces[i] / unloading.forces.back());
  }
  unloading_ = MonotoneCurve(places, shares);
  double before = 0.0;
  for (int k = 1; k <= n_depths; ++k) {
    const double lost = dissipated_energy({last_ * k / n_depths});
    if (lost < before) {
      throw std::invalid_argument(
          "unloading returns more work, from some indentation, than loading has put in; allowed: "
          "an "
          "unloading below the loading, also to scale from smaller indentations");
    }
    before = lost;
  }
}

double CurveContact::force(ContactHistory history, double indentation) const {
  const double largest = history.max_indentation;
  if (!yields_) return loading_.value(indentation);
  if (largest <= 0.0) return 0.0;
  return loading_.value(largest) * unloading_.value(place(largest, indentation));
}

double CurveContact::slope(ContactHistory history, double indentation) const {
  const double largest = history.max_indentation;
  if (!yields_ || largest <= 0.0) return loading_.slope(indentation);
  return loading_.value(largest) * unloading_.slope(place(largest, indentation)) / length(largest);
}

ContactScales CurveContact::scales() const {
  const double whole = loading_.value(last_), half = loading_.value(0.5 * last_);
  const double exponent = std::max(1.0, std::log2(whole / half));
  return {whole / std::pow(last_, exponent), exponent};
}

double CurveContact::recoverable_energy(ContactHistory history, double indentation) const {
  if (!yields_) return indentation > 0.0 ? loading_.integral(indentation) : 0.0;
  const double largest = commit(history, indentation).max_indentation;
  if (indentation <= residual_share_ * largest) return 0.0;
  return loading_.value(largest) * length(largest) *
         unloading_.integral(place(largest, indentation));
}

double CurveContact::dissipated_energy(ContactHistory history) const {
  const double largest = history.max_indentation;
  if (!yields_ || largest <= 0.0) return 0.0;
  return loading_.integral(largest) -
         loading_.value(largest) * length(largest) * unloading_.integral(1.0);
}

double CurveContact::largest_slope(double /*indentation*/) const {
  if (!yields_) return loading_.largest_slope();
  double stiffest = 0.0;  // F(lambda_m)/lambda_m
  for (int k = 1; k <= n_depths; ++k) {
    const double largest = last_ * k / n_depths;
    stiffest = std::max(stiffest, loading_.value(largest) / length(largest));
  }
  return std::max(loading_.largest_slope(), stiffest * unloading_.largest_slope());
}

}  // namespace subimpact
