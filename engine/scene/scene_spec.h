// A scene as its file states it (docs/scene.md), and the scene that it means.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/field.h"
#include "base/problems.h"
#include "engine/laws/material.h"
#include "engine/scene.h"
#include "engine/scene/filling.h"
#include "engine/scene/pair_spec.h"
#include "engine/scene/pour.h"
#include "engine/scene/size_distribution.h"
#include "engine/scene/sphere_file.h"
#include "engine/scene/wall_spec.h"

namespace talus::engine {

struct NamedMaterial {
  std::string name;
  Material material;

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "that spheres, fills and walls refer to"});
    Material::Visit(self.material, visit);
  }
  void Validate(base::Problems& problems) const { material.Validate(problems); }
};

// One sphere, given explicitly.
struct SphereSpec {
  std::string material;   // name; empty: the first
  double diameter = 0;    // [m], > 0
  Vec3 position;          // [m]
  Vec3 velocity;          // [m/s]
  Vec3 angular_velocity;  // [rad/s]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("material", self.material, {.doc = "name of a material; default: the first"});
    visit("diameter", self.diameter,
          {.dimension = Dimension::kLength, .required = true, .doc = "> 0"});
    visit("position", self.position,
          {.dimension = Dimension::kLength, .required = true, .doc = "of the centre"});
    visit("velocity", self.velocity, {.dimension = Dimension::kVelocity});
    visit("angular_velocity", self.angular_velocity, {.dimension = Dimension::kAngularVelocity});
  }
  void Validate(base::Problems& problems) const;
};

// Spheres drawn from a size distribution and placed at random into a region.
struct FillSpec {
  std::string material;  // name; empty: the first
  SizeDistribution sizes;
  double mass = 0;  // [kg], > 0
  FillRegion region;
  double solid_fraction = 0.55;  // where the region's height is free [-], in (0, 0.6]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("material", self.material, {.doc = "name of a material; default: the first"});
    visit("sizes", self.sizes, {.required = true});
    visit("mass", self.mass,
          {.dimension = base::Dimension::kMass, .required = true, .doc = "of all spheres, > 0"});
    visit("region", self.region, {.required = true});
    visit("solid_fraction", self.solid_fraction,
          {.doc = "aimed at where the region has no height, in (0, 0.6]"});
  }
  void Validate(base::Problems& problems) const;
};

// The run ends with the first of these that is met.
struct StopSpec {
  std::optional<double> time{};             // [s], > 0
  std::optional<std::int64_t> steps{};      // > 0
  std::optional<double> energy_fraction{};  // mean kinetic energy of a sphere / (m g d) [-], > 0
  double hold_time = 0.01;                  // that it must stay below for [s], > 0

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("time", self.time, {.dimension = base::Dimension::kTime, .doc = "simulated, > 0"});
    visit("steps", self.steps, {.doc = "> 0"});
    visit("energy_fraction", self.energy_fraction,
          {.doc = "at rest: mean kinetic energy of a sphere over m g d stays below, after the last "
                  "pour, prescribed motion, turn of gravity and removal; > 0"});
    visit("hold_time", self.hold_time,
          {.dimension = base::Dimension::kTime, .doc = "for this long, > 0"});
  }
  void Validate(base::Problems& problems) const;
};

// A plane that counts: the mass of the spheres whose centre is beyond it, on the side that
// `direction` points to, those included that have left the domain there.
struct SectionSpec {
  std::string name;
  Vec3 position;               // [m]
  Vec3 direction{0, 0, -1.0};  // any length but zero

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("name", self.name, {.required = true, .doc = "of its columns in series.csv"});
    visit("position", self.position,
          {.dimension = base::Dimension::kLength, .required = true, .doc = "a point of the plane"});
    visit("direction", self.direction, {.doc = "in which mass is counted; default: downwards"});
  }
  void Validate(base::Problems& problems) const;
  bool IsBeyond(const Vec3& point) const { return Dot(point - position, direction) > 0; }
};

// From `time` on gravity turns so.
struct TurnSpec {
  double time = 0;        // [s]
  Vec3 angular_velocity;  // [rad/s]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("time", self.time,
          {.dimension = Dimension::kTime, .required = true, .doc = "from which on, increasing"});
    visit("angular_velocity", self.angular_velocity, {.dimension = Dimension::kAngularVelocity});
  }
};

struct OutputSpec {
  bool vtp = true;
  bool csv = true;
  std::vector<double> times{};       // [s], increasing
  std::optional<double> interval{};  // between two rows of series.csv [s], > 0
  std::vector<SectionSpec> sections{};

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    visit("vtp", self.vtp, {.doc = "write states as VTP, for ParaView"});
    visit("csv", self.csv, {.doc = "write states as CSV"});
    visit("times", self.times,
          {.dimension = base::Dimension::kTime,
           .doc = "states written as state_0000, …; the last is always written as final"});
    visit("interval", self.interval,
          {.dimension = base::Dimension::kTime,
           .doc = "between two rows of series.csv: forces on walls, mass beyond sections, > 0"});
    visit("sections", self.sections,
          {.doc = "planes; the mass that has passed goes to series.csv"});
  }
  void Validate(base::Problems& problems) const;
};

// A box: spheres whose centre leaves it leave the scene.
struct DomainSpec {
  Vec3 low;   // [m], below `high` in each coordinate
  Vec3 high;  // [m]

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    constexpr auto kLength = base::Dimension::kLength;
    visit("low", self.low, {.dimension = kLength, .required = true, .doc = "corner, below high"});
    visit("high", self.high, {.dimension = kLength, .required = true, .doc = "other corner"});
  }
  void Validate(base::Problems& problems) const;
  bool Contains(const Vec3& point) const;
};

struct SceneSpec {
  std::vector<NamedMaterial> materials{};
  std::vector<PairSpec> pairs{};
  ContactModels models;
  std::vector<SphereSpec> spheres{};
  std::vector<SphereFileSpec> sphere_files{};
  std::vector<FillSpec> fills{};
  std::vector<PourSpec> pours{};
  std::vector<WallSpec> walls{};
  std::optional<DomainSpec> domain{};  // default: without end
  Vec3 gravity{0, 0, -9.81};           // [m/s²]
  std::vector<TurnSpec> gravity_turns{};
  std::optional<double> time_step{};          // [s], > 0
  std::optional<double> rayleigh_fraction{};  // Δt / t_R, in place of time_step [-]; default 0.15
  StopSpec stop;
  OutputSpec outputs;
  std::uint64_t seed = 1;
  int threads = 1;
  double checkpoint_interval = 60;  // wall-clock [s]; 0: only when interrupted

  template <class Self, class Visitor>
  static void Visit(Self& self, Visitor&& visit) {
    using base::Dimension;
    visit("materials", self.materials, {.required = true, .doc = "one at least"});
    visit("pairs", self.pairs,
          {.doc = "what pairs of materials state themselves; else it follows from the two"});
    visit("models", self.models, {.doc = "contact laws between all bodies"});
    visit("spheres", self.spheres, {.doc = "one by one"});
    visit("sphere_files", self.sphere_files,
          {.doc = "listed in CSV files; they follow those of spheres"});
    visit("fills", self.fills, {.doc = "drawn from a size distribution"});
    visit("pours", self.pours, {.doc = "coming in over time, out of a funnel's mouth"});
    visit("walls", self.walls);
    visit("domain", self.domain, {.doc = "spheres whose centre leaves this box are taken out"});
    visit("gravity", self.gravity, {.dimension = Dimension::kAcceleration});
    visit("gravity_turns", self.gravity_turns, {.doc = "how gravity turns; at rest before"});
    visit("time_step", self.time_step,
          {.dimension = Dimension::kTime, .doc = "default: rayleigh_fraction decides"});
    visit("rayleigh_fraction", self.rayleigh_fraction,
          {.doc = "time step over Rayleigh time of the smallest sphere, instead of time_step, in "
                  "(0, 0.4]; default: 0.15"});
    visit("stop", self.stop, {.required = true, .doc = "the first that is met ends the run"});
    visit("outputs", self.outputs);
    visit("seed", self.seed, {.doc = "of the fills and pours"});
    visit("threads", self.threads, {.doc = "the result does not depend on it, > 0"});
    visit("checkpoint_interval", self.checkpoint_interval,
          {.dimension = Dimension::kTime,
           .doc = "wall-clock time between checkpoints; 0: only when interrupted"});
  }
  void Validate(base::Problems& problems) const;
};

// Index of the material called `name`, or the first for no name; -1 if there is none.
int MaterialIndex(const SceneSpec& spec, const std::string& name);

// The shortest Rayleigh time of the spheres that are poured [s], infinite without any.
double PouredRayleighTime(const SceneSpec& spec);

// Puts the spheres of `sphere_files` in their place, so that the spec is complete without them.
void ReadSphereFiles(SceneSpec& spec);

// The scene of a valid spec without `sphere_files`. Throws ConfigError when a fill finds no room,
// or the time step is too long for what is poured.
Scene BuildScene(const SceneSpec& spec);

// What is poured, in the order of the spec, with the numbers that follow those of the scene. Throws
// ConfigError for a stream too fast for the time step, or that outlasts the gravity it falls by.
std::vector<Pour> BuildPours(const SceneSpec& spec, double time_step, std::int64_t num_spheres);

}  // namespace talus::engine
