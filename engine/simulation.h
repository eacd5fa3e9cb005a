// The solver: a scene that advances in time.
//
// What a member refuses with base::ConfigError changes nothing. Any other error while the neighbour
// list is made (a sphere that goes through a wall, no memory left) leaves the simulation unusable:
// from then on every member that changes it, or that looks at contacts or motion, throws
// base::Error and says so.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/bodies/press.h"
#include "engine/scene.h"

namespace talus::engine {

// One touching pair, for analysis and for output.
struct ContactInfo {
  std::int64_t first = 0;   // particle id
  std::int64_t second = 0;  // particle id, or -1 - wall index
  double overlap = 0;       // δ [m] (K1)
  Vec3 normal;              // n [-], from `first` to `second`
  Vec3 force;               // on `first` [N]
};

// What a wall feels now of all spheres that touch it, or that it pulls at.
struct WallLoad {
  Vec3 force;   // [N]
  Vec3 torque;  // about the wall's pivot [N m]
};

struct EnergySums {
  double translational = 0;  // Σ m v²/2 [J], at the full step
  double rotational = 0;     // Σ I ω²/2 [J], at the full step
  double potential = 0;      // -Σ m g·x [J]
};

struct SimulationState;  // engine/simulation_state.h

// What the neighbour list is like, for benchmarks and progress reports.
struct ListStatistics {
  double skin = 0;                // [m]
  std::int64_t num_rebuilds = 0;  // since the start
  std::int64_t num_pairs = 0;     // listed
  std::int64_t num_contacts = 0;  // of them, touching when the list was made
  std::int64_t num_chunks = 0;    // that threads can share
  const char* kernels = "";       // instruction set: "avx512", "avx2", "sse2"
};

// Two threads may call const members of one object at once, but for those that are said to write.
class Simulation {
 public:
  // Throws base::ConfigError with every problem of the scene.
  explicit Simulation(const Scene& scene);
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;
  ~Simulation();

  // Advances by whole steps. Throws base::Error that names reason, step and particle when the run
  // blows up: NaN, a velocity beyond what gravity and cohesion can give, a sphere through a wall.
  void Advance(std::int64_t num_steps);

  std::int64_t step() const;
  double time() const;       // [s]
  double time_step() const;  // [s]
  std::int64_t num_particles() const;

  // These three write to scratch memory of the object: one at a time.
  std::vector<Particle> Particles() const;  // by id, velocities at the full step
  EnergySums Energies() const;
  double MaxSpeed() const;  // of any sphere [m/s]

  std::vector<ContactInfo> Contacts() const;  // δ > 0 now, ordered by (first, second)
  std::vector<WallLoad> WallLoads() const;    // of each wall
  double LargestRadius() const;               // [m]; 0 without spheres
  const std::vector<Wall>& Walls()
      const;  // shapes as they stand now; removed ones keep their place
  ListStatistics Statistics() const;

  Vec3 Gravity() const;  // now [m/s²]
  const std::vector<TurnStep>& GravityTurns() const;

  // Whether friction or rolling resistance with any other slows a spin, for each material.
  std::vector<bool> ResistsSpin() const;

  // From now on gravity turns as `turns` says (times absolute); what was prescribed is dropped.
  void SetGravityTurns(std::vector<TurnStep> turns);

  // Puts more spheres into the scene. Throws base::ConfigError for one with a number that is in
  // use or negative, a material that is not there, for which the time step is too long, or that
  // overlaps another sphere or a wall by more than a sphere of a Scene may.
  void Add(std::span<const Particle> spheres);

  // From now on the wall follows `motion` (times absolute); what was prescribed before is dropped.
  // Throws base::ConfigError for a wall that is not there, and for a motion so fast that a sphere
  // could pass it unseen.
  void SetMotion(int wall, std::vector<MotionStep> motion);

  // From now on these walls are pressed; what was pressed before is not any more. Throws
  // base::ConfigError as SetMotion does; the speed is the one at which nothing holds them.
  void SetPresses(std::vector<Press> presses);
  const std::vector<Press>& Presses() const;  // at their speeds now

  // Takes a wall out of the scene for good: nothing touches it any more. Throws base::ConfigError
  // for one that is not there, as IsRemoved does.
  void RemoveWall(int wall);
  bool IsRemoved(int wall) const;

  // Takes out every sphere for which `leaves` holds; returns how many.
  std::int64_t RemoveIf(const std::function<bool(const Particle&)>& leaves);

  // Replaces one material, so that a powder can be filled with other friction than it is tested
  // with. Throws base::ConfigError for one that is not there or for which the step is too long.
  void SetMaterial(int index, const Material& material);

  // The whole state, versioned and checksummed; Restore goes on with the same bits. Restore throws
  // base::Error for a truncated, damaged or foreign text, base::ConfigError for num_threads < 1.
  std::string Checkpoint() const;
  static Simulation Restore(std::string_view bytes, int num_threads = 1);

 private:
  explicit Simulation(std::unique_ptr<SimulationState> state);
  std::unique_ptr<SimulationState> state_;
};

}  // namespace talus::engine
