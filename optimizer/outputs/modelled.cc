#include "optimizer/outputs/modelled.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace talus::optimizer {
namespace {

std::vector<std::size_t> Choose(const OutputData& data, std::span<const double> values, int count) {
  std::vector<std::size_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (count <= kMostEvaluations) return order;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (data.level[a] != data.level[b]) return data.level[a] > data.level[b];
    return values[a] < values[b];
  });
  constexpr std::size_t kHalf = kMostEvaluations / 2;
  std::vector<std::size_t> chosen(order.begin(), order.begin() + kHalf);
  std::vector<std::size_t> others(order.begin() + kHalf, order.end());
  std::sort(others.begin(), others.end());
  for (std::size_t i = 0; i < kHalf; ++i) chosen.push_back(others[i * others.size() / kHalf]);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

OutputData Modelled(const OutputData& data, std::span<const double> values, int count) {
  OutputData modelled;
  for (const std::size_t i : Choose(data, values, count)) {
    modelled.points.push_back(data.points[i]);
    modelled.level.push_back(data.level[i]);
    if (!data.vectors.empty()) modelled.vectors.push_back(data.vectors[i]);
    modelled.scalars.push_back(data.scalars[i]);
  }
  return modelled;
}

}  // namespace talus::optimizer
