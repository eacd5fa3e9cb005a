#include "experiments/rigs/lifted_tube/connectivity.h"

#include <numeric>

#include "engine/run/resisted_spins.h"

namespace talus::rigs {
namespace {

constexpr std::int64_t WallId(int wall) { return -1 - wall; }

// Sets that are merged pair by pair, with path halving.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Merge(std::size_t i, std::size_t j) { parent_[Find(i)] = Find(j); }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace

Connectivity Connect(std::span<const engine::Particle> particles,
                     std::span<const engine::ContactInfo> contacts) {
  const std::size_t n = particles.size();
  const engine::PlaceOfId place_of(particles);
  Sets sets(n);
  std::vector<bool> touches_plate(n, false);
  std::vector<bool> touches_tube(n, false);
  for (const engine::ContactInfo& contact : contacts) {
    const std::size_t i = place_of(contact.first);
    if (contact.second >= 0) sets.Merge(i, place_of(contact.second));
    if (contact.second == WallId(kPlate)) touches_plate[i] = true;
    if (contact.second == WallId(kTube)) touches_tube[i] = true;
  }
  std::vector<bool> set_on_plate(n, false);
  std::vector<bool> set_on_tube(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    if (touches_plate[i]) set_on_plate[sets.Find(i)] = true;
    if (touches_tube[i]) set_on_tube[sets.Find(i)] = true;
  }
  Connectivity result{.on_plate = std::vector<bool>(n), .on_tube = std::vector<bool>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t set = sets.Find(i);
    result.on_plate[i] = set_on_plate[set];
    result.on_tube[i] = set_on_tube[set] && !set_on_plate[set];
    result.tube_touches_heap |= touches_tube[i] && result.on_plate[i];
  }
  return result;
}

}  // namespace talus::rigs
