// Prints how long projecting a heap takes: 200 000 spheres, 16 views at 640 × 480, one thread.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "imaging/spheres/projection.h"

namespace {

using talus::base::Sphere;

// A cone of 30° on a plate of 10 mm with a volume fraction of 0.6; where the grains are exactly
// does not matter for the time.
std::vector<Sphere> Heap(int count) {
  constexpr double kRadius = 5e-3;
  const double height = kRadius * std::tan(0.5236);
  const double volume = std::numbers::pi * kRadius * kRadius * height / 3;
  const double grain = std::cbrt(0.6 * volume / count / 4.18879);
  std::vector<Sphere> spheres;
  talus::base::Random random(1, talus::base::Stream("projection bench"));
  while (static_cast<int>(spheres.size()) < count) {
    const double x = random.Uniform(-kRadius, kRadius);
    const double y = random.Uniform(-kRadius, kRadius);
    const double z = random.Uniform(0, height);
    if (z > height * (1 - std::hypot(x, y) / kRadius)) continue;
    spheres.push_back({.position = {x, y, z + grain}, .radius = grain});
  }
  return spheres;
}

}  // namespace

int main() {
  const std::vector<Sphere> spheres = Heap(200000);
  const talus::imaging::Frame frame{.width = 640,
                                    .height = 480,
                                    .pixel_size = 0.01 / 340,
                                    .center_x = 320,
                                    .baseline = 400,
                                    .plate_diameter = 0.01};
  double best = 1e9;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = std::clock();
    const auto profile = talus::imaging::ProjectHeap(spheres, frame, 16);
    best = std::min(best, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    if (profile.image.pixels.empty()) return 1;
  }
  std::cout << "200000 spheres, 16 views of 640 x 480: " << best << " s of CPU time\n";
}
