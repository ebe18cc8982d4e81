#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "io/printable.h"

namespace subimpact::app {

/// The text without control characters, for it may come from files, paths and arguments. A failure
/// is left to the stream: main() checks stdout once.
inline void print_to(std::FILE* stream, const std::string& text) {
  const std::string shown = printable(text);
  std::fwrite(shown.data(), 1, shown.size(), stream);
}

template <class... Args>
void print(fmt::format_string<Args...> format, Args&&... args) {
  print_to(stdout, fmt::format(format, std::forward<Args>(args)...));
}
template <class... Args>
void print_error(fmt::format_string<Args...> format, Args&&... args) {
  print_to(stderr, fmt::format(format, std::forward<Args>(args)...));
}

}  // namespace subimpact::app
