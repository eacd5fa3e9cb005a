#pragma once

namespace talus::engine {

// CPU time of this thread [s]: others who share the core do not count.
double ThreadSeconds();

}  // namespace talus::engine
