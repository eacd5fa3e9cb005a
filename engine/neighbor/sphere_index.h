// Which of some spheres may touch another one, whatever their sizes.
//
// Cells as wide as the largest sphere hold thousands of small ones. So spheres share a grid only
// with those of less than twice or more than half their radius: a look into each grid passes few
// cells in vain. PairSearch knows two sizes, which is faster for the pairs of a step; this one
// answers for places where none of its spheres is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/particle.h"
#include "engine/neighbor/grid.h"

namespace talus::engine {

class SphereIndex {
 public:
  explicit SphereIndex(std::span<const Particle> spheres);

  // Calls visit(k) of each sphere k that may touch one of this radius [m] at `center`, and of
  // others.
  template <class Visitor>
  void VisitNear(const Vec3& center, double radius, Visitor&& visit) const {
    const double point[] = {center.x, center.y, center.z};
    for (const Layer& layer : layers_) {
      layer.grid.VisitInBox(point, radius + layer.largest, [&](const IndexRange& range) {
        for (std::int64_t k = range.begin; k < range.end; ++k) visit(layer.grid.order()[k]);
      });
    }
  }

 private:
  struct Layer {
    double largest = 0;  // radius [m]
    Grid grid;
  };

  std::vector<Layer> layers_;
};

}  // namespace talus::engine
