// The particles as the kernels see them (engine/kernel/kernel.h), with what the kernels need not
// know. All arrays but ids and materials are padded with empty rows to a whole block.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/aligned.h"
#include "engine/bodies/particle.h"
#include "engine/threads/team.h"

namespace talus::engine {

struct ParticleStore {
  std::int64_t num = 0;
  AlignedVector<double> motion;  // 8 a particle
  AlignedVector<double> spin;    // 4 a particle
  AlignedVector<float> single;   // 8 a particle; follows from the others, as do
  AlignedVector<float> spot;     // 4 a particle
  std::vector<std::int64_t> ids;
  std::vector<std::int32_t> materials;

  // Positions at the last rebuild.
  AlignedVector<double> old_x, old_y, old_z, radius;

  void Assign(std::span<const Particle> particles, std::span<const Material> list);

  // More of them, behind those that are there.
  void Append(std::span<const Particle> particles, std::span<const Material> list);

  // Masses and inertias from radii and densities.
  void SetMasses(std::span<const Material> list);

  // Keeps the particles that `order` names, in that order, and notes where they are. The rounded
  // rows are then to be made again.
  void Reorder(std::span<const std::int32_t> order, Team& team);

  Vec3 Position(std::int64_t i) const {
    return {motion[8 * i], motion[8 * i + 1], motion[8 * i + 2]};
  }
  Vec3 Velocity(std::int64_t i) const {
    return {motion[8 * i + 4], motion[8 * i + 5], motion[8 * i + 6]};
  }
  Vec3 Spin(std::int64_t i) const { return {spin[4 * i], spin[4 * i + 1], spin[4 * i + 2]}; }
  double Radius(std::int64_t i) const { return motion[8 * i + 3]; }
  double InverseMass(std::int64_t i) const { return motion[8 * i + 7]; }
  double InverseInertia(std::int64_t i) const { return spin[4 * i + 3]; }

 private:
  void Put(std::int64_t i, const Particle& p);
  void NotePositions(std::int64_t begin, std::int64_t end);

  AlignedVector<double> motion_scratch_, spin_scratch_;
  std::vector<std::int64_t> ids_scratch_;
  std::vector<std::int32_t> materials_scratch_;
};

}  // namespace talus::engine
