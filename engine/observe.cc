// What can be seen of a simulation between two steps. Nothing here changes its course.
#include <algorithm>
#include <numeric>

#include "engine/kernel/shapes.h"
#include "engine/laws/scalar_law.h"
#include "engine/simulation_state.h"

namespace talus::engine {

namespace {

Vector<double> ToVector(const Vec3& a) { return {a.x, a.y, a.z}; }
Vec3 ToVec3(const Vector<double>& a) { return {a.x, a.y, a.z}; }

Body<double> BodyOf(const ParticleStore& p, std::int64_t i) {
  return {p.Radius(i), p.InverseMass(i), p.InverseInertia(i), ToVector(p.Velocity(i)),
          ToVector(p.Spin(i))};
}

Contact<double> SphereContact(const ParticleStore& p, std::int64_t i, std::int64_t j) {
  const Body<double> a = BodyOf(p, i), b = BodyOf(p, j);
  const Vec3 offset = p.Position(j) - p.Position(i);
  const double distance = base::Norm(offset), radii = a.radius + b.radius;
  return MakeContact(ToVector(offset / distance), radii - distance, a.radius * b.radius / radii,
                     a.radius * a.angular_velocity + b.radius * b.angular_velocity, a, b);
}

Contact<double> WallContact(const ParticleStore& p, std::int64_t i, const WallView& wall) {
  const Body<double> a = BodyOf(p, i);
  const NearestPoint<double> nearest = Nearest(wall, ToVector(p.Position(i)));
  const Body<double> b = WallBody(wall, ToVector(p.Position(i)), nearest);
  return MakeContact(nearest.normal, a.radius - nearest.distance, a.radius,
                     a.radius * a.angular_velocity, a, b);
}

History<double> HistoryOf(const PairBlock& block, int lane, const Units& units) {
  const auto in_si = [&](const float(&memory)[3][kBlock], double unit) {
    return Vector<double>{unit * memory[0][lane], unit * memory[1][lane], unit * memory[2][lane]};
  };
  return {in_si(block.spring, units.length), in_si(block.moment, units.Torque())};
}

// What a run of contacts does to its wall. The force acts where the sphere's surface meets the
// wall's; rolling resistance acts as on another sphere (R5).
WallLoad LoadOf(const SimulationState& state, const Chunk& chunk, const PairRun& run,
                ScalarLaw law) {
  const WallView& wall = state.walls.views()[run.wall];
  const PairConstants& pair = state.constants[run.constants];
  WallLoad load;
  for (std::int64_t k = 0; k < run.num_pairs; ++k) {
    const PairBlock& block = chunk.blocks[run.first_block + k / kBlock];
    const int lane = static_cast<int>(k % kBlock);
    const std::int32_t i = block.first[lane];
    const Contact<double> contact = WallContact(state.particles, i, wall);
    if (!(contact.overlap > -pair.adhesion_gap)) continue;
    History<double> history = HistoryOf(block, lane, state.units);
    const Response<double> on_sphere = law(pair, contact, state.dt, history);
    const Vec3 on_wall = -ToVec3(on_sphere.force);
    const double distance = state.particles.Radius(i) - contact.overlap;
    const Vec3 place = state.particles.Position(i) + distance * ToVec3(contact.normal);
    load.force += on_wall;
    load.torque += Cross(place - ToVec3(Broadcast<double>(wall.pivot)), on_wall);
    load.torque -= ToVec3(on_sphere.rolling);
  }
  return load;
}

}  // namespace

std::vector<Load> SimulationState::Loads() {
  const StepView view = View();
  const auto forces = Forces();
  std::vector<Load> loads(particles.motion.size() / 8);
  for (Chunk& chunk : list.chunks()) {
    const auto blocks = chunk.blocks;
    const auto touching = chunk.touching;
    for (const Panel& panel : chunk.panels) forces(view, chunk.View(panel));
    chunk.blocks = blocks;
    chunk.touching = touching;
    for (std::int64_t i = chunk.begin; i < chunk.window_end; ++i) {
      double* row = chunk.forces + 8 * (i - chunk.begin);
      loads[i].force += units.Force() * Vec3{row[0], row[1], row[2]};
      loads[i].torque += units.Torque() * Vec3{row[4], row[5], row[6]};
      std::fill_n(row, 8, 0.0);
    }
  }
  return loads;
}

std::vector<Particle> SimulationState::FullStep() {
  const std::vector<Load> loads = Loads();
  std::vector<std::int64_t> by_id(particles.num);
  std::iota(by_id.begin(), by_id.end(), 0);
  std::sort(by_id.begin(), by_id.end(),
            [&](std::int64_t a, std::int64_t b) { return particles.ids[a] < particles.ids[b]; });
  std::vector<Particle> result;
  result.reserve(by_id.size());
  for (const std::int64_t i : by_id) {
    const Vec3 acceleration = particles.InverseMass(i) * loads[i].force + gravity;
    const Vec3 turn = particles.InverseInertia(i) * loads[i].torque;
    result.push_back({.id = particles.ids[i],
                      .material = particles.materials[i],
                      .radius = particles.Radius(i),
                      .position = particles.Position(i),
                      .velocity = particles.Velocity(i) + 0.5 * dt * acceleration,
                      .angular_velocity = particles.Spin(i) + 0.5 * dt * turn});
  }
  return result;
}

std::vector<WallLoad> SimulationState::WallLoads() const {
  const ScalarLaw law = PickLaw(models);
  std::vector<WallLoad> loads(walls.size());
  for (const Chunk& chunk : list.chunks()) {
    for (const PairRun& run : chunk.runs) {
      if (run.wall < 0) continue;
      const WallLoad load = LoadOf(*this, chunk, run, law);
      loads[run.wall].force += load.force;
      loads[run.wall].torque += load.torque;
    }
  }
  return loads;
}

void SimulationState::WeighPresses() {
  const std::vector<Press>& presses = walls.presses();
  press_loads.assign(presses.size(), 0);
  if (presses.empty()) return;
  const ScalarLaw law = PickLaw(models);
  for (const Chunk& chunk : list.chunks()) {
    for (const PairRun& run : chunk.runs) {
      for (std::size_t k = 0; k < presses.size(); ++k) {
        if (std::ranges::find(presses[k].walls, run.wall) == presses[k].walls.end()) continue;
        press_loads[k] += Dot(LoadOf(*this, chunk, run, law).force, presses[k].direction);
      }
    }
  }
}

std::vector<ContactInfo> SimulationState::Contacts() const {
  const ScalarLaw law = PickLaw(models);
  std::vector<ContactInfo> result;
  for (const Chunk& chunk : list.chunks()) {
    for (const PairRun& run : chunk.runs) {
      for (std::int64_t k = 0; k < run.num_pairs; ++k) {
        const PairBlock& block = chunk.blocks[run.first_block + k / kBlock];
        const int lane = static_cast<int>(k % kBlock);
        const std::int32_t i = block.first[lane], j = block.second[lane];
        const Contact<double> contact = run.wall < 0
                                            ? SphereContact(particles, i, j)
                                            : WallContact(particles, i, walls.views()[run.wall]);
        if (!(contact.overlap > 0)) continue;
        History<double> history = HistoryOf(block, lane, units);
        const Vec3 force = ToVec3(law(constants[run.constants], contact, dt, history).force);
        ContactInfo info{particles.ids[i], run.wall < 0 ? particles.ids[j] : -1 - run.wall,
                         contact.overlap, ToVec3(contact.normal), force};
        if (run.wall < 0 && info.second < info.first) {
          std::swap(info.first, info.second);
          info.normal = -info.normal;
          info.force = -info.force;
        }
        result.push_back(info);
      }
    }
  }
  std::sort(result.begin(), result.end(), [](const ContactInfo& a, const ContactInfo& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return result;
}

}  // namespace talus::engine
