#include "experiments/campaign/spec/plausible_angle.h"

#include <cmath>

#include "base/text/number_text.h"
#include "base/units.h"

namespace talus::campaign {
namespace {

// Written with three decimals at most, as people write numbers.
bool IsShort(double number) {
  return std::abs(1e3 * number - std::round(1e3 * number)) < 1e-6 * (1 + std::abs(number));
}

}  // namespace

// What is short in degrees and not in radians was given in degrees.
void RequireAngle(base::Problems& problems, const std::string& path, double angle, double most) {
  const double degrees = angle / base::kDegree;
  if (IsShort(degrees) && !IsShort(angle)) {
    problems.Require(angle <= most, path,
                     "is " + base::ShortNumber(degrees) + " deg, must be at most " +
                         base::ShortNumber(most / base::kDegree, 4) + " deg");
    return;
  }
  problems.Require(angle <= most, path, angle,
                   "in rad, which is " + base::ShortNumber(degrees) +
                       " degrees; a bare number is in rad: write \"" + base::ShortNumber(angle) +
                       " deg\" for degrees");
}

}  // namespace talus::campaign
