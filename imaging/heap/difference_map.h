// The signed difference map of a simulated and an experimental profile.
//
//   SDM = ANHP − AEHP    > 0, blue: the simulation has too little powder there
//                        < 0, red: it has too much;  0, white
#pragma once

#include "imaging/color_image.h"
#include "imaging/heap/profile.h"

namespace talus::imaging {

// White at 0, full colour at ±255.
Color DifferenceColor(int difference);

// The map alone, pixel for pixel; throws ConfigError when the frames differ.
ColorImage DifferenceImage(const Profile& anhp, const Profile& aehp);

// With axes in mm from the plate's centre and top, the baseline, a length bar and the colour scale,
// cut to where the two heaps are; those of a film below one another.
ColorImage DrawDifferenceMap(const Profile& anhp, const Profile& aehp);

}  // namespace talus::imaging
