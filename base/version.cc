#include "base/version.h"

#include "talus_commit.h"

namespace talus::base {

std::string Version() { return TALUS_VERSION; }

std::string Commit() { return TALUS_COMMIT; }

std::string Compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#else
  return "GCC " __VERSION__;
#endif
}

}  // namespace talus::base
