// Small images of heaps of two parameters, for tests of what models images.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "surrogate/images/column_edges.h"

namespace talus::optimizer {

inline constexpr surrogate::FieldSize kHeapSize{.width = 32, .height = 24};

// A heap whose steepness and rounding are the two parameters, each in [0, 1]; `steeper` and
// `rounder` are factors on both, `shift` [px] moves it aside.
inline surrogate::ColumnEdges SmoothHeap(const Eigen::VectorXd& u, double steeper = 1,
                                         double rounder = 1, double shift = 0) {
  const double steep = (0.4 + 0.8 * u[0]) * steeper;
  const double round = (1 + 6 * u[1]) * rounder;
  surrogate::ColumnEdges edges{.height = Eigen::VectorXd(kHeapSize.width),
                               .width = Eigen::VectorXd::Constant(kHeapSize.width, 1.2)};
  for (int c = 0; c < kHeapSize.width; ++c) {
    const double x = c + 0.5 - 16 - shift;
    edges.height[c] =
        std::max(0.0, 16 - 2 * u[1] - steep * (std::sqrt(x * x + round * round) - round));
  }
  return edges;
}

// `rough`, relative, disturbs steepness, rounding and place.
inline std::vector<float> HeapImage(const Eigen::VectorXd& u, double rough, std::uint64_t seed) {
  base::Random random(seed, base::Stream("heap image"));
  const double steeper = 1 + rough * random.Normal();
  const double rounder = 1 + rough * random.Normal();
  const double shift = 5 * rough * random.Normal();
  return surrogate::Render(SmoothHeap(u, steeper, rounder, shift), kHeapSize,
                           surrogate::Vessel(kHeapSize));
}

}  // namespace talus::optimizer
