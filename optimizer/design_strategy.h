// Strategies that follow a design of experiments and learn nothing on the way.
#pragma once

#include <string>

#include "optimizer/design.h"
#include "optimizer/domain.h"
#include "optimizer/strategy.h"

namespace talus::optimizer {

// A list of points, one after the other.
class DesignStrategy : public Strategy {
 public:
  // Points outside the domain are left out, the domain's guesses put first. `name` is for people:
  // "the Latin hypercube".
  DesignStrategy(const Domain& domain, const Points& points, std::string name);

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  void Tell(const Observation& observation) override;
  std::optional<std::string> StopReason() override;
  Answer Recommend() override;

 protected:
  const std::vector<Observation>& told() const { return told_; }
  bool WasTold(const Eigen::VectorXd& point) const;
  // Up to `count` of `points` that were neither told nor are pending.
  std::vector<Proposal> Next(const Points& points, int count,
                             std::span<const Eigen::VectorXd> pending) const;

  const Domain domain_;

 private:
  const Points points_;
  const std::string name_;
  std::vector<bool> is_told_;  // of each point: to look it up among all told ones takes too long
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

  std::vector<Proposal> Ask(int count, std::span<const Eigen::VectorXd> pending) override;
  std::optional<std::string> StopReason() override;

 private:
  bool SweepIsDone() const;
  Points Refinement() const;  // only when the sweep is done

  const Sweep sweep_;
  const Points grid_;
};

}  // namespace talus::optimizer
