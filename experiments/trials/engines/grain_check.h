// Whether the grains that another engine has left are those of the case. A deck may simulate what
// it likes, but its parameters are calibrated as those of the case's powder.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "base/sphere.h"
#include "experiments/rigs/case/case.h"

namespace talus::trials {

struct GrainDoubt {
  bool is_unit_slip = false;  // 10, 100 or 1000 times too large or too small: nobody means that
  std::string text;
};

// All spheres in the file, those that have fallen off the plate too: their median diameter by
// volume, by a factor of 1.5, more mass than the powder has, by a factor of 1.2, and grains that
// lie in one another. Less mass is no doubt: what has left the box is in no file.
std::optional<GrainDoubt> DoubtOfGrains(const rigs::Case& rig_case,
                                        std::span<const base::Sphere> spheres);

}  // namespace talus::trials
