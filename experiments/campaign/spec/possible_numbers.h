// Numbers that were measured, beside what they can be: most often a bare number of degrees or
// percents, which is read as radians or as a share.
#pragma once

#include <string>

#include "base/problems.h"
#include "experiments/campaign/spec/measured_numbers.h"

namespace talus::campaign {

// Adds a problem for every angle beyond a right one, every share above 1 and every error as large
// as its value. `prefix` stands before a number's key: "experiments[1].", or nothing.
void RequirePossible(const MeasuredNumbers& numbers, const std::string& prefix,
                     base::Problems& problems);

}  // namespace talus::campaign
