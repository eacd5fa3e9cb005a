// Held while this process simulates in a folder; it goes with the process, however that ends.
#pragma once

#include <filesystem>

namespace talus::trials {

class RunLock {
 public:
  // Throws base::Error when another process simulates there.
  explicit RunLock(const std::filesystem::path& folder);
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

 private:
  int folder_;
};

}  // namespace talus::trials
