#include "engine/scene/pour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <unordered_set>

#include "base/random.h"
#include "base/sphere.h"
#include "engine/bodies/wall_set.h"
#include "engine/kernel/shapes.h"

namespace talus::engine {
namespace {

constexpr double kBulk = 0.58;        // solid fraction in the funnel
constexpr double kStream = 0.22;      // solid fraction just below its mouth
constexpr double kSlabDiameters = 2;  // height of a batch, in largest diameters
constexpr int kTries = 500;           // places tried for a grain before it waits

double Largest(const std::vector<double>& radii) {
  return radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
}

bool ClearOfWalls(const WallSet& walls, const Vec3& at, double radius) {
  for (int w = 0; w < walls.size(); ++w) {
    if (Nearest(walls.views()[w], Vector<double>{at.x, at.y, at.z}).distance < radius) return false;
  }
  return true;
}

// The walls that are there now.
WallSet PresentWalls(const Simulation& simulation) {
  std::vector<Wall> walls;
  for (int w = 0; w < static_cast<int>(simulation.Walls().size()); ++w) {
    if (!simulation.IsRemoved(w)) walls.push_back(simulation.Walls()[w]);
  }
  return WallSet(walls);
}

Vec3 Across(const Vec3& down) {
  const Vec3 other = std::abs(down.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = Cross(down, other);
  return across / base::Norm(across);
}

}  // namespace

// Spheres by place, to ask what a further one would touch.
class Occupied {
 public:
  explicit Occupied(double cell) : cell_(cell) {}

  void Add(const Particle& p) { cells_[Key(p.position, 0, 0, 0)].push_back(p); }

  bool Free(const Vec3& at, double radius) const {
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find(Key(at, dx, dy, dz));
          if (found == cells_.end()) continue;
          for (const Particle& p : found->second) {
            if (base::Norm(p.position - at) < radius + p.radius) return false;
          }
        }
      }
    }
    return true;
  }

 private:
  std::int64_t Key(const Vec3& at, int dx, int dy, int dz) const {
    const auto index = [&](double x, int d) {
      return (static_cast<std::int64_t>(std::floor(x / cell_)) + d) & 0xfffff;
    };
    return index(at.x, dx) << 40 | index(at.y, dy) << 20 | index(at.z, dz);
  }

  double cell_;
  std::unordered_map<std::int64_t, std::vector<Particle>> cells_;
};

// What is near the mouth.
struct Pour::Surroundings {
  Occupied spheres;
  WallSet walls;
};

void PourSpec::Validate(base::Problems& problems) const {
  problems.RequirePositive("mass", mass);
  problems.RequirePositive("mouth_diameter", mouth_diameter);
  problems.RequirePositive("rate", rate);
  problems.Require(scatter >= 0 && std::isfinite(scatter), "scatter", scatter,
                   "must not be negative");
  problems.Require(start >= 0 && std::isfinite(start), "start", start, "must not be negative");
  problems.Require(base::IsFinite(mouth), "mouth", "must be finite");
}

double BeverlooRate(const PourPlan& plan, double scale_factor) {
  double cubes = 0, fourths = 0;
  for (const double r : plan.radii) {
    cubes += r * r * r;
    fourths += r * r * r * r;
  }
  const double mean = 2 * fourths / cubes / scale_factor;
  const double free = std::max(plan.mouth_diameter - 1.4 * mean, 0.2 * plan.mouth_diameter);
  return 0.58 * kBulk * plan.density * std::sqrt(base::Norm(plan.gravity)) * std::pow(free, 2.5);
}

// Not so slow that grains hang above the mouth for long. Centres keep a radius from its rim: where
// that leaves little of it, so full a stream finds no room, and up to a tenth of the rate waited.
double StreamSpeed(const PourPlan& plan) {
  constexpr double kRoomy = 2.2;  // largest diameters
  const double wide = plan.mouth_diameter / (kRoomy * 2 * Largest(plan.radii));
  const double stream = kStream * std::min(1.0, wide * wide);
  const double area = std::numbers::pi / 4 * plan.mouth_diameter * plan.mouth_diameter;
  const double least = std::sqrt(2 * Largest(plan.radii) * base::Norm(plan.gravity));
  return std::max(least, plan.rate / (stream * plan.density * area));
}

Pour::Pour(PourPlan plan)
    : plan_(std::move(plan)),
      speed_(StreamSpeed(plan_)),
      slab_(kSlabDiameters * 2 * Largest(plan_.radii)) {
  double sum = 0;
  for (const double r : plan_.radii) {
    sum += base::SphereVolume(r) * plan_.density;
    cum_.push_back(sum);
  }
}

bool Pour::Done(const PourState& state) const {
  return state.num_poured == static_cast<std::int64_t>(plan_.radii.size());
}

double Pour::Interval() const { return slab_ / speed_; }

double Pour::Duration() const { return cum_.empty() ? 0 : cum_.back() / plan_.rate; }

double Pour::MaxSpeed() const { return std::hypot(speed_, std::numbers::sqrt2 * plan_.scatter); }

double Pour::SmallestRadius() const { return std::ranges::min(plan_.radii); }

double Pour::NextTime(const PourState& state) const {
  if (Done(state)) return std::numeric_limits<double>::infinity();
  return plan_.start + static_cast<double>(state.num_batches) * Interval();
}

Vec3 Pour::Down() const { return plan_.gravity / base::Norm(plan_.gravity); }

Vec3 Pour::Mouth(const PourState& state) const {
  const double poured = state.num_poured > 0 ? cum_[state.num_poured - 1] : 0;
  return plan_.mouth - (plan_.rise * poured + state.lift) * Down();
}

// The stream falls at its speed at the mouth or faster; what is slower than half of it and touches
// something lies there. A grain that bounces is slow in the air, too.
double Pour::LiftOver(const Simulation& simulation) const {
  const double reach = plan_.mouth_diameter / 2;
  std::unordered_set<std::int64_t> touching;
  for (const ContactInfo& contact : simulation.Contacts()) {
    touching.insert(contact.first);
    touching.insert(contact.second);
  }
  double lift = 0;
  for (const Particle& p : simulation.Particles()) {
    if (!touching.contains(p.id)) continue;
    const Vec3 from_mouth = p.position - plan_.mouth;
    const double depth = Dot(from_mouth, Down());
    const bool is_below = base::Norm(from_mouth - depth * Down()) < reach;
    if (!is_below || base::Norm(p.velocity) > speed_ / 2) continue;
    lift = std::max(lift, plan_.clearance.value() - (depth - p.radius));
  }
  return lift;
}

// Where the grain k touches nothing, if a place is found. Each batch tries other places, for grains
// that waited.
std::optional<Particle> Pour::Place(std::int64_t k, const PourState& state,
                                    const Surroundings& around) const {
  const Vec3 down = Down();
  const Vec3 across = Across(down), other = Cross(down, across);
  const double r = plan_.radii[static_cast<std::size_t>(k)];
  base::Random random(
      base::Random(plan_.seed, base::Stream("pour"), static_cast<std::uint64_t>(state.num_batches))
          .Next(),
      base::Stream("pour grain"), static_cast<std::uint64_t>(k));
  const Vec3 mouth = Mouth(state);
  for (int t = 0; t < kTries; ++t) {
    const double reach = (plan_.mouth_diameter / 2 - r) * std::sqrt(random.Uniform());
    const double angle = 2 * std::numbers::pi * random.Uniform();
    const Vec3 at = mouth + reach * std::cos(angle) * across + reach * std::sin(angle) * other -
                    slab_ * random.Uniform() * down;
    if (!around.spheres.Free(at, r) || !ClearOfWalls(around.walls, at, r)) continue;
    const double u = random.Uniform(-plan_.scatter, plan_.scatter);
    const double v = random.Uniform(-plan_.scatter, plan_.scatter);
    return Particle{.id = plan_.first_id + k,
                    .material = plan_.material,
                    .radius = r,
                    .position = at,
                    .velocity = speed_ * down + u * across + v * other,
                    .angular_velocity = {}};
  }
  return std::nullopt;
}

std::vector<Particle> Pour::Batch(const Simulation& simulation, const PourState& state) const {
  const Vec3 down = Down();
  const double due = plan_.rate * Interval() * static_cast<double>(state.num_batches + 1);
  const double largest = std::max(Largest(plan_.radii), simulation.LargestRadius());
  Surroundings around{Occupied(2 * largest), PresentWalls(simulation)};
  for (const Particle& p : simulation.Particles()) {
    const double height = Dot(Mouth(state) - p.position, down);
    if (height > -2 * largest && height < slab_ + 2 * largest) around.spheres.Add(p);
  }
  std::vector<Particle> batch;
  const auto num = static_cast<std::int64_t>(cum_.size());
  for (auto k = state.num_poured; k < num && (k == 0 || cum_[k - 1] < due); ++k) {
    const std::optional<Particle> placed = Place(k, state, around);
    if (!placed) break;
    batch.push_back(*placed);
    around.spheres.Add(*placed);
  }
  return batch;
}

void Pour::Advance(Simulation& simulation, PourState& state) const {
  if (simulation.time() < NextTime(state)) return;
  if (plan_.clearance) state.lift = std::max(state.lift, LiftOver(simulation));
  const std::vector<Particle> batch = Batch(simulation, state);
  simulation.Add(batch);
  state.num_poured += static_cast<std::int64_t>(batch.size());
  while (NextTime(state) <= simulation.time()) ++state.num_batches;
}

}  // namespace talus::engine
