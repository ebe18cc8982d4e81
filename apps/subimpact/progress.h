#pragma once

#include <chrono>

#include "interrupt.h"

namespace subimpact::app {

/// Shows how far a run has come on stderr, if that is a terminal, and listens for Ctrl-C meanwhile.
/// Only one may exist at a time.
class ProgressDisplay {
 public:
  ProgressDisplay(double end_time, bool quiet);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Returns false once Ctrl-C was pressed. A second Ctrl-C ends the program at once.
  bool operator()(double time);

 private:
  void clear_line();

  InterruptListener listener_;
  double end_time_;
  bool shown_;
  bool line_is_dirty_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace subimpact::app
