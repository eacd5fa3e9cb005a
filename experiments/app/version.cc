#include "experiments/app/commands.h"

namespace talus::experiments {

std::string Version() { return TALUS_VERSION; }

}  // namespace talus::experiments
