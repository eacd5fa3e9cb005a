// The most memory that this process has ever used.
#pragma once

#include <sys/resource.h>

namespace talus {

inline long PeakMegabytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

}  // namespace talus
