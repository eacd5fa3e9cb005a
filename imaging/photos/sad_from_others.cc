#include "imaging/photos/sad_from_others.h"

#include <cstddef>

#include "imaging/heap/metrics.h"
#include "imaging/spheres/projection.h"

namespace talus::imaging {

std::vector<double> SadFromOthers(const std::vector<GrayImage>& images) {
  std::vector<double> sad;
  for (std::size_t left = 0; left < images.size(); ++left) {
    std::vector<GrayImage> others = images;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    sad.push_back(Sad(images[left], MeanImage(others)));
  }
  return sad;
}

}  // namespace talus::imaging
