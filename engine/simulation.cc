#include "engine/simulation.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/error.h"
#include "engine/blow_up.h"
#include "engine/bodies/wall_motion.h"
#include "engine/overlap_check.h"
#include "engine/simulation_state.h"

namespace talus::engine {

namespace {

double SmallestOf(std::span<const Particle> particles) {
  double smallest = INFINITY;
  for (const Particle& p : particles) smallest = std::min(smallest, p.radius);
  return std::isfinite(smallest) ? smallest : 1.0;
}

// Velocities of the scene are those of the full step; the leapfrog's live half a step before (M3).
void StepBackHalf(SimulationState& state) {
  const std::vector<Load> loads = state.Loads();
  ParticleStore& p = state.particles;
  for (std::int64_t i = 0; i < p.num; ++i) {
    const Vec3 v =
        p.Velocity(i) - 0.5 * state.dt * (p.InverseMass(i) * loads[i].force + state.gravity);
    const Vec3 w = p.Spin(i) - 0.5 * state.dt * (p.InverseInertia(i) * loads[i].torque);
    const double velocity[] = {v.x, v.y, v.z}, spin[] = {w.x, w.y, w.z};
    std::copy_n(velocity, 3, &p.motion[8 * i + 4]);
    std::copy_n(spin, 3, &p.spin[4 * i]);
  }
  state.RoundMotion();
}

std::unique_ptr<SimulationState> Start(const Scene& scene) {
  base::Problems problems;
  scene.Validate(problems);
  problems.ThrowIfAny();
  auto state = std::make_unique<SimulationState>();
  state->SetThreads(scene.num_threads);
  state->materials = scene.materials;
  state->pairs = scene.pairs;
  state->models = scene.models;
  state->gravity = scene.gravity;
  state->gravity_turns = scene.gravity_turns;
  state->dt = TimeStep(scene);
  state->units = UnitsOf(state->materials, state->dt);
  state->SetConstants();
  state->particles.Assign(scene.particles, scene.materials);
  state->walls = WallSet(scene.walls);
  state->walls.SetTime(0, state->dt);
  state->tuner = SkinTuner(SmallestOf(scene.particles));
  state->RebuildAll();
  state->reference_speed = ReferenceSpeed(*state);
  state->speed_limit = SpeedLimit(*state);
  StepBackHalf(*state);
  return state;
}

void RequireAmong(const char* what, int index, std::size_t count) {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return;
  throw base::ConfigError(std::string(what) + " " + std::to_string(index) + ": is not among the " +
                          std::to_string(count) + " of the simulation, which are numbered from 0");
}

// Infinite without spheres.
double SmallestRadius(const ParticleStore& particles) {
  double smallest = INFINITY;
  for (std::int64_t i = 0; i < particles.num; ++i) {
    smallest = std::min(smallest, particles.Radius(i));
  }
  return smallest;
}

void ValidateAdded(const SimulationState& state, const Particle& p,
                   std::unordered_set<std::int64_t>& ids, base::Problems& problems) {
  problems.Require(p.id >= 0, "id", static_cast<double>(p.id), "must not be negative");
  problems.Require(ids.insert(p.id).second, "id", static_cast<double>(p.id), "is given twice");
  problems.Require(p.radius > 0 && p.radius < 1e100 && base::IsFinite(p.position) &&
                       base::IsFinite(p.velocity) && base::IsFinite(p.angular_velocity),
                   "radius", p.radius, "must be positive, and the motion finite");
  const auto num_materials = static_cast<int>(state.materials.size());
  const bool known = p.material >= 0 && p.material < num_materials;
  problems.Require(known, "material", "is not among the scene's materials");
  if (!known) return;
  const double rayleigh = RayleighTime(state.materials[p.material], p.radius);
  problems.Require(state.dt <= kMaxRayleighFraction * rayleigh, "time_step", state.dt,
                   "exceeds 0.4 Rayleigh times of a sphere that is added");
  ValidateSpeed(p, state.dt, kMostLater, problems);
}

void ValidateAdded(const SimulationState& state, std::span<const Particle> spheres) {
  base::Problems problems;
  std::unordered_set<std::int64_t> ids(state.particles.ids.begin(), state.particles.ids.end());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    problems.Within("spheres[" + std::to_string(k) + "]",
                    [&] { ValidateAdded(state, spheres[k], ids, problems); });
  }
  if (problems.empty()) ValidateAddedOverlaps(state, spheres, problems);
  problems.ThrowIfAny();
}

// Walls that are pressed move as they do by themselves, and at most as fast as nothing holds them.
void ValidatePressSpeeds(const SimulationState& state, const Press& press,
                         base::Problems& problems) {
  const double smallest = SmallestRadius(state.particles);
  const double speed = std::max(std::abs(press.speed), FreeSpeed(press));
  for (const int wall : press.walls) {
    const double prescribed = MaxPassingSpeed(state.walls.walls()[static_cast<std::size_t>(wall)]);
    ValidateSpeed({prescribed + speed, smallest, state.dt}, "force", problems);
  }
}

// After a change of how walls move.
void WallsSpeedUp(SimulationState& state) {
  state.walls.SetTime(state.time(), state.dt);
  state.reference_speed = std::max(state.reference_speed, state.walls.MaxPrescribedSpeed());
  state.speed_limit = SpeedLimit(state);
}

}  // namespace

Simulation::Simulation(const Scene& scene) : state_(Start(scene)) {}
Simulation::Simulation(std::unique_ptr<SimulationState> state) : state_(std::move(state)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

void Simulation::Advance(std::int64_t num_steps) {
  state_->RequireUsable();
  for (std::int64_t k = 0; k < num_steps; ++k) state_->Advance();
}

std::int64_t Simulation::step() const { return state_->step; }
double Simulation::time() const { return state_->time(); }
double Simulation::time_step() const { return state_->dt; }
std::int64_t Simulation::num_particles() const { return state_->particles.num; }
Vec3 Simulation::Gravity() const { return state_->gravity; }
const std::vector<TurnStep>& Simulation::GravityTurns() const { return state_->gravity_turns; }
const std::vector<Wall>& Simulation::Walls() const { return state_->walls.walls(); }

std::vector<Particle> Simulation::Particles() const {
  state_->RequireUsable();
  return state_->FullStep();
}

std::vector<ContactInfo> Simulation::Contacts() const {
  state_->RequireUsable();
  return state_->Contacts();
}

std::vector<WallLoad> Simulation::WallLoads() const {
  state_->RequireUsable();
  return state_->WallLoads();
}

std::vector<bool> Simulation::ResistsSpin() const {
  const std::size_t num = state_->materials.size();
  const bool rolls = state_->models.rolling != Rolling::kNone;
  std::vector<bool> resists(num, false);
  for (std::size_t k = 0; k < num * num; ++k) {
    const PairConstants& pair = state_->constants[k];
    if (pair.sliding_friction > 0 || (rolls && pair.rolling_friction > 0)) resists[k / num] = true;
  }
  return resists;
}

EnergySums Simulation::Energies() const {
  EnergySums sums;
  for (const Particle& p : Particles()) {
    const Material& material = state_->materials[p.material];
    const double mass = SphereMass(material, p.radius);
    sums.translational += 0.5 * mass * base::Dot(p.velocity, p.velocity);
    sums.rotational +=
        0.2 * mass * p.radius * p.radius * base::Dot(p.angular_velocity, p.angular_velocity);
    sums.potential -= mass * base::Dot(state_->gravity, p.position);
  }
  return sums;
}

double Simulation::MaxSpeed() const {
  double speed = 0;
  for (const Particle& p : Particles()) speed = std::max(speed, base::Norm(p.velocity));
  return speed;
}

ListStatistics Simulation::Statistics() const {
  const ListCounts counts = state_->list.counts();
  return {.skin = state_->tuner.skin(),
          .num_rebuilds = state_->tuner.num_rebuilds(),
          .num_pairs = counts.pairs,
          .num_contacts = counts.touching,
          .num_chunks = static_cast<std::int64_t>(state_->list.chunks().size()),
          .kernels = state_->kernels->name};
}

void Simulation::SetMotion(int wall, std::vector<MotionStep> motion) {
  state_->RequireUsable();
  RequireAmong("wall", wall, Walls().size());
  Wall changed = Walls()[static_cast<std::size_t>(wall)];
  changed.motion = std::move(motion);
  base::Problems problems;
  ValidateWall(changed, static_cast<int>(state_->materials.size()), problems);
  if (problems.empty()) {
    ValidateSpeed(changed, SmallestRadius(state_->particles), state_->dt, problems);
  }
  problems.ThrowIfAny();
  state_->walls.SetMotion(wall, std::move(changed.motion));
  WallsSpeedUp(*state_);
}

const std::vector<Press>& Simulation::Presses() const { return state_->walls.presses(); }

void Simulation::SetPresses(std::vector<Press> presses) {
  state_->RequireUsable();
  base::Problems problems;
  for (const Press& press : presses) ValidatePress(press, state_->walls.size(), problems);
  problems.ThrowIfAny();
  for (const Press& press : presses) ValidatePressSpeeds(*state_, press, problems);
  problems.ThrowIfAny();
  state_->walls.SetPresses(std::move(presses));
  WallsSpeedUp(*state_);
}

void Simulation::SetGravityTurns(std::vector<TurnStep> turns) {
  state_->RequireUsable();
  base::Problems problems;
  ValidateTurns(turns, "gravity_turns", problems);
  problems.ThrowIfAny();
  state_->gravity_turns = std::move(turns);
}

void Simulation::Add(std::span<const Particle> spheres) {
  SimulationState& state = *state_;
  state.RequireUsable();
  if (spheres.empty()) return;
  ValidateAdded(state, spheres);
  std::vector<Particle> behind(spheres.begin(), spheres.end());
  for (Particle& p : behind) p.velocity -= 0.5 * state.dt * state.gravity;  // half a step (M3)
  const double smallest = SmallestOf(spheres);
  if (state.particles.num == 0) {
    state.tuner = SkinTuner(smallest);
  } else {
    state.tuner.Admit(smallest);
  }
  state.usable = false;  // the list does not know them
  state.particles.Append(behind, state.materials);
  state.RebuildAll();
  state.reference_speed = std::max(state.reference_speed, ReferenceSpeed(state));
  state.speed_limit = SpeedLimit(state);
}

void Simulation::RemoveWall(int wall) {
  state_->RequireUsable();
  RequireAmong("wall", wall, Walls().size());
  state_->walls.Remove(wall);
  state_->RebuildAll();
}

bool Simulation::IsRemoved(int wall) const {
  RequireAmong("wall", wall, Walls().size());
  return state_->walls.Removed(wall);
}

double Simulation::LargestRadius() const {
  double largest = 0;
  for (std::int64_t i = 0; i < num_particles(); ++i) {
    largest = std::max(largest, state_->particles.Radius(i));
  }
  return largest;
}

std::int64_t Simulation::RemoveIf(const std::function<bool(const Particle&)>& leaves) {
  const std::vector<Particle> particles = Particles();
  std::vector<std::int64_t> gone;
  for (const Particle& p : particles) {
    if (leaves(p)) gone.push_back(p.id);
  }
  if (gone.empty()) return 0;
  std::vector<std::int32_t> alive;
  for (std::int64_t i = 0; i < state_->particles.num; ++i) {
    if (!std::binary_search(gone.begin(), gone.end(), state_->particles.ids[i])) {
      alive.push_back(static_cast<std::int32_t>(i));
    }
  }
  state_->Rebuild(alive);
  return static_cast<std::int64_t>(gone.size());
}

void Simulation::SetMaterial(int index, const Material& material) {
  state_->RequireUsable();
  RequireAmong("material", index, state_->materials.size());
  base::Problems problems;
  material.Validate(problems);
  for (std::int64_t i = 0; i < state_->particles.num && problems.empty(); ++i) {
    if (state_->particles.materials[i] != index) continue;
    const double rayleigh = RayleighTime(material, state_->particles.Radius(i));
    problems.Require(time_step() <= kMaxRayleighFraction * rayleigh, "time_step", time_step(),
                     "exceeds 0.4 Rayleigh times of a sphere of the new material");
  }
  problems.ThrowIfAny();
  state_->usable = false;  // the list is of the old one
  state_->materials[static_cast<std::size_t>(index)] = material;
  state_->SetConstants();
  state_->particles.SetMasses(state_->materials);
  state_->RebuildAll();
  state_->reference_speed = std::max(state_->reference_speed, ReferenceSpeed(*state_));
  state_->speed_limit = SpeedLimit(*state_);
}

}  // namespace talus::engine
