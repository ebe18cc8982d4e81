#include "status_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "io/printable.h"

namespace subimpact::app {

StatusLine::StatusLine() : shown_(isatty(STDERR_FILENO) != 0) {}

void StatusLine::show(const std::string& text) {
  if (!shown_) return;
  fmt::print(stderr, "\r\033[K{} ...", printable(text));
  std::fflush(stderr);
}

void StatusLine::clear() {
  if (shown_) fmt::print(stderr, "\r\033[K");
}

}  // namespace subimpact::app
