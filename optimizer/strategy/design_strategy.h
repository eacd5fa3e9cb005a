// Strategies that follow a design of experiments and learn nothing on the way.
#pragma once

#include <string>
#include <vector>

#include "optimizer/designs/design.h"
#include "optimizer/designs/design_queue.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategy/strategy.h"

namespace talus::optimizer {

// A list of points, one after the other.
class DesignStrategy : public Strategy {
 public:
  // Points outside the domain are left out, the domain's guesses put first. `name` is for people:
  // "the Latin hypercube".
  DesignStrategy(const Domain& domain, const Points& points, std::string name);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<StopReason> WhyStop() override;
  Answer Recommend() override;

 protected:
  const std::vector<Observation>& told() const { return told_; }
  bool IsDone() const { return queue_.IsDone(); }  // all points are told
  // Points to go on with after those there are.
  void Append(const Points& points);

  const Domain domain_;

 private:
  DesignQueue queue_;
  const std::string name_;
  std::vector<Observation> told_;
};

// The full factorial; when all of it is told, the half-step neighbours of its best points.
class GridStrategy : public DesignStrategy {
 public:
  struct Sweep {
    std::vector<int> levels;  // one a parameter, each >= 1
    int refine_best = 20;     // how many of the best points are refined, >= 0
  };
  GridStrategy(const Domain& domain, const Sweep& sweep);

  void Tell(const Observation& observation) override;
  std::optional<StopReason> WhyStop() override;

 private:
  Points Refinement() const;  // of the best told so far

  const Sweep sweep_;
  const Points grid_;
  bool is_refined_ = false;
  std::size_t num_refined_ = 0;
};

}  // namespace talus::optimizer
