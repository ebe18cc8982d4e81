#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace subimpact {

/// The integer that a JSON value holds. Throws std::out_of_range for 1e300, 0.5 or -1 where they do
/// not fit: their conversion is undefined.
template <class Int>
Int integer(const nlohmann::json& json) {
  if (json.is_number_unsigned()) {
    const auto value = json.get<std::uint64_t>();
    if (std::in_range<Int>(value)) return static_cast<Int>(value);
  } else if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    if (std::in_range<Int>(value)) return static_cast<Int>(value);
  }
  throw std::out_of_range(fmt::format("{} is not an integer that fits", json.dump()));
}

}  // namespace subimpact
