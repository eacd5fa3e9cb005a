// The bed of a drum without what lies apart from it: dust on the glass, a stuck grain, one in
// flight.
#pragma once

#include "imaging/gray_image.h"

namespace talus::imaging {

// The map with white for the powder, darker than grey level 128, that is not connected with the
// largest piece. A pixel is connected with its eight neighbours.
GrayImage BedAlone(const GrayImage& map);

}  // namespace talus::imaging
