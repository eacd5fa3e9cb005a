// By how much the ranges of the parameters that are asked for narrow as the surrogate learns more.
//
//   p'(x) ∝ p(x) with the surrogate's mean of each output plus √(1 - λ) g, its variance times λ,
//           and its caution that of as many more evaluations at the finest scale factor
//
// λ is what more evaluations leave of the variance, 0 of a surrogate that is sure; g a draw of what
// the mean may be off by now, some of which the widths are averaged over: as the surrogate learns,
// means move as well as narrow. What is searched and not asked for is integrated out on both sides,
// so what a surrogate does not know counts as far as it widens the ranges of the others.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "optimizer/posterior/posterior.h"

namespace talus::optimizer {

// What is to become of the surrogate of one experiment.
struct SurrogateAhead {
  Eigen::VectorXd left;     // λ of each output, in [0, 1]
  double times_finest = 1;  // evaluations at the finest scale factor then over those now
};

// What outlooks on several futures share: what the surrogate says of the draws now, and what it may
// be off by there.
class ExpectedNarrowing {
 public:
  // `draws` of the posterior, which outlives this: equally likely, one a row.
  ExpectedNarrowing(const Posterior& posterior, const Eigen::MatrixXd& draws, std::uint64_t seed);

  // The share of its width that the joint 90 % range of each coordinate in `asked` loses, in [0,
  // 1]. `ahead`: one an experiment.
  Eigen::VectorXd Of(const std::vector<Eigen::Index>& asked,
                     const std::vector<SurrogateAhead>& ahead) const;

 private:
  // The outputs as draw f of g has them, as far as they are learnt.
  std::vector<OutputMoments> Fantasy(int f, const std::vector<SurrogateAhead>& ahead) const;

  const Posterior& posterior_;
  const Eigen::MatrixXd draws_;
  const std::vector<OutputMoments> outputs_;
  const Eigen::VectorXd log_density_;
  std::vector<std::vector<Eigen::MatrixXd>>
      moves_;  // g, [experiment][output]; none of one held out
};

}  // namespace talus::optimizer
