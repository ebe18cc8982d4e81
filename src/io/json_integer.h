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
  const bool fits = json.is_number_unsigned()
                        ? std::in_range<Int>(json.get<std::uint64_t>())
                        : json.is_number_integer() && std::in_range<Int>(json.get<std::int64_t>());
  if (fits) return json.get<Int>();
  throw std::out_of_range(fmt::format("{} is not an integer that fits", json.dump()));
}

}  // namespace subimpact
