// A scene: everything the solver needs, and nothing of what it is for.
#pragma once

#include <cstdint>
#include <vector>

#include "base/problems.h"
#include "base/vec3.h"
#include "engine/scene/material.h"
#include "engine/wall.h"

namespace talus::engine {

// One sphere. Velocities are those of the full step (M3).
struct Particle {
  std::int64_t id = 0;         // kept for life; output is sorted by it
  int material = 0;            // index into Scene::materials
  double radius = 0;           // [m], > 0
  Vec3 position = {};          // [m]
  Vec3 velocity = {};          // [m/s]
  Vec3 angular_velocity = {};  // [rad/s]
};

struct Scene {
  std::vector<Material> materials;
  ContactModels models;
  std::vector<Particle> particles;
  std::vector<Wall> walls;
  Vec3 gravity{0, 0, -9.81};            // [m/s²]
  std::vector<TurnStep> gravity_turns;  // how it turns; times increasing
  double time_step = 0;                 // Δt [s]; 0: rayleigh_fraction decides
  double rayleigh_fraction = 0.15;      // Δt / t_R of the smallest sphere [-] (M4), in (0, 0.4]
  int num_threads = 1;                  // of one simulation; the result does not depend on it

  // Everything that would make the run meaningless: NaN, materials out of range or absent, spheres
  // that overlap too much, Δt beyond 0.40 t_R.
  void Validate(base::Problems& problems) const;
};

// Of Δt (M4): a scene is warned of beyond the first, and refused beyond the second.
inline constexpr double kWarnRayleighFraction = 0.20;
inline constexpr double kMaxRayleighFraction = 0.40;

double SphereMass(const Material& material, double radius);  // [kg]

// Rayleigh time of a sphere [s] (M4).
double RayleighTime(const Material& material, double radius);

// Of all spheres of a scene [s], infinite without any.
double SmallestRayleighTime(const Scene& scene);

// Δt that the scene asks for [s]: `time_step`, or `rayleigh_fraction` of the smallest t_R.
double TimeStep(const Scene& scene);

}  // namespace talus::engine
