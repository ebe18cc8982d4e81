#include "interrupt.h"

#include <csignal>

namespace subimpact::app {
namespace {

volatile std::sig_atomic_t interrupt_requested = 0;

void request_interrupt(int) {
  interrupt_requested = 1;
  std::signal(SIGINT, SIG_DFL);
}

}  // namespace

InterruptListener::InterruptListener() {
  interrupt_requested = 0;
  std::signal(SIGINT, request_interrupt);
}

InterruptListener::~InterruptListener() { std::signal(SIGINT, SIG_DFL); }

bool InterruptListener::interrupted() const { return interrupt_requested != 0; }

}  // namespace subimpact::app
