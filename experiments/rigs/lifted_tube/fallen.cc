#include "experiments/rigs/lifted_tube/fallen.h"

#include <algorithm>
#include <cmath>

namespace talus::rigs {

using engine::Particle;

namespace {

// Faster than after a free fall over its own diameter: no contact holds such a grain.
bool Falls(const Particle& p, double gravity) {
  return p.velocity.z < 0 && p.velocity.z * p.velocity.z > 4 * gravity * p.radius;
}

// What the plate, the tube and all grains that hang on them take up.
struct Extent {
  double radius = 0;  // about the axis [m]
  double bottom = 0;  // the lowest point, the plate's top at most [m]

  void Add(const Particle& p) {
    radius = std::max(radius, std::hypot(p.position.x, p.position.y) + p.radius);
    bottom = std::min(bottom, p.position.z - p.radius);
  }
  bool Above(const Particle& p, double gravity) const {
    const double rise = p.velocity.z > 0 ? p.velocity.z * p.velocity.z / (2 * gravity) : 0;
    return p.position.z + p.radius + rise < (Falls(p, gravity) ? 0 : bottom);
  }
  bool Inside(const Particle& p) const {
    const double outwards = p.position.x * p.velocity.x + p.position.y * p.velocity.y;
    return std::hypot(p.position.x, p.position.y) - p.radius > radius && outwards >= 0;
  }
};

}  // namespace

std::vector<std::int64_t> CanOnlyFall(std::span<const Particle> particles,
                                      const Connectivity& connected,
                                      const LiftedTubeOptions& device, double gravity) {
  Extent extent{.radius = std::max(device.plate_diameter, device.tube_inner_diameter) / 2};
  std::vector<const Particle*> loose;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Particle& p = particles[i];
    const bool hangs = (connected.on_plate[i] || connected.on_tube[i]) && !Falls(p, gravity);
    if (!hangs) {
      loose.push_back(&p);
    } else {
      extent.Add(p);
    }
  }
  std::vector<std::int64_t> ids;
  for (const Particle* p : loose) {
    if (extent.Above(*p, gravity) || extent.Inside(*p)) ids.push_back(p->id);
  }
  return ids;
}

}  // namespace talus::rigs
