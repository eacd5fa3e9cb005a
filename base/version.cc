#include "base/version.h"

namespace talus::base {

std::string Version() { return TALUS_VERSION; }

}  // namespace talus::base
