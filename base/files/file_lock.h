// An advisory lock of a file that another process may be about to let go.
#pragma once

#include <chrono>

namespace talus::base {

// Takes the lock of an open file for this process and those it starts, flock(2), trying for
// `patience`, again after each `pause`. Returns whether it was got; false at once where the file
// system has no locks.
bool LockWithin(int descriptor, std::chrono::milliseconds patience,
                std::chrono::milliseconds pause);

}  // namespace talus::base
