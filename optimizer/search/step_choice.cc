#include "optimizer/search/step_choice.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace talus::optimizer {
namespace {

constexpr int kNumKinds = 3;
constexpr double kMemory = 0.85;  // weight of a step relative to the one after it
// A smaller gain, as a share of the spread of the first values, is none: a step that polishes what
// is found would keep all others from looking elsewhere.
constexpr double kLeastGain = 1e-6;
constexpr double kExpectedShare = 0.3;  // of a kind of which nothing is remembered

struct Record {
  double steps = 0;
  double improvements = 0;

  double Share() const { return (improvements + kExpectedShare) / (steps + 1); }
};

// The largest share; of equals the first after `last`, in turn.
int MostPromising(const std::array<Record, kNumKinds>& records, int last) {
  int best = (last + 1) % kNumKinds;
  for (int i = 2; i <= kNumKinds; ++i) {
    const int kind = (last + i) % kNumKinds;
    if (records[static_cast<std::size_t>(kind)].Share() >
        records[static_cast<std::size_t>(best)].Share()) {
      best = kind;
    }
  }
  return best;
}

}  // namespace

// Judged by the first values alone, so that it stays the same.
double LeastGain(const Eigen::VectorXd& values, int num_before) {
  if (values.size() == 0) return 0;
  std::vector<double> first(values.begin(),
                            values.begin() + std::min<Eigen::Index>(num_before, values.size()));
  std::sort(first.begin(), first.end());
  return kLeastGain * (first[first.size() / 2] - first.front());
}

Step NextStep(const Eigen::VectorXd& values, int num_before, int num_pending) {
  std::array<Record, kNumKinds> records;
  int kind = 0;
  const double least_gain = LeastGain(values, num_before);
  double lowest = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < values.size() + num_pending; ++i) {
    const double value = i < values.size() ? values[i] : lowest;
    if (i >= num_before) {
      for (Record& record : records) {
        record.steps *= kMemory;
        record.improvements *= kMemory;
      }
      Record& taken = records[static_cast<std::size_t>(kind)];
      taken.steps += 1;
      taken.improvements += lowest - value > least_gain ? 1 : 0;
      kind = MostPromising(records, kind);
    }
    lowest = std::min(lowest, value);
  }
  return static_cast<Step>(kind);
}

}  // namespace talus::optimizer
