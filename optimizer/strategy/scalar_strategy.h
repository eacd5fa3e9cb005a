// The strategy for objectives that are numbers: a small design, one repeat, then steps by a
// Gaussian process of the values (scalar_search.h).
#pragma once

#include <optional>

#include "optimizer/search/scalar_search.h"
#include "optimizer/strategy/surrogate_strategy.h"

namespace talus::optimizer {

class ScalarStrategy : public SurrogateStrategy {
 public:
  ScalarStrategy(const Domain& domain, const SurrogateOptions& options)
      : SurrogateStrategy(domain, options), search_(options.seed) {}

  std::optional<StopReason> WhyStop() override {
    if (!record().MayStop(static_cast<int>(record().history().size()))) return std::nullopt;
    return search_.WhyStop(record());
  }
  Answer Recommend() override { return search_.Recommend(record()); }

 private:
  Proposal ByModel(const Points& asked) override { return search_.Next(record(), asked); }
  void Update(const Observation&) override { search_.Update(); }

  ScalarSearch search_;
};

}  // namespace talus::optimizer
