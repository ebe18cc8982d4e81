#include "io/uncertain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

constexpr double largest_error = 1e15;
constexpr double rounding_slack = 1e-9;    // of a digit: 0.3 is three units of 0.1, not four
constexpr int most_decimals_of_times = 6;  // of us: 1 ps

// Units of 10^-decimals, rounded up.
double units_up(double error, int decimals) {
  const double power = std::pow(10.0, std::abs(decimals));
  return std::ceil((decimals >= 0 ? error * power : error / power) - rounding_slack);
}

}  // namespace

std::string with_decimals(double value, int decimals) {
  if (decimals < 0) {
    const double unit = std::pow(10.0, -decimals);
    value = std::round(value / unit) * unit;
  }
  std::string text = fmt::format("{:.{}f}", value, std::max(decimals, 0));
  if (text.front() == '-' && text.find_first_of("123456789") == text.npos) text.erase(0, 1);
  return text;
}

std::optional<Rounding> rounding_of(double error, int most_decimals) {
  if (!(error >= 0.0 && error < largest_error)) return std::nullopt;
  if (error == 0.0) return Rounding{most_decimals, "0"};
  if (error <= std::pow(10.0, -most_decimals)) {
    return Rounding{most_decimals, with_decimals(std::pow(10.0, -most_decimals), most_decimals)};
  }
  int decimals = -static_cast<int>(std::floor(std::log10(error)));
  // 1.2 has two digits; 0.95 to 1 becomes 1.0 in tenths.
  if (units_up(error, decimals) <= 2.0 && units_up(error, decimals + 1) < 20.0) ++decimals;
  double units = units_up(error, decimals);
  if (units >= 100.0) {  // the logarithm was below a power of ten by rounding
    --decimals;
    units = units_up(error, decimals);
  }
  decimals = std::min(decimals, most_decimals);
  units = units_up(error, decimals);
  const double unit = std::pow(10.0, std::abs(decimals));
  return Rounding{decimals, with_decimals(decimals >= 0 ? units / unit : units * unit, decimals)};
}

std::string with_digits(double value, int digits) {
  const double size = std::abs(value);
  if (size > 0.0 && size < 1e-6) return fmt::format("{:.{}e}", value, digits - 1);
  if (!(size > 0.0 && std::isfinite(size))) return with_decimals(value, 0);
  int decimals = digits - 1 - static_cast<int>(std::floor(std::log10(size)));
  // 99.99 becomes 100 with three digits, not 100.0.
  if (std::round(size * std::pow(10.0, decimals)) >= std::pow(10.0, digits)) --decimals;
  return with_decimals(value, decimals);
}

std::string error_text(double seconds) {
  const bool in_ms = seconds >= 1e-3;
  const auto rounding = rounding_of((in_ms ? 1e3 : 1e6) * seconds, most_decimals_of_times);
  if (!rounding) return "an unknown time";
  return rounding->error + (in_ms ? " ms" : " us");
}

}  // namespace subimpact
