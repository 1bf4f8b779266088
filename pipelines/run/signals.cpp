#include "pipelines/run/signals.h"

#include <cstdlib>

namespace nurbeam {

namespace {

constexpr int exit_code = 130;

volatile std::sig_atomic_t interrupts = 0;

void interrupt(int) {
  interrupts = interrupts + 1;
  if (interrupts > 1) std::_Exit(exit_code);
}

struct sigaction set_handler(int signal, void (*handler)(int)) {
  struct sigaction action {
  }, before{};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, &before);
  return before;
}

void restore(int signal, const struct sigaction& before) { sigaction(signal, &before, nullptr); }

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupts = 0;
  interrupt_ = set_handler(SIGINT, interrupt);
  terminate_ = set_handler(SIGTERM, interrupt);
  hang_up_ = set_handler(SIGHUP, interrupt);
  if (hang_up_.sa_handler == SIG_IGN) restore(SIGHUP, hang_up_);
}

InterruptGuard::~InterruptGuard() {
  restore(SIGINT, interrupt_);
  restore(SIGTERM, terminate_);
  restore(SIGHUP, hang_up_);
}

bool InterruptGuard::interrupted() const { return interrupts > 0; }

BrokenPipeGuard::BrokenPipeGuard() : before_(set_handler(SIGPIPE, SIG_IGN)) {}
BrokenPipeGuard::~BrokenPipeGuard() { restore(SIGPIPE, before_); }

}  // namespace nurbeam
