// The step: forces, motion, walls, and the list when it is due.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <numeric>

#include "base/error.h"
#include "engine/blow_up.h"
#include "engine/bodies/wall_motion.h"
#include "engine/simulation_state.h"

namespace talus::engine {

namespace {

void Add(const MotionCheck& part, MotionCheck& all) {
  all.max_speed_squared = std::max(all.max_speed_squared, part.max_speed_squared);
  all.sound = all.sound && part.sound;
}

void Add(const Displacements& part, Displacements& all) {
  all.second_squared = std::max({std::min(part.largest_squared, all.largest_squared),
                                 part.second_squared, all.second_squared});
  all.largest_squared = std::max(part.largest_squared, all.largest_squared);
}

Scales ScalesOf(const Units& units, double time_step) {
  const double per_length = 1 / units.length, per_speed = 1 / units.Speed();
  return {.length = static_cast<float>(per_length),
          .length_squared = static_cast<float>(per_length * per_length),
          .speed = static_cast<float>(per_speed),
          .spin = static_cast<float>(units.time),
          .time_step = static_cast<float>(time_step / units.time),
          .motion_speed = per_speed,
          .motion_spin = units.time,
          .inverse_mass = units.mass,
          .inverse_inertia = units.Inertia(),
          .position = per_length,
          .force = units.Force(),
          .torque = units.Torque()};
}

}  // namespace

StepView SimulationState::View() {
  return {.motion = particles.motion.data(),
          .spin = particles.spin.data(),
          .single = particles.single.data(),
          .spot = particles.spot.data(),
          .constants = kernel_constants.data(),
          .walls = walls.views().data(),
          .gravity = {gravity.x, gravity.y, gravity.z},
          .time_step = dt,
          .scales = ScalesOf(units, dt),
          .speed_limit = speed_limit};
}

ForcesFunction SimulationState::Forces() const {
  return kernels->forces[RowOf(models)][static_cast<int>(models.rolling)];
}

void SimulationState::RequireUsable() const {
  if (usable) return;
  throw base::Error(StepText(*this) +
                    "the simulation cannot be used any more, as an earlier error has left its "
                    "neighbour list unfinished; restore a checkpoint or start anew");
}

void SimulationState::SetThreads(int num_threads) {
  assert(num_threads >= 1);
  team = std::make_unique<Team>(std::min(num_threads, kMaxChunks));
}

void SimulationState::SetConstants() {
  constants.clear();
  kernel_constants.clear();
  adhesion_gap = 0;
  const int num_materials = static_cast<int>(materials.size());
  for (int a = 0; a < num_materials; ++a) {
    for (int b = 0; b < num_materials; ++b) {
      const PairProperties stated = StatedOf(pairs, a, b);
      constants.push_back(
          MakePairConstants(With(materials[a], stated), With(materials[b], stated), models));
      const PairConstants& pair = constants.back();
      kernel_constants.push_back({ToUnits(pair, units), pair.adhesion_gap});
      adhesion_gap = std::max(adhesion_gap, pair.adhesion_gap);
    }
  }
}

void SimulationState::RoundMotion() {
  const StepView view = View();
  const auto count = static_cast<std::int64_t>(particles.single.size()) / 8;
  team->ForParts(count, kBlock, [&](std::int64_t begin, std::int64_t end) {
    kernels->round_motion(view, begin, end);
  });
}

void SimulationState::RebuildAll() {
  all_particles.resize(particles.num);
  std::iota(all_particles.begin(), all_particles.end(), 0);
  Rebuild(all_particles);
}

void SimulationState::Rebuild(std::span<const std::int32_t> alive) {
  usable = false;  // until nothing can fail any more
  tuner.Retune();
  speed_limit = SpeedLimit(*this);
  try {
    list.Rebuild({.kernels = *kernels,
                  .particles = particles,
                  .walls = walls,
                  .reach = tuner.skin() + adhesion_gap,
                  .num_materials = static_cast<std::int64_t>(materials.size()),
                  .team = *team},
                 alive);
  } catch (const base::Error& error) {
    throw base::Error(StepText(*this) + error.what());
  }
  RoundMotion();
  const ListCounts counts = list.counts();
  tuner.Rebuilt(particles.num, counts.pairs, counts.touching);
  wall_moved = 0;
  usable = true;
}

void SimulationState::Move(const StepView& view, Chunk& chunk, const PanelView& panel) {
  const auto num_overhangs = static_cast<std::int64_t>(chunk.overhangs.size());
  Add(kernels->integrate(view, panel, chunk.overhangs.data(), num_overhangs), chunk.check);
}

// A particle's forces come from its own panel, from those before it, and from the chunks before, up
// to `reach` away. So a panel moves as soon as its pairs are done, while its rows are in the cache;
// only the first chunks of a member wait for the members before.
MotionCheck SimulationState::Sweep() {
  const StepView view = View();
  const ForcesFunction forces = Forces();
  std::vector<Chunk>& chunks = list.chunks();
  assert(list.shares().num_members() == team->size());
  assert(list.shares().num_chunks() == static_cast<std::int64_t>(chunks.size()));
  team->Run([&](int member) {
    const auto [begin, end] = list.shares().Of(member);
    const std::int64_t moves_from = list.MovesFrom(member);
    const Panel* last = begin < end ? &chunks[end - 1].panels.back() : nullptr;
    for (std::int64_t c = begin; c < end; ++c) {
      chunks[c].check = {0, true};
      for (const Panel& part : chunks[c].panels) {
        const PanelView panel = chunks[c].View(part);
        forces(view, panel);
        if (&part == last) team->FinishFirstPart(member);
        if (c >= moves_from) Move(view, chunks[c], panel);
      }
    }
    if (last == nullptr) team->FinishFirstPart(member);
    team->AwaitFirstPartsBefore(member);
    for (std::int64_t c = begin; c < moves_from; ++c) {
      for (const Panel& part : chunks[c].panels) Move(view, chunks[c], chunks[c].View(part));
    }
  });
  MotionCheck all{0, true};
  for (const Chunk& chunk : chunks) Add(chunk.check, all);
  return all;
}

void SimulationState::Watch(double max_speed) {
  const double distance = std::max(max_speed, walls.MaxSpeed()) * dt;
  wall_moved += walls.MaxSpeed() * dt;
  if (!tuner.Step(distance)) return;
  const CloudView cloud{particles.old_x.data(), particles.old_y.data(), particles.old_z.data(),
                        particles.radius.data()};
  Displacements moved{0, 0};
  std::mutex mutex;
  const auto count = static_cast<std::int64_t>(particles.motion.size()) / 8;
  team->ForParts(count, kBlock, [&](std::int64_t begin, std::int64_t end) {
    const Displacements part = kernels->displacements(cloud, particles.motion.data(), begin, end);
    const std::lock_guard lock(mutex);
    Add(part, moved);
  });
  const double largest = std::sqrt(moved.largest_squared);
  const double used = largest + std::max(std::sqrt(moved.second_squared), wall_moved);
  if (tuner.CheckDisplacement(used, distance)) RebuildAll();
}

void SimulationState::TurnGravity() {
  if (gravity_turns.empty()) return;
  const double strength = base::Norm(gravity);
  if (strength == 0) return;
  gravity = Turned(gravity, dt * TurnOver(gravity_turns, time(), dt));
  gravity *= strength / base::Norm(gravity);
}

void SimulationState::Advance() {
  WeighPresses();
  const MotionCheck check = Sweep();
  walls.Push(press_loads, dt);
  walls.Move(dt);
  TurnGravity();
  ++step;
  if (!check.sound) ThrowBlowUp(*this);
  Watch(std::sqrt(check.max_speed_squared));
  if (walls.RemoveDue(time(), dt)) RebuildAll();
  walls.SetTime(time(), dt);
}

}  // namespace talus::engine
