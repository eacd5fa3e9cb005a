// One sphere, and what follows from its material and its size alone.
#pragma once

#include <cstdint>

#include "base/vec3.h"
#include "engine/laws/material.h"

namespace talus::engine {

using base::Vec3;

// Velocities are those of the full step (M3).
struct Particle {
  std::int64_t id = 0;         // >= 0; kept for life; output is sorted by it
  int material = 0;            // index into Scene::materials
  double radius = 0;           // [m], > 0
  Vec3 position = {};          // [m]
  Vec3 velocity = {};          // [m/s]
  Vec3 angular_velocity = {};  // [rad/s]
};

double SphereMass(const Material& material, double radius);  // [kg]

// Rayleigh time of a sphere [s] (M4).
double RayleighTime(const Material& material, double radius);

}  // namespace talus::engine
