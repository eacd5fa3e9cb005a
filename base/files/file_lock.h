// An advisory lock of a file that another process may be about to let go.
#pragma once

#include <chrono>
#include <filesystem>

namespace talus::base {

enum class LockEnd {
  kTaken,
  kHeld,  // by another process, all the time
  kNone,  // the file system has no locks
};

// What is said of a file that must be locked, after its name.
inline constexpr const char* kNoLocks =
    ": cannot be locked: its file system has no locks; work in a folder on another one";

// Takes the lock of an open file or folder for this process and those it starts, flock(2), trying
// for `patience`, again after each `pause`.
LockEnd LockWithin(int descriptor, std::chrono::milliseconds patience,
                   std::chrono::milliseconds pause);

// Whether some process holds the lock of this file or folder now.
bool IsLocked(const std::filesystem::path& path);

}  // namespace talus::base
