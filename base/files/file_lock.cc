#include "base/files/file_lock.h"

#include <sys/file.h>

#include <cerrno>
#include <thread>

namespace talus::base {

LockEnd LockWithin(int descriptor, std::chrono::milliseconds patience,
                   std::chrono::milliseconds pause) {
  for (auto waited = std::chrono::milliseconds(0); waited <= patience; waited += pause) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return LockEnd::kTaken;
    if (errno != EWOULDBLOCK && errno != EINTR) return LockEnd::kNone;
    std::this_thread::sleep_for(pause);
  }
  return LockEnd::kHeld;
}

}  // namespace talus::base
