#include "engine/overlap_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/bodies/particle_store.h"
#include "engine/bodies/wall_set.h"
#include "engine/kernel/dispatch.h"
#include "engine/neighbor/grid.h"
#include "engine/neighbor/sphere_index.h"
#include "engine/simulation_state.h"

namespace talus::engine {

namespace {

constexpr int kMaxReports = 20;  // a wrong unit would give millions

// The first problems of a list of spheres; more are not worth looking for.
class OverlapReports {
 public:
  OverlapReports(const char* list, base::Problems& problems) : list_(list), problems_(problems) {}

  std::string NameOf(std::int64_t sphere) const {
    return list_ + ("[" + std::to_string(sphere) + "]");
  }
  void Overlaps(std::int64_t sphere, const std::string& other, double share) {
    Add(sphere, "overlaps " + other + " by " + std::to_string(share) +
                    " of the smaller radius: must be at most 0.25; move them apart");
  }
  void StandsIn(std::int64_t sphere, const std::string& wall) {
    Add(sphere, "stands in " + wall + "; move it out");
  }
  bool full() const { return num_ >= kMaxReports; }

 private:
  void Add(std::int64_t sphere, const std::string& message) {
    if (full()) return;
    ++num_;
    problems_.Add(NameOf(sphere) + ".position",
                  full() ? message + "; more are not listed" : message);
  }

  const char* list_;
  base::Problems& problems_;
  int num_ = 0;
};

// δ over the smaller radius [-].
double OverlapShare(const Particle& a, const Particle& b) {
  const double overlap = a.radius + b.radius - base::Norm(b.position - a.position);
  return overlap / std::min(a.radius, b.radius);
}

// Numbers of the spheres, near ones near each other: the order in which pairs are reported.
std::vector<std::int32_t> OrderOfCells(std::span<const Particle> spheres,
                                       const ParticleStore& store) {
  std::vector<std::int32_t> all(spheres.size());
  std::iota(all.begin(), all.end(), 0);
  double largest = 0;
  for (const Particle& p : spheres) largest = std::max(largest, p.radius);
  Grid grid;
  Team team(1);
  grid.Build(store.motion.data(), 8, all, 2 * largest, team);
  return {grid.order().begin(), grid.order().end()};
}

void CheckPairs(std::span<const Particle> spheres, const ParticleStore& store,
                OverlapReports& reports) {
  const std::vector<std::int32_t> order = OrderOfCells(spheres, store);
  std::vector<std::int32_t> place(order.size());  // in it, of each sphere
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = static_cast<std::int32_t>(k);
  const SphereIndex index(spheres);
  std::vector<std::int32_t> found;  // places
  for (const std::int32_t i : order) {
    if (reports.full()) return;
    found.clear();
    index.VisitNear(spheres[i].position, spheres[i].radius, [&](std::int32_t j) {
      const bool overlaps = OverlapShare(spheres[i], spheres[j]) > kMaxOverlapAtStart;
      if (overlaps && place[j] > place[i]) found.push_back(place[j]);
    });
    std::sort(found.begin(), found.end());
    for (const std::int32_t k : found) {
      const auto [first, second] = std::minmax(i, order[k]);
      reports.Overlaps(second, reports.NameOf(first), OverlapShare(spheres[i], spheres[order[k]]));
    }
  }
}

void CheckWalls(std::span<const Particle> spheres, ParticleStore& store, const WallSet& walls,
                OverlapReports& reports) {
  const KernelTable& kernels = ChooseKernels();
  StepView step{};
  step.motion = store.motion.data();
  step.walls = walls.views().data();
  std::vector<double> gaps(store.motion.size() / 8);
  for (int w = 0; w < walls.size(); ++w) {
    if (walls.Removed(w)) continue;
    kernels.wall_gaps(step, w, 0, static_cast<std::int64_t>(gaps.size()), gaps.data());
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      if (gaps[i] >= -kMaxOverlapAtStart * spheres[i].radius) continue;
      reports.StandsIn(static_cast<std::int64_t>(i), walls.NameOf(w));
    }
  }
}

// A box that holds all of the spheres.
struct Bounds {
  Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  explicit Bounds(std::span<const Particle> spheres) {
    for (const Particle& p : spheres) {
      const Vec3& x = p.position;
      low = {std::min(low.x, x.x - p.radius), std::min(low.y, x.y - p.radius),
             std::min(low.z, x.z - p.radius)};
      high = {std::max(high.x, x.x + p.radius), std::max(high.y, x.y + p.radius),
              std::max(high.z, x.z + p.radius)};
    }
  }
  bool Meets(const Vec3& x, double radius) const {
    return x.x > low.x - radius && x.x < high.x + radius && x.y > low.y - radius &&
           x.y < high.y + radius && x.z > low.z - radius && x.z < high.z + radius;
  }
};

// A batch of a pour is small beside what is there, most of which the box rules out.
void CheckPresent(const ParticleStore& present, std::span<const Particle> added,
                  OverlapReports& reports) {
  const SphereIndex index(added);
  const Bounds bounds(added);
  for (std::int64_t i = 0; i < present.num && !reports.full(); ++i) {
    const Particle there{
        .id = present.ids[i], .radius = present.Radius(i), .position = present.Position(i)};
    if (!bounds.Meets(there.position, there.radius)) continue;
    index.VisitNear(there.position, there.radius, [&](std::int32_t k) {
      const double share = OverlapShare(there, added[k]);
      if (share > kMaxOverlapAtStart) {
        reports.Overlaps(k, "the sphere with id " + std::to_string(there.id), share);
      }
    });
  }
}

}  // namespace

void ValidateOverlaps(const Scene& scene, base::Problems& problems) {
  OverlapReports reports("particles", problems);
  ParticleStore store;
  store.Assign(scene.particles, scene.materials);
  CheckPairs(scene.particles, store, reports);
  CheckWalls(scene.particles, store, WallSet(scene.walls), reports);
}

void ValidateAddedOverlaps(const SimulationState& state, std::span<const Particle> added,
                           base::Problems& problems) {
  OverlapReports reports("spheres", problems);
  ParticleStore store;
  store.Assign(added, state.materials);
  CheckPairs(added, store, reports);
  CheckPresent(state.particles, added, reports);
  CheckWalls(added, store, state.walls, reports);
}

}  // namespace talus::engine
