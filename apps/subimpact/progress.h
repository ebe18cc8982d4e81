#pragma once

#include <chrono>
#include <string>

#include "interrupt.h"

namespace subimpact::app {

/// Shows how far a run has come on stderr, if that is a terminal.
class ProgressDisplay {
 public:
  ProgressDisplay(double end_time, bool quiet, const InterruptListener& listener);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// What is running, shown before the time.
  void show_run(const std::string& description);
  void show_run(const std::string& description, double end_time);

  /// Returns false once the program was asked to end.
  bool operator()(double time);

 private:
  void clear_line();
  void show(double time);

  const InterruptListener& listener_;
  double end_time_;
  std::string run_;
  bool shown_;
  bool line_is_dirty_ = false;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace subimpact::app
