#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace subimpact {

/// The form of a noun after a number, whose plural adds an s: "zone" after 1, else "zones".
template <class Count>
std::string noun_after(Count n, std::string_view noun) {
  return fmt::format("{}{}", noun, n == 1 ? "" : "s");
}

/// "1 zone", "2 zones", "0 zones".
template <class Count>
std::string counted(Count n, std::string_view noun) {
  return fmt::format("{} {}", n, noun_after(n, noun));
}

}  // namespace subimpact
