#include "base/interrupt.h"

#include <signal.h>

#include <atomic>
#include <mutex>

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

// Guards live in several threads where Python runs several simulations.
std::mutex changing;
int num_guards = 0;
struct sigaction before_int = {};  // the caller's own: Python's, nohup's, the default
struct sigaction before_term = {};

}  // namespace

InterruptGuard::InterruptGuard() {
  const std::lock_guard lock(changing);
  if (num_guards++ > 0) return;
  num_interrupts = 0;
  terminated = false;
  struct sigaction action {};
  action.sa_handler = Note;
  sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // no SA_RESTART: a wait for trials must end
  sigaction(SIGINT, &action, &before_int);
  sigaction(SIGTERM, &action, &before_term);
}

InterruptGuard::~InterruptGuard() {
  const std::lock_guard lock(changing);
  if (--num_guards > 0) return;
  sigaction(SIGINT, &before_int, nullptr);
  sigaction(SIGTERM, &before_term, nullptr);
}

Interrupt InterruptGuard::Asked() const {
  if (terminated || num_interrupts >= 2) return Interrupt::kDrop;
  return num_interrupts == 1 ? Interrupt::kDrain : Interrupt::kNone;
}

}  // namespace talus::base
