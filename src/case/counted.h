#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace subimpact {

/// "1 zone", "2 zones", "0 zones": of a noun whose plural adds an s.
template <class Count>
std::string counted(Count n, std::string_view noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

}  // namespace subimpact
