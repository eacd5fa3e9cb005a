// Compares two profiles: prints every metric of a heap against a reference.
//
//   compare_profiles HEAP REFERENCE   folders or PNG files that `talus measure` wrote
//   compare_profiles                  two cones of spheres, projected here
#include <talus/base/error.h>
#include <talus/base/sphere.h>
#include <talus/imaging/formats/images/profile_file.h>
#include <talus/imaging/heap/metrics.h>
#include <talus/imaging/spheres/projection.h>

#include <cmath>
#include <iostream>
#include <vector>

namespace imaging = talus::imaging;

namespace {

// Layers of touching spheres on a plate of 10 mm, `height` layers high.
imaging::Profile Cone(int height) {
  constexpr double kRadius = 2.5e-4;  // [m]
  std::vector<talus::base::Sphere> spheres;
  for (int layer = 0; layer < height; ++layer) {
    const int reach = 2 * (height - layer);
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        if (std::hypot(i, j) > reach) continue;
        spheres.push_back({{2 * i * kRadius, 2 * j * kRadius, (2 * layer + 1) * kRadius}, kRadius});
      }
    }
  }
  const imaging::Frame frame{.pixel_size = 2.5e-5, .center_x = 320, .baseline = 400};
  return imaging::ProjectHeap(spheres, frame);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const bool from_files = argc == 3;
    const imaging::HeapImages heap{from_files ? imaging::ReadProfile(argv[1]) : Cone(4), {}};
    const imaging::HeapImages reference{from_files ? imaging::ReadProfile(argv[2]) : Cone(5), {}};
    for (const imaging::Metric& metric : imaging::CompareProfiles(heap, reference)) {
      std::cout << metric.name << ": ";
      if (metric.value.defined()) {
        std::cout << metric.value.value << '\n';
      } else {
        std::cout << "not defined, because " << metric.value.not_defined << '\n';
      }
    }
  } catch (const talus::base::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
