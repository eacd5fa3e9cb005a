// The walls of a running simulation: where they are, how they move, and what the kernels see.
#pragma once

#include <cstdint>
#include <vector>

#include "base/problems.h"
#include "engine/kernel/kernel.h"
#include "engine/wall.h"

namespace talus::engine {

// Bad sizes, directions that are none, times that do not increase, a material that is not there.
void ValidateWall(const Wall& wall, int num_materials, base::Problems& problems);

class WallSet {
 public:
  WallSet() = default;
  explicit WallSet(std::vector<Wall> walls);  // makes the directions unit vectors

  // Sets the velocities that hold from `time` on. A motion starts at the step nearest to its time.
  void SetTime(double time, double time_step);
  void Move(double time_step);  // at the velocities set

  void SetMotion(int wall, std::vector<MotionStep> motion) {
    walls_[wall].motion = std::move(motion);
  }
  void Remove(int wall) { removed_[wall] = 1; }
  bool Removed(int wall) const { return removed_[wall] != 0; }

  // Largest speed that any wall has now, or is to have at any time [m/s].
  double MaxSpeed() const;
  double MaxPrescribedSpeed() const;

  int size() const { return static_cast<int>(walls_.size()); }
  const std::vector<Wall>& walls() const { return walls_; }
  const std::vector<WallView>& views() const { return views_; }

  // For the checkpoint.
  const std::vector<std::uint8_t>& removed() const { return removed_; }
  void Restore(std::vector<Wall> walls, std::vector<std::uint8_t> removed);

 private:
  void Refresh();  // the views from the walls

  std::vector<Wall> walls_;
  std::vector<WallView> views_;
  std::vector<std::uint8_t> removed_;
};

}  // namespace talus::engine
