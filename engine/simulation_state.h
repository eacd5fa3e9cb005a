// What a Simulation holds, and the step. The parts are in the files that their names say.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/bodies/particle_store.h"
#include "engine/bodies/wall_set.h"
#include "engine/kernel/dispatch.h"
#include "engine/neighbor/contact_list.h"
#include "engine/neighbor/skin_tuner.h"
#include "engine/simulation.h"
#include "engine/threads/team.h"

namespace talus::engine {

// Force and torque on a particle [N], [N m].
struct Load {
  Vec3 force;
  Vec3 torque;
};

struct SimulationState {
  const KernelTable* kernels = &ChooseKernels();
  std::unique_ptr<Team> team;

  std::vector<Material> materials;
  std::vector<MaterialPair> pairs;
  ContactModels models;
  Vec3 gravity;  // now [m/s²]
  std::vector<TurnStep> gravity_turns;
  double dt = 0;  // Δt [s]
  Units units;    // of the kernels
  std::int64_t step = 0;
  double reference_speed = 0;  // what the start can make of itself, see blow_up.h [m/s]
  double speed_limit = 0;      // [m/s]

  ParticleStore particles;
  WallSet walls;
  std::vector<double> press_loads;  // on each press, along its direction, for the next step [N]
  ContactList list;
  SkinTuner tuner;
  std::vector<std::int32_t> all_particles;  // 0, 1, 2, …, for RebuildAll
  double wall_moved = 0;                    // farthest way of any wall since the rebuild [m]

  std::vector<PairConstants> constants;           // of materials a, b at a · materials.size() + b
  std::vector<KernelConstants> kernel_constants;  // the same
  double adhesion_gap = 0;                        // largest of them [m]

  // Whether list and particles belong together: not between a change of the particles and the end
  // of the rebuild, nor ever after a rebuild that failed.
  bool usable = true;
  void RequireUsable() const;  // throws base::Error

  double time() const { return static_cast<double>(step) * dt; }
  StepView View();
  ForcesFunction Forces() const;  // the kernel of the models

  // Makes the team of `num_threads`, >= 1; more threads than chunks would have nothing to do.
  void SetThreads(int num_threads);

  // After a change of materials or pairs.
  void SetConstants();

  // After a change of motions that is not the step's own.
  void RoundMotion();

  // Makes the list of the particles at `alive`; the other particles leave.
  void Rebuild(std::span<const std::int32_t> alive);
  void RebuildAll();

  void Advance();       // one step
  MotionCheck Sweep();  // forces and motion of all chunks
  void Move(const StepView& view, Chunk& chunk, const PanelView& panel);
  void WeighPresses();           // press_loads, at the places and speeds that the step begins with
  void TurnGravity();            // as prescribed for the step that has been made
  void Watch(double max_speed);  // rebuilds the list when something may have moved too far

  // Forces at the present positions, by particle index, as the next step will find them. Changes
  // nothing.
  std::vector<Load> Loads();

  // What contacts, images and files see: velocities at the full step (M3), in the order of the ids.
  std::vector<Particle> FullStep();
  std::vector<ContactInfo> Contacts() const;
  std::vector<WallLoad> WallLoads() const;
};

}  // namespace talus::engine
