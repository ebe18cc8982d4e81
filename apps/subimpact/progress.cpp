#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "subimpact/io/report.h"

namespace subimpact::app {
namespace {

constexpr std::chrono::milliseconds shortest_pause{100};

}  // namespace

ProgressDisplay::ProgressDisplay(double end_time, bool quiet, const InterruptListener& listener)
    : listener_(listener),
      end_time_(end_time),
      shown_(!quiet && isatty(STDERR_FILENO) != 0),
      last_(std::chrono::steady_clock::now()) {}

ProgressDisplay::~ProgressDisplay() { clear_line(); }

void ProgressDisplay::show_run(const std::string& description) {
  run_ = description + ": ";
  if (shown_) show(0.0);
}

void ProgressDisplay::show_run(const std::string& description, double end_time) {
  end_time_ = end_time;
  show_run(description);
}

void ProgressDisplay::show(double time) {
  line_is_dirty_ = true;
  fmt::print(stderr, "\r\033[K{}{} of {} ({:.0f} %)", run_, duration_text(time),
             duration_text(end_time_), 100.0 * time / end_time_);
  std::fflush(stderr);
}

bool ProgressDisplay::operator()(double time) {
  const auto now = std::chrono::steady_clock::now();
  if (shown_ && now - last_ >= shortest_pause) {
    last_ = now;
    show(time);
  }
  return !listener_.interrupted();
}

void ProgressDisplay::clear_line() {
  if (!line_is_dirty_) return;
  fmt::print(stderr, "\r\033[K");
  line_is_dirty_ = false;
}

}  // namespace subimpact::app
