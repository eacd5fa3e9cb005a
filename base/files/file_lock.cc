#include "base/files/file_lock.h"

#include <sys/file.h>

#include <cerrno>
#include <thread>

namespace talus::base {

bool LockWithin(int descriptor, std::chrono::milliseconds patience,
                std::chrono::milliseconds pause) {
  for (auto waited = std::chrono::milliseconds(0); waited <= patience; waited += pause) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK && errno != EINTR) return false;
    std::this_thread::sleep_for(pause);
  }
  return false;
}

}  // namespace talus::base
