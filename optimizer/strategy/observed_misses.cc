#include "optimizer/strategy/observed_misses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimizer/space/point_rows.h"

namespace talus::optimizer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A number that does not exist is as far off as can be.
double MissOfNumbers(const Observation& one, const std::vector<ScalarTarget>& measured) {
  double sum = 0;
  for (std::size_t s = 0; s < measured.size(); ++s) {
    if (!std::isfinite(one.scalars[s])) return kInfinity;
    const double off = (one.scalars[s] - measured[s].value) / measured[s].standard_error;
    sum += off * off;
  }
  return 1 + sum / static_cast<double>(measured.size());
}

double MissOfImage(const Observation& one, double least) {
  if (one.value <= least) return 1;
  return least > 0 ? one.value * one.value / (least * least) : kInfinity;
}

}  // namespace

std::vector<Observation> WithMisses(std::span<const Observation> told,
                                    std::span<const ExperimentTarget> targets) {
  std::vector<Observation> all(told.begin(), told.end());
  std::erase_if(all, [](const Observation& one) { return one.failed; });
  std::vector<double> least(targets.size(), kInfinity);
  for (const Observation& one : all) {
    double& of_its = least[static_cast<std::size_t>(one.experiment)];
    of_its = std::min(of_its, one.value);
  }
  std::vector<double> miss;
  for (const Observation& one : all) {
    const auto e = static_cast<std::size_t>(one.experiment);
    const ExperimentTarget& target = targets[e];
    miss.push_back(target.image.width > 0 ? MissOfImage(one, least[e])
                                          : MissOfNumbers(one, target.scalars));
  }
  for (Observation& one : all) {
    double sum = 0, num = 0;
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (!SamePoint(all[j].point, one.point)) continue;
      sum += miss[j];
      num += 1;
    }
    one.value = sum / num;
  }
  return all;
}

}  // namespace talus::optimizer
