#include "experiments/trials/simulate/run_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <chrono>

#include "base/error.h"
#include "base/files/file_lock.h"

namespace talus::trials {

RunLock::RunLock(const std::filesystem::path& folder)
    : folder_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  constexpr std::chrono::milliseconds kPatience{2000};  // of one that is just being killed
  constexpr std::chrono::milliseconds kPause{20};
  if (folder_ < 0) return;  // reading and writing say why
  if (base::LockWithin(folder_, kPatience, kPause) != base::LockEnd::kHeld) return;
  ::close(folder_);
  throw base::Error(folder.string() +
                    ": another process simulates there; name another --out, or wait");
}

RunLock::~RunLock() {
  if (folder_ >= 0) ::close(folder_);
}

}  // namespace talus::trials
