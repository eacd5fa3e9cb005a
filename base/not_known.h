// The one number that stands for none.
#pragma once

#include <limits>

namespace talus::base {

// Not measured, not defined, not worked out, or not given: NaN, so that what is computed from it is
// not known either. JSON shows it as null, CSV as an empty cell.
inline constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

}  // namespace talus::base
