// The whole lifted-tube problem as the peers run it (bench/peers/README.md): a loose lattice with
// random velocities rains down, and settling, lifting and resting take fixed times.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <variant>
#include <vector>

#include "base/random.h"
#include "bench/packing.h"
#include "engine/simulation.h"

namespace talus::bench {

inline constexpr double kTubeRadius = 5e-3;  // and the plate's [m]

// A loose lattice with random offsets and velocities, as the peers start from.
inline std::vector<engine::Particle> LooseFill(std::int64_t count, double ratio,
                                               std::uint64_t seed) {
  const double d = 2 * kTubeRadius / ratio, spacing = 1.22 * d, jitter = 0.1 * d / std::sqrt(2.0);
  const double reach = kTubeRadius - d / 2 - 0.1 * d - 0.01 * d;
  const int half = static_cast<int>(reach / spacing) + 1;
  std::vector<engine::Particle> spheres;
  for (int layer = 0; static_cast<std::int64_t>(spheres.size()) < count; ++layer) {
    for (int x = -half; x <= half; ++x) {
      for (int y = -half; y <= half; ++y) {
        if (std::hypot(x * spacing, y * spacing) > reach) continue;
        if (static_cast<std::int64_t>(spheres.size()) == count) break;
        engine::Particle p;
        p.id = static_cast<std::int64_t>(spheres.size());
        base::Random random(seed, base::Stream("engine_heap"), p.id);
        const auto shift = [&] { return random.Uniform(-jitter, jitter); };
        p.radius = d / 2;
        p.position = {x * spacing + shift(), y * spacing + shift(),
                      0.65 * d + layer * spacing + shift()};
        p.velocity = 0.06 * base::Vec3{random.Normal(), random.Normal(), random.Normal()};
        spheres.push_back(p);
      }
    }
  }
  return spheres;
}

inline std::int64_t CountOnPlate(const std::vector<engine::Particle>& particles) {
  return std::count_if(particles.begin(), particles.end(), [](const engine::Particle& p) {
    return std::hypot(p.position.x, p.position.y) < kTubeRadius && p.position.z > 0;
  });
}

struct PeerHeap {
  std::int64_t num_spheres = 4000;
  double ratio = 18;  // plate diameter over grain diameter [-]
  double sliding_friction = 0.5;
  double rolling_friction = 0.1;
  double youngs_modulus = 26.25e6;  // [Pa]
  double restitution = 0.9;
  engine::CoulombLimit coulomb_limit = engine::CoulombLimit::kTotalForce;
  double settle_time = 0.08;        // [s]
  double lift_time = 0.20;          // [s]
  double lift_speed = 0.05;         // [m/s]
  double rest_time = 0.22;          // [s]
  double rayleigh_fraction = 0.15;  // Δt over the Rayleigh time [-]
  std::uint64_t seed = 1;
  int num_threads = 1;

  engine::Scene Scene() const {
    engine::Scene scene = TubeScene(LooseFill(num_spheres, ratio, seed));
    scene.materials[0].sliding_friction = sliding_friction;
    scene.materials[0].rolling_friction = rolling_friction;
    scene.materials[0].youngs_modulus = youngs_modulus;
    scene.materials[0].restitution = restitution;
    scene.models.coulomb_limit = coulomb_limit;
    scene.num_threads = num_threads;
    scene.rayleigh_fraction = rayleigh_fraction;
    std::get<engine::OpenCylinder>(scene.walls[0].shape).length = 0.06;
    return scene;
  }

  // Calls `ended` with the name of each part.
  void Run(engine::Simulation& simulation, const std::function<void(const char*)>& ended) const {
    constexpr int kTube = 0;
    Advance(simulation, settle_time);
    ended("settle");
    simulation.SetMotion(kTube, {{.time = simulation.time(), .velocity = {0, 0, lift_speed}}});
    Advance(simulation, lift_time);
    ended("lift");
    simulation.RemoveWall(kTube);
    Advance(simulation, rest_time);
    ended("rest");
  }

 private:
  static bool Leaves(const engine::Particle& p) {
    return std::fabs(p.position.x) > 8e-3 || std::fabs(p.position.y) > 8e-3 || p.position.z < -4e-3;
  }
  static void Advance(engine::Simulation& simulation, double time) {
    const auto end = simulation.step() + std::llround(time / simulation.time_step());
    while (simulation.step() < end) {
      simulation.Advance(std::min<std::int64_t>(500, end - simulation.step()));
      simulation.RemoveIf(Leaves);
    }
  }
};

}  // namespace talus::bench
