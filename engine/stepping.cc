// The step: forces, motion, walls, and the list when it is due.
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "engine/blow_up.h"
#include "engine/simulation_state.h"

namespace talus::engine {

StepView SimulationState::View() {
  return {.motion = particles.motion.data(),
          .spin = particles.spin.data(),
          .constants = constants.data(),
          .walls = walls.views().data(),
          .gravity = {gravity.x, gravity.y, gravity.z},
          .time_step = dt,
          .speed_limit = speed_limit};
}

ForcesFunction SimulationState::Forces() const {
  return kernels->forces[static_cast<int>(models.adhesion)][static_cast<int>(models.rolling)];
}

void SimulationState::SetConstants() {
  constants.clear();
  adhesion_gap = 0;
  for (const Material& a : materials) {
    for (const Material& b : materials) {
      constants.push_back(MakePairConstants(a, b, models));
      adhesion_gap = std::max(adhesion_gap, constants.back().adhesion_gap);
    }
  }
}

void SimulationState::RebuildAll() {
  all_particles.resize(particles.num);
  std::iota(all_particles.begin(), all_particles.end(), 0);
  Rebuild(all_particles);
}

void SimulationState::Rebuild(std::span<const std::int32_t> alive) {
  tuner.Retune();
  speed_limit = SpeedLimit(*this);
  try {
    list.Rebuild({.kernels = *kernels,
                  .particles = particles,
                  .walls = walls,
                  .reach = tuner.skin() + adhesion_gap,
                  .num_materials = static_cast<std::int64_t>(materials.size()),
                  .num_threads = num_threads},
                 alive);
  } catch (const base::Error& error) {
    throw base::Error(StepText(*this) + error.what());
  }
  const ListCounts counts = list.counts();
  tuner.Rebuilt(particles.num, counts.pairs, counts.touching);
  wall_moved = 0;
}

// A particle's forces come from its own chunk and from those before, up to `reach` away. So a chunk
// moves as soon as its pairs are done, while its rows are in the cache; only the first chunks of a
// thread wait for the thread before.
MotionCheck SimulationState::Sweep() {
  const StepView view = View();
  const ForcesFunction forces = Forces();
  std::vector<Chunk>& chunks = list.chunks();
  const auto num_chunks = static_cast<std::int64_t>(chunks.size());
  checks.resize(num_chunks);
  const auto move = [&](std::int64_t c) {
    checks[c] = kernels->integrate(view, chunks[c].View(), chunks[c].overhangs.data(),
                                   static_cast<std::int64_t>(chunks[c].overhangs.size()));
  };
  const auto sweep = [&](std::int64_t begin, std::int64_t end, std::int64_t moves_from) {
    for (std::int64_t c = begin; c < end; ++c) {
      forces(view, chunks[c].View());
      if (c >= moves_from) move(c);
    }
  };
  if (num_threads == 1 || num_chunks == 1) {
    sweep(0, num_chunks, 0);
  } else {
#pragma omp parallel num_threads(num_threads)
    {
      const std::int64_t threads = omp_get_num_threads(), thread = omp_get_thread_num();
      const std::int64_t begin = num_chunks * thread / threads;
      const std::int64_t end = num_chunks * (thread + 1) / threads;
      const std::int64_t moves_from = thread == 0 ? 0 : std::min(begin + list.reach(), end);
      sweep(begin, end, moves_from);
#pragma omp barrier
      for (std::int64_t c = begin; c < moves_from; ++c) move(c);
    }
  }
  MotionCheck all{0, true};
  for (const MotionCheck& check : checks) {
    all.max_speed_squared = std::max(all.max_speed_squared, check.max_speed_squared);
    all.sound = all.sound && check.sound;
  }
  return all;
}

void SimulationState::Watch(double max_speed) {
  const double distance = std::max(max_speed, walls.MaxSpeed()) * dt;
  wall_moved += walls.MaxSpeed() * dt;
  if (!tuner.Step(distance)) return;
  const CloudView cloud{particles.old_x.data(), particles.old_y.data(), particles.old_z.data(),
                        particles.radius.data()};
  const Displacements moved = kernels->displacements(
      cloud, particles.motion.data(), 0, static_cast<std::int64_t>(particles.motion.size() / 8));
  const double largest = std::sqrt(moved.largest_squared);
  const double used = largest + std::max(std::sqrt(moved.second_squared), wall_moved);
  if (tuner.CheckDisplacement(used, distance)) RebuildAll();
}

void SimulationState::Advance() {
  const MotionCheck check = Sweep();
  walls.Move(dt);
  ++step;
  if (!check.sound) ThrowBlowUp(*this);
  Watch(std::sqrt(check.max_speed_squared));
  walls.SetTime(time(), dt);
}

}  // namespace talus::engine
