// A scene: everything the solver needs, and nothing of what it is for.
#pragma once

#include <vector>

#include "base/problems.h"
#include "base/vec3.h"
#include "engine/bodies/particle.h"
#include "engine/bodies/wall.h"
#include "engine/laws/material.h"
#include "engine/laws/material_pair.h"

namespace talus::engine {

struct Scene {
  std::vector<Material> materials;
  std::vector<MaterialPair> pairs{};  // each pair once
  ContactModels models;
  std::vector<Particle> particles;
  std::vector<Wall> walls;
  Vec3 gravity{0, 0, -9.81};            // [m/s²]
  std::vector<TurnStep> gravity_turns;  // how it turns; times increasing
  double time_step = 0;                 // Δt [s]; 0: see TimeStep
  double rayleigh_fraction = 0.15;      // Δt / t_R of the smallest sphere [-] (M4), in (0, 0.4]
  int num_threads = 1;                  // of one simulation; the result does not depend on it

  // Everything that would make the run meaningless: NaN, materials out of range or absent, spheres
  // that overlap too much or have a negative id, Δt beyond 0.40 t_R.
  void Validate(base::Problems& problems) const;
};

// Shares of Δt in t_R (M4): a scene is warned of beyond the first, and refused beyond the second.
inline constexpr double kWarnRayleighFraction = 0.20;
inline constexpr double kMaxRayleighFraction = 0.40;

// The shortest Rayleigh time of a scene's spheres [s], infinite without any.
double SmallestRayleighTime(const Scene& scene);

// The way in one step, in radii, that spheres added later and walls may make: what is faster could
// pass something unseen.
inline constexpr double kMostLater = 0.5;

// A way in one step above `most` of its radius, or a turn above 1 rad, is a problem.
void ValidateSpeed(const Particle& p, double time_step, double most, base::Problems& problems);
// The same of a wall's prescribed motion, kMostLater, and the smallest radius that it meets.
void ValidateSpeed(const Wall& wall, double smallest_radius, double time_step,
                   base::Problems& problems);
// Refuses a surface that moves out of itself at this speed [m/s] for what stands at `key`.
struct PassingSpeed {
  double speed = 0;            // [m/s]
  double smallest_radius = 0;  // of the spheres that it meets [m]
  double time_step = 0;        // [s]
};
void ValidateSpeed(const PassingSpeed& passing, const char* key, base::Problems& problems);

// Δt that the scene asks for [s]: `time_step`, or `rayleigh_fraction` of the smallest t_R. 1e-5 s
// without either a `time_step` or spheres: whoever adds spheres later states the step that suits
// them.
double TimeStep(const Scene& scene);

}  // namespace talus::engine
