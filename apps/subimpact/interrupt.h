#pragma once

namespace subimpact::app {

/// Listens for Ctrl-C while it exists; only one may at a time. A second Ctrl-C ends the program at
/// once.
class InterruptListener {
 public:
  InterruptListener();
  ~InterruptListener();
  InterruptListener(const InterruptListener&) = delete;
  InterruptListener& operator=(const InterruptListener&) = delete;

  bool interrupted() const;
};

}  // namespace subimpact::app
