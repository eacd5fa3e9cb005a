// The same file as a photograph of two heaps: the runs would agree better than heaps do.
#pragma once

#include <vector>

#include "imaging/photos/experiment.h"

namespace talus::imaging {

// A warning for each photograph whose bytes are those of one in an earlier run.
std::vector<PhotoWarning> WarningsOfCopies(const std::vector<MeasuredRun>& runs);

}  // namespace talus::imaging
