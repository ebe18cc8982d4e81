#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

namespace subimpact {

/// Columns of numbers as the scripts of a page read them (pages/data.js): base64 of little-endian
/// numbers, named by their kind,
///
///     f64, f32: floating-point numbers;  i24: signed 24-bit integers, multiples of `step`.

using Json = nlohmann::ordered_json;

std::string base64(std::string_view bytes);

/// A column of value(row) for each row, as double or float.
template <class Number, class Range, class Value>
Json packed(const Range& rows, Value value) {
  std::string bytes(rows.size() * sizeof(Number), '\0');
  char* at = bytes.data();
  for (const auto& row : rows) {
    const Number number = static_cast<Number>(value(row));
    std::memcpy(at, &number, sizeof number);
    at += sizeof number;
  }
  Json column = Json::object();
  column[std::is_same_v<Number, double> ? "f64" : "f32"] = base64(bytes);
  return column;
}

/// In 24 bits each: exact to 6e-8 of the largest.
Json packed_i24(const std::vector<double>& values);

/// JSON within a script element, where the text would end at "</script": without <, > and &.
std::string within_script(const Json& json);

}  // namespace subimpact
