// The walls of a running simulation: where they are, how they move, and what the kernels see.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/problems.h"
#include "engine/bodies/press.h"
#include "engine/bodies/wall.h"
#include "engine/kernel/kernel.h"

namespace talus::engine {

// Bad sizes, directions that are none, times that do not increase, a material that is not there, a
// plane that turns.
void ValidateWall(const Wall& wall, int num_materials, base::Problems& problems);

// Largest speed at which its surface is to move out of itself by its prescribed motion [m/s]: a
// belt and a disc that turns about its axis stay in their planes.
double MaxPassingSpeed(const Wall& wall);

class WallSet {
 public:
  WallSet() = default;
  explicit WallSet(std::vector<Wall> walls);  // makes the directions unit vectors

  // Sets the mean velocities over the step that begins at `time`. In a step whose motion changes at
  // one of its ends only, that is the velocity of the entry.
  void SetTime(double time, double time_step);
  void Move(double time_step);  // at the velocities set

  // What is pressed goes on at its speed in `presses`.
  void SetPresses(std::vector<Press> presses);
  // New speeds of the pressed walls, under the load on each press [N].
  void Push(std::span<const double> loads, double time_step);

  // Takes away the walls whose time is up at the step nearest to it; true when there were any.
  bool RemoveDue(double time, double time_step);

  void SetMotion(int wall, std::vector<MotionStep> motion) {
    walls_[wall].motion = std::move(motion);
  }
  void Remove(int wall) { removed_[wall] = 1; }
  bool Removed(int wall) const { return removed_[wall] != 0; }

  // Largest speed at which the place of any wall's surface changes now [m/s]. A drum that turns
  // about its own axis stays where it is.
  double MaxSpeed() const;

  // Largest speed that a wall's surface is to have at any time, or has where it is pressed and
  // nothing holds it [m/s].
  double MaxPrescribedSpeed() const;

  int size() const { return static_cast<int>(walls_.size()); }
  const std::vector<Wall>& walls() const { return walls_; }
  std::string NameOf(int wall) const;  // in a message: the wall "lid", or walls[2] without a name
  const std::vector<WallView>& views() const { return views_; }
  const std::vector<Press>& presses() const { return presses_; }

  // For the checkpoint.
  const std::vector<std::uint8_t>& removed() const { return removed_; }
  void Restore(std::vector<Wall> walls, std::vector<std::uint8_t> removed,
               std::vector<Press> presses);

 private:
  void Refresh();  // the views from the walls
  void Turn(std::size_t wall, double time_step);
  void AddSpeed(const Press& press, double speed);  // to the walls' velocities [m/s]

  std::vector<Wall> walls_;
  std::vector<WallView> views_;
  std::vector<std::uint8_t> removed_;
  std::vector<Press> presses_;
};

}  // namespace talus::engine
