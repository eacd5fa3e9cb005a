#include "base/interrupt.h"

#include <signal.h>

#include <atomic>

namespace talus::base {
namespace {

// What a signal handler can reach is global by nature.
std::atomic<int> num_interrupts = 0;
std::atomic<bool> terminated = false;
static_assert(std::atomic<int>::is_always_lock_free);

void Note(int signal) {
  if (signal == SIGTERM) {
    terminated = true;
  } else {
    ++num_interrupts;
  }
}

void Handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // no SA_RESTART: a wait for trials must end
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  num_interrupts = 0;
  terminated = false;
  Handle(Note);
}

InterruptGuard::~InterruptGuard() { Handle(SIG_DFL); }

Interrupt InterruptGuard::Asked() const {
  if (terminated || num_interrupts >= 2) return Interrupt::kDrop;
  return num_interrupts == 1 ? Interrupt::kDrain : Interrupt::kNone;
}

}  // namespace talus::base
