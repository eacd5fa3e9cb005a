#include "engine/neighbor/skin_tuner.h"

#include <algorithm>
#include <cmath>

namespace talus::engine {

namespace {

// C/c: a rebuild, a particle, over one listed pair that does not touch, a step. Measured with
// bench/engine_throughput (docs/engine.md).
constexpr double kRebuildOverPair = 150;

constexpr double kFirstSkin = 0.08;  // in smallest radii, as are the bounds
constexpr double kSmallestSkin = 0.01;

}  // namespace

SkinTuner::SkinTuner(double smallest_radius)
    : skin_(kFirstSkin * smallest_radius),
      smallest_(kSmallestSkin * smallest_radius),
      largest_(kLargestSkin * smallest_radius) {}

void SkinTuner::Admit(double radius) {
  smallest_ = std::min(smallest_, kSmallestSkin * radius);
  largest_ = std::min(largest_, kLargestSkin * radius);
  skin_ = std::min(skin_, largest_);
}

double SkinTuner::BestSkin() const {
  if (steps_ == 0) return skin_;
  const double used_a_step = used_ / static_cast<double>(steps_);
  const double best = std::sqrt(kRebuildOverPair * used_a_step / std::max(near_per_skin_, 1e-300));
  return std::clamp(best, std::max(smallest_, skin_ / 2), std::min(largest_, 2 * skin_));
}

bool SkinTuner::CheckDisplacement(double used, double step_distance) {
  used_ = used;
  margin_ = skin_ - used;
  if (margin_ < 4 * step_distance || margin_ < 0.02 * skin_) return true;
  return steps_ >= 2 * kReviewInterval && BestSkin() < 0.7 * skin_;
}

void SkinTuner::Retune() { skin_ = std::clamp(BestSkin(), smallest_, largest_); }

void SkinTuner::Rebuilt(std::int64_t particles, std::int64_t pairs, std::int64_t touching) {
  near_per_skin_ = static_cast<double>(pairs - touching) /
                   (skin_ * static_cast<double>(std::max<std::int64_t>(particles, 1)));
  margin_ = skin_;
  used_ = 0;
  steps_ = 0;
  ++num_rebuilds_;
}

}  // namespace talus::engine
