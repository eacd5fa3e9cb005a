#include "engine/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <unordered_set>

#include "base/text/number_text.h"
#include "engine/bodies/wall_motion.h"
#include "engine/bodies/wall_set.h"
#include "engine/overlap_check.h"

namespace talus::engine {

namespace {

constexpr double kMostAtStart = 0.1;  // way of a sphere in a time step [radii]

std::string Item(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void ValidateParticle(const Particle& p, int num_materials, base::Problems& problems) {
  problems.Require(p.radius > 0 && p.radius < 1e100, "radius", p.radius, "must be positive");
  problems.Require(base::IsFinite(p.position), "position", "must be finite");
  problems.Require(base::IsFinite(p.velocity), "velocity", "must be finite");
  problems.Require(base::IsFinite(p.angular_velocity), "angular_velocity", "must be finite");
  problems.Require(p.material >= 0 && p.material < num_materials, "material",
                   "is not among the scene's materials");
}

void ValidateParticles(const Scene& scene, base::Problems& problems) {
  std::unordered_set<std::int64_t> ids;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const Particle& p = scene.particles[i];
    problems.Within(Item("particles", i), [&] {
      problems.Require(p.id >= 0, "id", static_cast<double>(p.id), "must not be negative");
      ValidateParticle(p, static_cast<int>(scene.materials.size()), problems);
      problems.Require(ids.insert(p.id).second, "id", "is given twice");
    });
  }
}

void ValidatePairs(const Scene& scene, base::Problems& problems) {
  const int num_materials = static_cast<int>(scene.materials.size());
  const auto known = [&](int material) { return material >= 0 && material < num_materials; };
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    const MaterialPair& pair = scene.pairs[i];
    const auto same = [&](const MaterialPair& p) { return p.Joins(pair.first, pair.second); };
    const auto end = scene.pairs.begin() + static_cast<std::ptrdiff_t>(i);
    problems.Within(Item("pairs", i), [&] {
      problems.Require(known(pair.first) && known(pair.second), "",
                       "is not of the scene's materials");
      problems.Require(std::none_of(scene.pairs.begin(), end, same), "", "is given twice");
      pair.stated.Validate(problems);
    });
  }
}

void ValidateStep(const Scene& scene, base::Problems& problems) {
  problems.Require(scene.time_step >= 0 && scene.time_step < 1e100, "time_step", scene.time_step,
                   "must be positive, or 0 to have rayleigh_fraction decide");
  problems.Require(scene.rayleigh_fraction > 0 && scene.rayleigh_fraction <= kMaxRayleighFraction,
                   "rayleigh_fraction", scene.rayleigh_fraction, "must be in (0, 0.4]");
  problems.Require(scene.num_threads >= 1, "num_threads", scene.num_threads, "must be at least 1");
  problems.Require(base::IsFinite(scene.gravity), "gravity", "must be finite");
  ValidateTurns(scene.gravity_turns, "gravity_turns", problems);
}

void ValidateWallSpeeds(const Scene& scene, double time_step, base::Problems& problems) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Particle& p : scene.particles) smallest = std::min(smallest, p.radius);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    problems.Within(Item("walls", i),
                    [&] { ValidateSpeed(scene.walls[i], smallest, time_step, problems); });
  }
}

void ValidateSpeeds(const Scene& scene, base::Problems& problems) {
  const double dt = TimeStep(scene);
  const double limit = kMaxRayleighFraction * SmallestRayleighTime(scene);
  problems.Require(dt <= limit, "time_step", dt,
                   "must not exceed 0.4 Rayleigh times of the smallest sphere, " +
                       std::to_string(limit * 1e6) + " us");
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    problems.Within(Item("particles", i),
                    [&] { ValidateSpeed(scene.particles[i], dt, kMostAtStart, problems); });
  }
  ValidateWallSpeeds(scene, dt, problems);
}

}  // namespace

void ValidateSpeed(const Particle& p, double time_step, double most, base::Problems& problems) {
  const double moves = base::Norm(p.velocity) * time_step / p.radius;
  if (!(moves <= most)) {
    problems.Add("velocity", "moves it by " + base::ShortNumber(moves) +
                                 " of its radius in a time step, above the " +
                                 base::ShortNumber(most) + " that holds; make time_step smaller");
  }
  const double turns = base::Norm(p.angular_velocity) * time_step;
  if (!(turns <= 1)) {
    problems.Add("angular_velocity", "turns it by " + base::ShortNumber(turns) +
                                         " rad in a time step, above the 1 that holds; make "
                                         "time_step smaller");
  }
}

void ValidateSpeed(const Wall& wall, double smallest_radius, double time_step,
                   base::Problems& problems) {
  ValidateSpeed({MaxPassingSpeed(wall), smallest_radius, time_step}, "motion", problems);
}

void ValidateSpeed(const PassingSpeed& passing, const char* key, base::Problems& problems) {
  const double moves = passing.speed * passing.time_step / passing.smallest_radius;
  if (moves <= kMostLater) return;
  problems.Add(key, "moves the surface by " + base::ShortNumber(moves) +
                        " radii of the smallest sphere in a time step, above the " +
                        base::ShortNumber(kMostLater) +
                        " that holds; make it slower, or time_step smaller");
}

double SmallestRayleighTime(const Scene& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Particle& p : scene.particles) {
    smallest = std::min(smallest, RayleighTime(scene.materials[p.material], p.radius));
  }
  return smallest;
}

double TimeStep(const Scene& scene) {
  if (scene.time_step > 0) return scene.time_step;
  const double rayleigh = SmallestRayleighTime(scene);
  // Without spheres nothing but walls moves.
  return std::isfinite(rayleigh) ? scene.rayleigh_fraction * rayleigh : 1e-5;
}

void Scene::Validate(base::Problems& problems) const {
  const std::size_t before = problems.size();
  problems.Require(!materials.empty(), "materials", "needs at least one");
  problems.Within("models", [&] { models.Validate(problems); });
  for (std::size_t i = 0; i < materials.size(); ++i) {
    problems.Within(Item("materials", i), [&] { materials[i].Validate(problems); });
  }
  for (std::size_t i = 0; i < walls.size(); ++i) {
    problems.Within(Item("walls", i),
                    [&] { ValidateWall(walls[i], static_cast<int>(materials.size()), problems); });
  }
  ValidatePairs(*this, problems);
  ValidateStep(*this, problems);
  ValidateParticles(*this, problems);
  if (problems.size() != before) return;
  ValidateSpeeds(*this, problems);
  ValidateOverlaps(*this, problems);
}

}  // namespace talus::engine
