#include "progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>

#include "io/printable.h"

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

}  // namespace subimpact::app
