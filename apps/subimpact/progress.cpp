#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>

#include "io/printable.h"
#include "subimpact/report/text.h"

namespace subimpact::app {
namespace {

// Signals by which users, batch systems and limits of the shell end programs.
constexpr std::array listened_to = {SIGINT,  SIGTERM, SIGHUP,  SIGQUIT,  SIGXCPU,
                                    SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM};

volatile std::sig_atomic_t first_signal = 0;
volatile std::sig_atomic_t is_held_back = 0;

void note_signal(int number) {
  const bool again = first_signal != 0 && number == SIGINT;
  if (first_signal == 0) first_signal = number;
  if (!again || is_held_back != 0) return;
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void set_handler(int number, void (*handler)(int)) {
  struct sigaction present {};
  sigaction(number, nullptr, &present);
  if (present.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(number, &action, nullptr);
}

constexpr std::chrono::milliseconds shortest_pause{100};

}  // namespace

InterruptListener::InterruptListener() {
  first_signal = 0;
  is_held_back = 0;
  for (const int number : listened_to) set_handler(number, note_signal);
}

InterruptListener::~InterruptListener() {
  for (const int number : listened_to) set_handler(number, SIG_DFL);
}

int InterruptListener::signal() const { return first_signal; }

void InterruptListener::hold_back() { is_held_back = 1; }

void StatusLine::write(const std::string& text) {
  if (isatty(STDERR_FILENO) == 0) return;
  is_dirty_ = true;
  fmt::print(stderr, "\r\033[K{}", printable(text));
  std::fflush(stderr);
}

void StatusLine::clear() {
  if (is_dirty_) fmt::print(stderr, "\r\033[K");
  is_dirty_ = false;
}

void ProgressDisplay::show_run(const std::string& description) {
  run_ = description + ": ";
  show(0.0);
}

void ProgressDisplay::show(double time) {
  if (quiet_) return;
  line_.write(fmt::format("{}{} of {} ({:.0f} %)", run_, duration_text(time),
                          duration_text(end_time_), 100.0 * time / end_time_));
}

bool ProgressDisplay::operator()(double time) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ >= shortest_pause) {
    last_ = now;
    show(time);
  }
  return !listener_.interrupted();
}

}  // namespace subimpact::app
