#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace subimpact {

/// How many leading sub-impacts correspond, in words.
inline std::string leading_words(std::size_t n_corresponding) {
  if (n_corresponding == 0) return "not even the first corresponds";
  if (n_corresponding == 1) return "the first corresponds";
  return fmt::format("the first {} correspond", n_corresponding);
}

}  // namespace subimpact
