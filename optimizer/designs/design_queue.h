// The points of a design that are still to be evaluated, in their order.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "optimizer/designs/design.h"
#include "optimizer/space/domain.h"

namespace talus::optimizer {

class DesignQueue {
 public:
  // The domain's guesses, then those of `points` that the domain contains, at levels; of a list the
  // candidates nearest to all of them, each once.
  DesignQueue(const Domain& domain, const Points& points);

  void Append(const Eigen::VectorXd& point, bool is_evaluated);

  // Takes every point that is the same as this one off the queue.
  void MarkEvaluated(const Eigen::VectorXd& point);

  // The first point that is neither evaluated nor among `asked`.
  std::optional<Eigen::VectorXd> Next(std::span<const Eigen::VectorXd> asked) const;

  bool IsDone() const;  // all points are evaluated
  int size() const { return static_cast<int>(items_.size()); }

 private:
  void AppendSnapped(const Domain& domain, const Eigen::VectorXd& point);

  struct Item {
    Eigen::VectorXd point;
    bool is_evaluated = false;
  };

  std::vector<Item> items_;
};

}  // namespace talus::optimizer
