#include "engine/bodies/particle_store.h"

#include <algorithm>

#include "engine/kernel/kernel.h"

namespace talus::engine {

namespace {

std::int64_t Padded(std::int64_t count) { return (count + kBlock - 1) / kBlock * kBlock; }

}  // namespace

void ParticleStore::NotePositions(std::int64_t begin, std::int64_t end) {
  for (std::int64_t i = begin; i < end; ++i) {
    old_x[i] = motion[8 * i];
    old_y[i] = motion[8 * i + 1];
    old_z[i] = motion[8 * i + 2];
    radius[i] = motion[8 * i + 3];
  }
}

void ParticleStore::Assign(std::span<const Particle> particles, std::span<const Material> list) {
  num = 0;
  motion.clear();
  spin.clear();
  single.clear();
  spot.clear();
  Append(particles, list);
}

void ParticleStore::Put(std::int64_t i, const Particle& p) {
  const double row[] = {p.position.x, p.position.y, p.position.z, p.radius,
                        p.velocity.x, p.velocity.y, p.velocity.z};
  std::copy(std::begin(row), std::end(row), &motion[8 * i]);
  const double turn[] = {p.angular_velocity.x, p.angular_velocity.y, p.angular_velocity.z};
  std::copy(std::begin(turn), std::end(turn), &spin[4 * i]);
  ids[i] = p.id;
  materials[i] = p.material;
}

void ParticleStore::Append(std::span<const Particle> particles, std::span<const Material> list) {
  const std::int64_t before = num;
  num += static_cast<std::int64_t>(particles.size());
  motion.resize(8 * Padded(num), 0.0);
  spin.resize(4 * Padded(num), 0.0);
  single.resize(8 * Padded(num), 0.0f);
  spot.resize(4 * Padded(num), 0.0f);
  ids.resize(num);
  materials.resize(num);
  for (std::int64_t i = before; i < num; ++i) Put(i, particles[i - before]);
  SetMasses(list);
}

void ParticleStore::SetMasses(std::span<const Material> list) {
  for (std::int64_t i = 0; i < num; ++i) {
    const double r = Radius(i);
    const double mass = SphereMass(list[materials[i]], r);
    motion[8 * i + 7] = 1 / mass;
    spin[4 * i + 3] = 1 / (0.4 * mass * r * r);
  }
}

void ParticleStore::Reorder(std::span<const std::int32_t> order, Team& team) {
  motion_scratch_.swap(motion);
  spin_scratch_.swap(spin);
  ids_scratch_.swap(ids);
  materials_scratch_.swap(materials);
  num = static_cast<std::int64_t>(order.size());
  motion.resize(8 * Padded(num));
  spin.resize(4 * Padded(num));
  single.resize(8 * Padded(num));
  spot.resize(4 * Padded(num));
  ids.resize(num);
  materials.resize(num);
  // A search looks at whole vectors, up to a block beyond a range.
  for (auto* list : {&old_x, &old_y, &old_z, &radius}) list->resize(Padded(num) + kBlock);
  std::fill(motion.begin() + 8 * num, motion.end(), 0.0);
  std::fill(spin.begin() + 4 * num, spin.end(), 0.0);
  NotePositions(num, Padded(num));
  team.ForParts(num, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t from = order[i];
      std::copy_n(&motion_scratch_[8 * from], 8, &motion[8 * i]);
      std::copy_n(&spin_scratch_[4 * from], 4, &spin[4 * i]);
      ids[i] = ids_scratch_[from];
      materials[i] = materials_scratch_[from];
    }
    NotePositions(begin, end);
  });
}

}  // namespace talus::engine
