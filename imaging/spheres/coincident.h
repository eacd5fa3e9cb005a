// Spheres that lie in one another, as grains never do.
#pragma once

#include <cstddef>
#include <span>

#include "base/sphere.h"

namespace talus::imaging {

// How many have their centre inside an earlier one, and that one's centre inside them: a file with
// two moments of a heap, or with its grains twice.
std::size_t NumCoincident(std::span<const base::Sphere> spheres);

}  // namespace talus::imaging
