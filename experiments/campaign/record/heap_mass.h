// What a photographed heap weighs, beside the mass that is said to have been filled in.
#pragma once

#include <optional>

#include "experiments/journal/records.h"
#include "experiments/rigs/case/case.h"
#include "imaging/heap/profile.h"

namespace talus::campaign {

// Volume of the body that a profile's rows, from a height `from` [m] on, sweep as it turns about
// its axis [m³]. Where the heap is no body of revolution, the mean over views is close to it.
double VolumeOfRevolution(const imaging::Profile& profile, double from = 0);

// A doubt about plate, mass or density: a heap on a plate of more powder than was filled in, even
// if it lies as loosely as few powders do.
std::optional<journal::PhotoWarningRecord> MoreThanFilled(const rigs::Case& rig_case,
                                                          const imaging::Profile& aehp);

}  // namespace talus::campaign
