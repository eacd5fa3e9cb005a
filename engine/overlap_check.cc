#include "engine/overlap_check.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "engine/bodies/particle_store.h"
#include "engine/bodies/wall_set.h"
#include "engine/kernel/dispatch.h"
#include "engine/neighbor/grid.h"

namespace talus::engine {

namespace {

constexpr int kMaxReports = 20;  // a wrong unit would give millions

class OverlapCheck {
 public:
  OverlapCheck(const Scene& scene, base::Problems& problems) : scene_(scene), problems_(problems) {
    particles_.Assign(scene.particles, scene.materials);
  }

  void CheckSpheres() {
    std::vector<std::int32_t> all(scene_.particles.size());
    std::iota(all.begin(), all.end(), 0);
    double largest = 0;
    for (const Particle& p : scene_.particles) largest = std::max(largest, p.radius);
    Grid grid;
    Team team(1);
    grid.Build(particles_.motion.data(), 8, all, 2 * largest, team);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (const IndexRange& range : grid.LaterNeighbors(static_cast<std::int64_t>(i))) {
        for (std::int64_t j = range.begin; j < range.end; ++j) {
          CheckPair(grid.order()[i], grid.order()[j]);
        }
      }
    }
  }

  void CheckWalls() {
    const KernelTable& kernels = ChooseKernels();
    const WallSet walls(scene_.walls);
    StepView step{};
    step.motion = particles_.motion.data();
    step.walls = walls.views().data();
    std::vector<double> gaps(particles_.motion.size() / 8);
    for (int w = 0; w < walls.size(); ++w) {
      kernels.wall_gaps(step, w, 0, static_cast<std::int64_t>(gaps.size()), gaps.data());
      for (std::size_t i = 0; i < scene_.particles.size(); ++i) {
        if (gaps[i] >= -kMaxOverlap * scene_.particles[i].radius) continue;
        Report(static_cast<std::int32_t>(i), "stands in " + NameOfWall(w) + "; move it out");
      }
    }
  }

 private:
  std::string NameOfWall(int w) const {
    const std::string& name = scene_.walls[static_cast<std::size_t>(w)].name;
    return name.empty() ? "walls[" + std::to_string(w) + "]" : "the wall \"" + name + "\"";
  }
  void CheckPair(std::int32_t i, std::int32_t j) {
    const Particle& a = scene_.particles[i];
    const Particle& b = scene_.particles[j];
    const double overlap = a.radius + b.radius - base::Norm(b.position - a.position);
    const double share = overlap / std::min(a.radius, b.radius);
    if (share <= kMaxOverlap) return;
    Report(std::max(i, j), "overlaps particles[" + std::to_string(std::min(i, j)) + "] by " +
                               std::to_string(share) +
                               " of the smaller radius: must be at most 0.25; move them apart");
  }

  void Report(std::int32_t i, const std::string& message) {
    if (++num_reports_ > kMaxReports) return;
    problems_.Add("particles[" + std::to_string(i) + "].position",
                  num_reports_ < kMaxReports ? message : message + "; more are not listed");
  }

  const Scene& scene_;
  base::Problems& problems_;
  ParticleStore particles_;
  int num_reports_ = 0;
};

}  // namespace

void ValidateOverlaps(const Scene& scene, base::Problems& problems) {
  OverlapCheck check(scene, problems);
  check.CheckSpheres();
  check.CheckWalls();
}

}  // namespace talus::engine
