// The loop that strategies with a model share: initial design, first repeat, then steps by the
// model. What the model is, and how it steps, is up to the derived class.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "optimizer/search/search_record.h"
#include "optimizer/strategy/strategy.h"

namespace talus::optimizer {

class SurrogateStrategy : public Strategy {
 public:
  SurrogateStrategy(const Domain& domain, const SurrogateOptions& options)
      : record_(domain, options) {}

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) final;
  void Tell(const Observation& observation) final;
  std::optional<StopShortfall> Shortfall() override;

 protected:
  // One more proposal while those `asked` are being evaluated. At least two evaluations succeeded.
  virtual Proposal ByModel(const Points& asked) = 0;
  // Throws base::ConfigError, before anything learns of it, where an evaluation that has not failed
  // lacks what the model is made from.
  virtual void RequireUsable(const Observation&) const {}
  // The record knows `observation` already.
  virtual void Update(const Observation& observation) = 0;

  const SearchRecord& record() const { return record_; }

 private:
  // None when every candidate of a list is used up.
  std::optional<Proposal> Next(const Points& asked);

  SearchRecord record_;
};

}  // namespace talus::optimizer
