#pragma once

/// Factors by which values in SI units are multiplied to be shown in other units.

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace subimpact {

constexpr double us = 1e6;    // of seconds
constexpr double mm = 1e3;    // of metres
constexpr double um = 1e6;    // of metres
constexpr double MPa = 1e-6;  // of pascals
constexpr double MB = 1e-6;   // of bytes

/// A number with so many significant digits, without a power of ten up to 1e10: 120, not 1.2e+02.
inline std::string with_significant(double value, int digits) {
  return fmt::format("{:.10g}", std::stod(fmt::format("{:.{}e}", value, digits - 1)));
}

/// An instant: "120.5 us", from 10 ms on in ms, from 10 s on in s.
inline std::string instant_text(double seconds, int digits = 6) {
  const double size = std::abs(seconds);
  const auto in = [&](double per_s, const char* unit) {
    return with_significant(per_s * seconds, digits) + unit;
  };
  return size < 1e-2 ? in(us, " us") : size < 10.0 ? in(1e3, " ms") : in(1.0, " s");
}

}  // namespace subimpact
