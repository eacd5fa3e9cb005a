// How wide the neighbour list reaches beyond contact, and when it must be made anew.
//
// With a skin s, a step costs c n s for the n s pairs a particle that are listed but do not touch,
// and a rebuild C every s/r steps, where r is the way used up in a step. The sum c n s + C r/s is
// least at s = √(C r / (c n)). n and r are measured since the last rebuild; C/c is the ratio of two
// times that hardly depends on the scene. All of it follows from the state, never from a clock, so
// that the same run rebuilds at the same steps.
#pragma once

#include <cstdint>

namespace talus::engine {

class SkinTuner {
 public:
  static constexpr double kLargestSkin = 0.6;  // in smallest radii

  SkinTuner() = default;
  explicit SkinTuner(double smallest_radius);

  double skin() const { return skin_; }  // [m]
  std::int64_t num_rebuilds() const { return num_rebuilds_; }

  // Spheres of this radius are there from now on: the skin keeps to its bounds for the smallest.
  // The list is to be made anew.
  void Admit(double radius);

  // A step has moved nothing by more than `distance`. True when the list may miss a contact unless
  // CheckDisplacement says otherwise.
  bool Step(double distance) {
    ++steps_;
    margin_ -= 2 * distance;
    return margin_ < 0 || (steps_ & (kReviewInterval - 1)) == 0;
  }

  // `used` is the largest sum of two displacements since the rebuild, `step_distance` as in Step.
  // True when the list must be made anew.
  bool CheckDisplacement(double used, double step_distance);

  // A list of `pairs`, `touching` of them, has been made for `particles`.
  void Rebuilt(std::int64_t particles, std::int64_t pairs, std::int64_t touching);

  // Chooses the skin of the next list; to be called before it is made.
  void Retune();

 private:
  static constexpr std::int64_t kReviewInterval = 512;  // power of two [steps]

  double BestSkin() const;

  double skin_ = 0;
  double smallest_ = 0;  // bounds of the skin [m]
  double largest_ = 0;
  double margin_ = 0;         // what may still be used up [m]
  double used_ = 0;           // at the last check [m]
  double near_per_skin_ = 0;  // n: pairs a particle and metre of skin [1/m]
  std::int64_t steps_ = 0;    // since the rebuild
  std::int64_t num_rebuilds_ = 0;
};

}  // namespace talus::engine
