#include "engine/scaling.h"

#include <algorithm>

namespace talus::engine {

namespace {

struct Share {
  std::int64_t begin, end;
};

// As of Team::ShareOf.
Share ShareOf(std::int64_t member, std::int64_t size, std::int64_t count) {
  return {count * member / size, count * (member + 1) / size};
}

// Until the last of `cores` has moved its chunks.
double StepPath(std::span<const ChunkTimes> chunks, std::int64_t reach, std::int64_t cores) {
  const auto count = static_cast<std::int64_t>(chunks.size());
  double ready = 0, end = 0;
  for (std::int64_t member = 0; member < cores; ++member) {
    const Share share = ShareOf(member, cores, count);
    const std::int64_t moves_from = member == 0 ? 0 : std::min(share.begin + reach, share.end);
    double first_part = 0, delayed = 0;
    for (std::int64_t c = share.begin; c < share.end; ++c) {
      first_part += chunks[c].forces;
      (c >= moves_from ? first_part : delayed) += chunks[c].motion;
    }
    ready = std::max(ready, first_part);
    end = std::max(end, ready + delayed);
  }
  return end;
}

double SearchPath(std::span<const ChunkTimes> chunks, std::int64_t cores) {
  double longest = 0;
  for (std::int64_t member = 0; member < cores; ++member) {
    const Share share = ShareOf(member, cores, static_cast<std::int64_t>(chunks.size()));
    double sum = 0;
    for (std::int64_t c = share.begin; c < share.end; ++c) sum += chunks[c].search;
    longest = std::max(longest, sum);
  }
  return longest;
}

}  // namespace

void ScalingProbe::AddStep(std::span<const ChunkTimes> chunks, std::int64_t reach, double alone) {
  double sum = 0, longest = 0;
  for (const ChunkTimes& chunk : chunks) {
    sum += chunk.forces;
    longest = std::max(longest, chunk.forces);
  }
  for (int k = 0; k < kNumCores; ++k) steps_.shared[k] += StepPath(chunks, reach, kCores[k]);
  steps_.alone += alone;
  ++steps_.count;
  longest_ += longest;
  mean_ += sum / static_cast<double>(chunks.size());
  num_chunks_ = static_cast<std::int64_t>(chunks.size());
}

void ScalingProbe::AddList(std::span<const ChunkTimes> chunks, double alone, double even) {
  for (int k = 0; k < kNumCores; ++k) lists_.shared[k] += SearchPath(chunks, kCores[k]);
  AddEven(even);
  lists_.alone += alone;
  ++lists_.count;
}

void ScalingProbe::AddEven(double seconds) {
  for (int k = 0; k < kNumCores; ++k) lists_.shared[k] += seconds / kCores[k];
}

ScalingEstimate ScalingProbe::Estimate(std::int64_t num_steps) const {
  ScalingEstimate estimate;
  estimate.num_chunks = num_chunks_;
  if (steps_.count == 0 || mean_ == 0) return estimate;
  const double steps_a_sample = static_cast<double>(num_steps) / static_cast<double>(steps_.count);
  const auto shared = [&](int k) { return steps_a_sample * steps_.shared[k] + lists_.shared[k]; };
  const double alone = steps_a_sample * steps_.alone + lists_.alone;
  const double one_core = shared(0) + alone;
  estimate.parallel_share = shared(0) / one_core;
  estimate.imbalance = longest_ / mean_;
  for (int k = 1; k < kNumCores; ++k) {
    estimate.speed_ups.push_back({kCores[k], one_core / (shared(k) + alone)});
  }
  return estimate;
}

}  // namespace talus::engine
