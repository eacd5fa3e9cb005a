#include "engine/neighbor/pair_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::engine {

namespace {

// Spheres larger than this times the median are large, if the largest is four times the median:
// below that, looking at some pairs in vain costs less (bench/engine_sizes).
constexpr double kSmallOverMedian = 1.25;
constexpr double kLargestOverMedian = 4;

// For spheres at most this large the cells must be wide enough.
double LargestSmall(std::vector<double>& radii, double smallest, double largest) {
  if (radii.empty() || largest <= kLargestOverMedian * smallest) return largest;
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return largest <= kLargestOverMedian * *middle ? largest : kSmallOverMedian * *middle;
}

}  // namespace

void PairSearch::Sort(const ParticleStore& particles, std::span<const std::int32_t> alive,
                      double reach, Team& team) {
  reach_ = reach;
  largest_ = 0;
  double smallest = std::numeric_limits<double>::infinity();
  scratch_.clear();
  for (const std::int32_t i : alive) {
    scratch_.push_back(particles.Radius(i));
    largest_ = std::max(largest_, scratch_.back());
    smallest = std::min(smallest, scratch_.back());
  }
  const double small = LargestSmall(scratch_, smallest, largest_);
  smallest_large_ =
      small < largest_ ? std::nextafter(small, largest_) : std::numeric_limits<double>::infinity();
  grid_.Build(particles.motion.data(), 8, alive, 2 * small + reach, team);
}

void PairSearch::NoteLarge(const ParticleStore& particles) {
  if (!HasLarge()) return;
  const auto visit_large = [&](auto&& visit) {
    for (std::int64_t i = 0; i < particles.num; ++i) {
      const double radius = particles.Radius(i);
      if (!IsLarge(radius)) continue;
      // Whoever looks into the list is smaller.
      grid_.VisitBox(&particles.motion[8 * i], 2 * radius + reach_,
                     [&](std::int64_t cell) { visit(static_cast<std::int32_t>(i), cell); });
    }
  };
  large_start_.assign(grid_.num_cells() + 1, 0);
  visit_large([&](std::int32_t, std::int64_t cell) { ++large_start_[cell + 1]; });
  for (std::int64_t c = 0; c < grid_.num_cells(); ++c) large_start_[c + 1] += large_start_[c];
  large_.resize(large_start_.back());
  visit_large([&](std::int32_t i, std::int64_t cell) { large_[large_start_[cell]++] = i; });
  std::copy_backward(large_start_.begin(), large_start_.end() - 1, large_start_.end());
  large_start_[0] = 0;
}

// Appends what is near in the range.
void PairSearch::Scan(const KernelTable& kernels, const ParticleStore& particles, std::int64_t i,
                      IndexRange range, NearSpheres& found) const {
  range.begin = std::max(range.begin, i + 1);
  if (range.begin >= range.end) return;
  const CloudView cloud{particles.old_x.data(), particles.old_y.data(), particles.old_z.data(),
                        particles.radius.data()};
  const std::size_t touching = found.touching.size(), near = found.near.size();
  const std::size_t room = range.end - range.begin + kBlock;
  if (found.touching.capacity() < touching + room) found.touching.reserve(2 * (touching + room));
  if (found.near.capacity() < near + room) found.near.reserve(2 * (near + room));
  found.touching.resize(touching + room);
  found.near.resize(near + room);
  SearchLists lists{found.touching.data() + touching, found.near.data() + near, 0, 0};
  kernels.search(cloud, {i, range.begin, range.end, reach_}, lists);
  found.touching.resize(touching + lists.num_touching);
  found.near.resize(near + lists.num_near);
}

void PairSearch::AddLarger(const ParticleStore& particles, std::int64_t i,
                           NearSpheres& found) const {
  const double radius = particles.Radius(i);
  const Vec3 at = particles.Position(i);
  const std::int64_t cell = grid_.CellOfSorted(i);
  for (std::int32_t k = large_start_[cell]; k < large_start_[cell + 1]; ++k) {
    const std::int32_t j = large_[k];
    if (j <= i || particles.radius[j] <= radius) continue;
    const double radii = radius + particles.radius[j];
    const Vec3 offset = particles.Position(j) - at;
    const double square = Dot(offset, offset);
    if (!(square < (radii + reach_) * (radii + reach_))) continue;
    (square < radii * radii ? found.touching : found.near).push_back(j);
  }
}

void PairSearch::FindLater(const KernelTable& kernels, const ParticleStore& particles,
                           std::int64_t i, NearSpheres& found) const {
  found.touching.clear();
  found.near.clear();
  const double radius = particles.Radius(i);
  const auto scan = [&](const IndexRange& range) { Scan(kernels, particles, i, range, found); };
  if (!IsLarge(radius)) {
    for (const IndexRange& range : grid_.LaterNeighbors(i)) scan(range);
  } else {
    grid_.VisitLaterInBox(i, &particles.motion[8 * i], 2 * radius + reach_, scan);
  }
  if (!HasLarge()) return;
  // Those come from the list.
  const auto larger = [&](std::int32_t j) {
    return IsLarge(particles.radius[j]) && particles.radius[j] > radius;
  };
  std::erase_if(found.touching, larger);
  std::erase_if(found.near, larger);
  AddLarger(particles, i, found);
}

}  // namespace talus::engine
