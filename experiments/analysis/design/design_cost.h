// What `talus design` will cost on this machine, before it is begun.
#pragma once

#include <string>

#include "experiments/analysis/design/design_spec.h"

namespace talus::analysis {

// A line for each test, and one for all. Simulates for about a second of processor time.
std::string DesignCostText(const DesignSpec& design);

}  // namespace talus::analysis
