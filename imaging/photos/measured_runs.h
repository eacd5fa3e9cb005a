// The silhouette of every photograph in the common frame, and what is measured of it.
#pragma once

#include <vector>

#include "imaging/photos/experiment.h"
#include "imaging/photos/photo_collection.h"
#include "imaging/photos/placement.h"

namespace talus::imaging {

// Run by run, those without a usable photograph left out. Takes the photographs that were kept.
std::vector<MeasuredRun> MeasureRuns(const ExperimentOptions& options, const Placement& placement,
                                     PhotoCollection& collection,
                                     std::vector<PhotoWarning>& warnings);

}  // namespace talus::imaging
