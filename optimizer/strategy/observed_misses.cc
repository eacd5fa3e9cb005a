#include "optimizer/strategy/observed_misses.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "optimizer/space/point_rows.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotEvaluated = 1e9;  // above every miss that can be told from others
constexpr double kNothing = 1e18;

double MissOfImage(const Observation& one, double least) {
  if (one.value <= least) return 1;
  return least > 0 ? one.value * one.value / (least * least) : kInfinity;
}

class Misses {
 public:
  Misses(std::span<const Observation> told, std::span<const ExperimentTarget> targets)
      : told_(told), targets_(targets) {
    std::vector<double> least(targets.size(), kInfinity);
    for (const Observation& one : told) {
      double& of_its = least[static_cast<std::size_t>(one.experiment)];
      if (!one.failed) of_its = std::min(of_its, one.value);
    }
    for (const Observation& one : told) {
      const auto e = static_cast<std::size_t>(one.experiment);
      miss_.push_back(one.failed                   ? kInfinity
                      : targets[e].image.width > 0 ? MissOfImage(one, least[e])
                                                   : MissOfNumbers(one, targets[e].scalars));
    }
  }

  double At(const Eigen::VectorXd& point) const {
    double sum = 0, weights = 0;
    for (std::size_t e = 0; e < targets_.size(); ++e) {
      if (targets_[e].weight == 0) continue;  // it is held out
      sum += targets_[e].weight * AtOne(point, static_cast<int>(e));
      weights += targets_[e].weight;
    }
    return sum / weights;
  }

 private:
  // The mean of the evaluations of an experiment there that give something.
  double AtOne(const Eigen::VectorXd& point, int experiment) const {
    double sum = 0, num = 0;
    bool is_evaluated = false;
    for (std::size_t i = 0; i < told_.size(); ++i) {
      if (told_[i].experiment != experiment || !surrogate::SamePoint(told_[i].point, point))
        continue;
      is_evaluated = true;
      if (!std::isfinite(miss_[i])) continue;
      sum += miss_[i];
      num += 1;
    }
    if (!is_evaluated) return kNotEvaluated;
    return num > 0 ? std::min(sum / num, kNotEvaluated / 2) : kNothing;
  }

  std::span<const Observation> told_;
  std::span<const ExperimentTarget> targets_;
  std::vector<double> miss_;
};

}  // namespace

double MissOfNumbers(const Observation& one, const std::vector<ScalarTarget>& measured) {
  double sum = 0;
  for (std::size_t s = 0; s < measured.size(); ++s) {
    if (!std::isfinite(one.scalars[s])) return kInfinity;
    const double error = measured[s].standard_error > 0 ? measured[s].standard_error : 1;
    const double off = (one.scalars[s] - measured[s].value) / error;
    sum += off * off;
  }
  return 1 + sum / static_cast<double>(measured.size());
}

std::vector<Observation> WithMisses(std::span<const Observation> told,
                                    std::span<const ExperimentTarget> targets) {
  const Misses misses(told, targets);
  std::vector<Observation> all(told.begin(), told.end());
  for (Observation& one : all) one.value = misses.At(one.point);
  return all;
}

}  // namespace talus::optimizer
