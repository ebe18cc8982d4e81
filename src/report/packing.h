#pragma once

#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "report/page.h"

namespace subimpact {

/// Columns of numbers as the scripts of a page read them (pages/data.js): base64 of little-endian
/// numbers, named by their kind,
///
///     f64, f32: floating-point numbers;  i24: signed 24-bit integers, multiples of `step`.
std::string base64(std::string_view bytes);

/// A column of the value of each row, as double or float; NaN where there is none. `value`: a
/// member of the row, or a function of it.
template <class Number, class Range, class Value = std::identity>
Json packed(const Range& rows, Value value = {}) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string bytes(rows.size() * sizeof(Number), '\0');
  char* at = bytes.data();
  for (const auto& row : rows) {
    const Number number =
        static_cast<Number>(std::optional<double>(std::invoke(value, row)).value_or(none));
    std::memcpy(at, &number, sizeof number);
    at += sizeof number;
  }
  return {{std::is_same_v<Number, double> ? "f64" : "f32", base64(bytes)}};
}

/// In 24 bits each: exact to 6e-8 of the largest.
Json packed_i24(const std::vector<double>& values);

}  // namespace subimpact
