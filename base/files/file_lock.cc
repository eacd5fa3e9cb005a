#include "base/files/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <thread>

#include "base/files/descriptor.h"

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
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) return false;
  // A file system without locks refuses this, too; nobody holds one there.
  return ::flock(file.get(), LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

}  // namespace talus::base
