#include "optimizer/space/level_ranks.h"

#include <algorithm>

#include "optimizer/space/domain.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

constexpr double kOnlyValue = 0.5;  // the rank of the only value there is

double RankOf(const std::vector<double>& values, double value) {
  if (values.size() == 1) return kOnlyValue;
  const auto last = static_cast<double>(values.size() - 1);
  const auto above = std::lower_bound(values.begin(), values.end(), value);
  if (above == values.begin()) return 0;
  if (above == values.end()) return 1;
  const double share = (value - *(above - 1)) / (*above - *(above - 1));
  return (static_cast<double>(above - values.begin()) - 1 + share) / last;
}

double ValueAt(const std::vector<double>& values, double rank) {
  const double place = std::clamp(rank, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), values.size() - 1);
  const double share = place - static_cast<double>(below);
  return share > 0 ? values[below] + share * (values[below + 1] - values[below]) : values[below];
}

}  // namespace

LevelRanks::LevelRanks(const Eigen::MatrixXd& candidates) {
  for (const auto& column : candidates.colwise()) {
    std::vector<double> values(column.begin(), column.end());
    std::sort(values.begin(), values.end());
    const auto is_same = [](double a, double b) { return b - a <= surrogate::kSamePoint; };
    values.erase(std::unique(values.begin(), values.end(), is_same), values.end());
    values_.push_back(std::move(values));
  }
}

Eigen::VectorXd LevelRanks::ToRanks(const Eigen::VectorXd& point) const {
  Eigen::VectorXd ranks(point.size());
  for (Eigen::Index k = 0; k < point.size(); ++k) {
    ranks[k] = RankOf(values_[static_cast<std::size_t>(k)], point[k]);
  }
  return ranks;
}

Eigen::VectorXd LevelRanks::FromRanks(const Eigen::VectorXd& ranks) const {
  Eigen::VectorXd point(ranks.size());
  for (Eigen::Index k = 0; k < ranks.size(); ++k) {
    point[k] = ValueAt(values_[static_cast<std::size_t>(k)], ranks[k]);
  }
  return point;
}

}  // namespace talus::optimizer
