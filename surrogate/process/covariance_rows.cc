#include "surrogate/process/covariance_rows.h"

#include <algorithm>
#include <cmath>

namespace talus::surrogate {

CovarianceRows::CovarianceRows(const Sites& sites, const Hyperparameters& hyper)
    : hyper_(hyper),
      coordinates_(sites.columns.transpose()),
      centred_(2 * coordinates_ - 1),
      growth_(sites.growth),
      which_growth_(sites.growth.size()) {
  for (Eigen::Index i = 0; i < growth_.size(); ++i) {
    const auto found = std::ranges::find(distinct_growth_, growth_[i]);
    which_growth_[i] = static_cast<int>(found - distinct_growth_.begin());
    if (found == distinct_growth_.end()) distinct_growth_.push_back(growth_[i]);
  }
}

Eigen::ArrayXd CovarianceRows::TargetShares(double growth, Eigen::Index count) const {
  Eigen::ArrayXd of_distinct(distinct_growth_.size());
  for (std::size_t i = 0; i < distinct_growth_.size(); ++i) {
    of_distinct[static_cast<Eigen::Index>(i)] =
        std::exp(-hyper_.scale->decay * (distinct_growth_[i] + growth));
  }
  return of_distinct(which_growth_.tail(count));
}

Eigen::ArrayXd CovarianceRows::SharedGrowth(double growth, Eigen::Index count) const {
  const auto own = growth_.tail(count);
  return own * growth + (own * own - own) * (growth * growth - growth);
}

}  // namespace talus::surrogate
