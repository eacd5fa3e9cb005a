// The strategy on radial basis functions, which have a mean but no variance: candidates are scored
// by the predicted value and by the distance to every evaluation, in turn more by the one and more
// by the other [regis2007].
#pragma once

#include <optional>

#include "optimizer/strategy/surrogate_strategy.h"
#include "surrogate/process/radial_basis.h"

namespace talus::optimizer {

class RbfStrategy : public SurrogateStrategy {
 public:
  using SurrogateStrategy::SurrogateStrategy;

  // Never: without a variance nobody knows what is left to gain.
  std::optional<StopReason> WhyStop() override { return std::nullopt; }
  std::optional<StopShortfall> Shortfall() override { return std::nullopt; }
  Answer Recommend() override;

 private:
  Proposal ByModel(const Points& asked) override;
  void Update(const Observation&) override { fit_.reset(); }

  // That of the two functions whose values, left out one by one, are predicted better.
  const surrogate::RadialBasis& Fit();
  Eigen::VectorXd Lowest(const surrogate::RadialBasis& basis) const;

  std::optional<surrogate::RadialBasis> fit_;  // a batch of proposals is made from one
};

}  // namespace talus::optimizer
