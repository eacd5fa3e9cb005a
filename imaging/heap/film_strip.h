// A film as one profile: the pictures of one run at several times side by side, the first on the
// left, over one baseline. What is added up over pixels is then of all pictures, and columns are
// those of one picture after the other. A strip of one picture is that picture.
#pragma once

#include <span>

#include "imaging/heap/profile.h"

namespace talus::imaging {

Frame StripOf(const Frame& picture, int num_pictures);
Frame OnePicture(const Frame& strip);

// `pictures` of one size, one at least.
GrayImage SideBySide(std::span<const GrayImage> pictures);
// The one at `index`, from 0.
Profile PictureOf(const Profile& strip, int index);

}  // namespace talus::imaging
