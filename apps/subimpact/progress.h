#pragma once

/// What a command shows while it runs, and the signals that ask it to end.

#include <string>

namespace subimpact::app {

/// Listens while it exists for the signals that ask a program to end: Ctrl-C (SIGINT), SIGTERM,
/// SIGHUP and SIGXCPU. Only one listener may exist at a time. A second Ctrl-C ends the program at
/// once, unless hold_back() was called; a second signal of another kind changes nothing. A signal
/// that was ignored when the program began (nohup) stays ignored.
class InterruptListener {
 public:
  InterruptListener();
  ~InterruptListener();
  InterruptListener(const InterruptListener&) = delete;
  InterruptListener& operator=(const InterruptListener&) = delete;

  bool interrupted() const { return signal() != 0; }
  /// The number of the signal that came first; 0: none came.
  int signal() const;
  int exit_status() const { return 128 + signal(); }

  /// From here on a second Ctrl-C does not end the program: results are being written.
  void hold_back();
};

/// What is running, on one line of stderr, if that is a terminal.
class StatusLine {
 public:
  StatusLine() = default;
  ~StatusLine() { clear(); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(const std::string& text) { write(text + " ..."); }
  void write(const std::string& text);
  void clear();

 private:
  bool is_dirty_ = false;
};

}  // namespace subimpact::app
