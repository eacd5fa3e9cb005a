#include "base/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

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

bool IsLocked(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  // A file system without locks refuses this, too; nobody holds one there.
  const bool is_held = ::flock(file, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(file);
  return is_held;
}

}  // namespace talus::base
