#include "optimizer/designs/design_queue.h"

#include <algorithm>

#include "optimizer/space/point_rows.h"

namespace talus::optimizer {

DesignQueue::DesignQueue(const Domain& domain, const Points& points) {
  for (const Eigen::VectorXd& point : domain.guesses) Append(point, false);
  for (const Eigen::VectorXd& point : points) {
    if (domain.Contains(point)) Append(point, false);
  }
}

void DesignQueue::Append(const Eigen::VectorXd& point, bool is_evaluated) {
  items_.push_back({point, is_evaluated});
}

void DesignQueue::MarkEvaluated(const Eigen::VectorXd& point) {
  for (Item& item : items_) {
    if (!item.is_evaluated) item.is_evaluated = SamePoint(item.point, point);
  }
}

std::optional<Eigen::VectorXd> DesignQueue::Next(std::span<const Eigen::VectorXd> asked) const {
  for (const Item& item : items_) {
    if (!item.is_evaluated && !IsAmong(item.point, asked)) return item.point;
  }
  return std::nullopt;
}

bool DesignQueue::IsDone() const {
  return std::all_of(items_.begin(), items_.end(),
                     [](const Item& item) { return item.is_evaluated; });
}

}  // namespace talus::optimizer
