// The photographs of two batches, compared without any model: were the runs dealt out to them by
// chance, how often would the mean profiles differ as much?
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "experiments/analysis/batches/batches.h"
#include "experiments/campaign/answer/joint_view.h"
#include "imaging/gray_image.h"

namespace talus::analysis {

// Those of the first batch's experiment `e`, their plates' middles at one place.
BatchPictures ComparePictures(const campaign::JointView& first, const campaign::JointView& batch,
                              std::size_t e);

// Share of the ways to deal `first` and `second` out anew in which their means differ by as much as
// they do, this one among them: all ways where they are few, else 5000 by chance.
struct PermutationTest {
  double distance_px = 0;  // SAD of the means
  double probability = 1;
  int num_arrangements = 0;
};
PermutationTest Permute(const std::vector<imaging::GrayImage>& first,
                        const std::vector<imaging::GrayImage>& second, std::uint64_t seed);

}  // namespace talus::analysis
