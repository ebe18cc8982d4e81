#pragma once

#include <string>

namespace subimpact::app {

/// What is running, on one line of stderr, if that is a terminal.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text);
  void clear();

 private:
  bool shown_;
};

}  // namespace subimpact::app
