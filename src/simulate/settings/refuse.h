#pragma once

#include <fmt/format.h>

#include <utility>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// Throws InvalidCase for a key of the case file; `why` as for fmt::format.
template <class... Values>
[[noreturn]] void refuse(const char* key, fmt::format_string<Values...> why, Values&&... values) {
  throw InvalidCase(key, fmt::format(why, std::forward<Values>(values)...));
}

}  // namespace subimpact
