// The pairs of spheres that are near, whatever their sizes.
//
// Cells as wide as the largest sphere hold thousands of small ones. So where sizes differ much,
// cells are as wide as the small spheres need, and each cell knows the large spheres in whose
// neighbourhood it lies. A small sphere looks for small ones in the cells around it, and for large
// ones in its cell's list; a large sphere looks for those not larger than itself in a box around it
// and for larger ones in the list. So each pair is found once, by the one that comes first in the
// order of the cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/bodies/particle_store.h"
#include "engine/kernel/kernel.h"
#include "engine/neighbor/grid.h"

namespace talus::engine {

// Spheres after one in the order, near it.
struct NearSpheres {
  std::vector<std::int32_t> touching, near;
};

class PairSearch {
 public:
  // Sorts the particles `alive` into cells, for pairs with a gap below `reach`.
  void Sort(const ParticleStore& particles, std::span<const std::int32_t> alive, double reach,
            Team& team);

  // Index of each particle, cell after cell.
  std::span<const std::int32_t> order() const { return grid_.order(); }

  // The particles have been put into that order.
  void NoteLarge(const ParticleStore& particles);

  // Replaces `found` by the later particles near the i-th; `found` keeps its memory.
  void FindLater(const KernelTable& kernels, const ParticleStore& particles, std::int64_t i,
                 NearSpheres& found) const;

 private:
  bool HasLarge() const { return smallest_large_ <= largest_; }
  bool IsLarge(double radius) const { return radius >= smallest_large_; }
  void Scan(const KernelTable& kernels, const ParticleStore& particles, std::int64_t i,
            IndexRange range, NearSpheres& found) const;
  void AddLarger(const ParticleStore& particles, std::int64_t i, NearSpheres& found) const;

  Grid grid_;
  double reach_ = 0;                       // [m]
  double largest_ = 0;                     // radius [m]
  double smallest_large_ = 0;              // spheres from this radius on are large [m]
  std::vector<std::int32_t> large_start_;  // of each cell in `large_`, and the end
  std::vector<std::int32_t> large_;        // large spheres near the cell
  std::vector<double> scratch_;
};

}  // namespace talus::engine
