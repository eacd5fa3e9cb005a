// Ctrl-C and SIGTERM, noted instead of ending the program.
#pragma once

namespace talus::base {

enum class Interrupt {
  kNone,
  kDrain,  // Ctrl-C once: start nothing new, let what runs end
  kDrop    // Ctrl-C again, or SIGTERM: stop at once
};

// While one lives, the two signals are noted instead of ending the program; afterwards they do
// again what they did before. Several may live, in several threads: a signal is meant for them all.
class InterruptGuard {
 public:
  InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
  ~InterruptGuard();

  Interrupt Asked() const;
};

}  // namespace talus::base
