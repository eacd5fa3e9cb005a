// The strategy on radial basis functions, which have a mean but no variance: candidates are scored
// by what the function promises and by how far they are from every evaluation, in turn more of the
// one and of the other [regis2007].
#pragma once

#include "optimizer/space/domain.h"
#include "optimizer/strategies/scalar_strategy.h"
#include "optimizer/strategies/strategy.h"
#include "surrogate/process/radial_basis.h"

namespace talus::optimizer {

class RbfStrategy : public Strategy {
 public:
  RbfStrategy(const Domain& domain, const ScalarOptions& options);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  // Never: without a variance nobody knows what is left to gain.
  std::optional<std::string> StopReason() override { return std::nullopt; }
  Answer Recommend() override;

 private:
  using Points = std::vector<Eigen::VectorXd>;

  // Of the function whose values, left out one by one, are predicted better.
  surrogate::RadialBasis Fit() const;
  Eigen::VectorXd ByModel(const Points& asked) const;
  Eigen::VectorXd Lowest(const surrogate::RadialBasis& basis) const;

  Domain domain_;
  ScalarOptions options_;
  ScalarStrategy scalar_;  // design, repeat, failures
  std::vector<Observation> told_;
};

}  // namespace talus::optimizer
