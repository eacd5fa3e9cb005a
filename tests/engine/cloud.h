// Clouds of spheres that collide, from keyed random numbers.
#pragma once

#include "base/random.h"
#include "tests/engine/scenes.h"

namespace talus::engine::testing {

struct CloudOptions {
  int per_side = 6;         // spheres along an edge of the cube
  double spacing = 2.1e-3;  // of the lattice [m]
  double radius = 1e-3;     // largest; the smallest is 0.7 of it [m]
  double speed = 0.2;       // of each component, at most [m/s]
  std::uint64_t seed = 1;
};

// On a lattice above z = 0, in random directions, with spin.
inline std::vector<Particle> Cloud(const CloudOptions& o) {
  std::vector<Particle> cloud;
  const auto lattice = [&](int k) { return (k + 0.5) * o.spacing; };
  for (int x = 0; x < o.per_side; ++x) {
    for (int y = 0; y < o.per_side; ++y) {
      for (int z = 0; z < o.per_side; ++z) {
        Particle p;
        p.id = static_cast<std::int64_t>(cloud.size());
        base::Random random(o.seed, base::Stream("cloud"), p.id);
        const auto any = [&](double size) { return random.Uniform(-size, size); };
        p.radius = o.radius * random.Uniform(0.7, 1);
        p.position = {lattice(x), lattice(y), lattice(z)};
        p.velocity = {any(o.speed), any(o.speed), any(o.speed)};
        const double spin = o.speed / o.radius;
        p.angular_velocity = {any(spin), any(spin), any(spin)};
        cloud.push_back(p);
      }
    }
  }
  return cloud;
}

// A closed box of planes around the cloud, so that it keeps colliding.
inline std::vector<Wall> Box(double size) {
  const auto plane = [](Vec3 point, Vec3 normal) {
    return Wall{.name = "side", .shape = Plane{.point = point, .normal = normal}};
  };
  return {plane({0, 0, 0}, {1, 0, 0}),     plane({0, 0, 0}, {0, 1, 0}),
          plane({0, 0, 0}, {0, 0, 1}),     plane({size, 0, 0}, {-1, 0, 0}),
          plane({0, size, 0}, {0, -1, 0}), plane({0, 0, size}, {0, 0, -1})};
}

}  // namespace talus::engine::testing
