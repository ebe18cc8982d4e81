#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "io/printable.h"

namespace subimpact::app {

/// What is running, on one line of stderr, if that is a terminal.
class StatusLine {
 public:
  StatusLine() = default;
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text) {
    if (!shown_) return;
    fmt::print(stderr, "\r\033[K{} ...", printable(text));
    std::fflush(stderr);
  }
  void clear() {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool shown_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace subimpact::app
