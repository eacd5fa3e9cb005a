#include "optimizer/designs/design_queue.h"

#include <algorithm>

#include "optimizer/space/point_rows.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {

DesignQueue::DesignQueue(const Domain& domain, const Points& points) {
  for (const Eigen::VectorXd& point : domain.guesses) AppendSnapped(domain, point);
  for (const Eigen::VectorXd& point : points) {
    if (domain.IsList() || domain.Contains(point)) AppendSnapped(domain, point);
  }
}

// From a list, the nearest candidate that is not in the queue yet.
void DesignQueue::AppendSnapped(const Domain& domain, const Eigen::VectorXd& point) {
  if (domain.IsContinuous()) return Append(point, false);
  const auto is_queued = [&](const Eigen::VectorXd& other) {
    return std::any_of(items_.begin(), items_.end(),
                       [&](const Item& item) { return surrogate::SamePoint(item.point, other); });
  };
  if (!domain.IsList()) {
    const Eigen::VectorXd snapped = domain.Snap(point);
    if (domain.Contains(snapped) && !is_queued(snapped)) Append(snapped, false);
    return;
  }
  std::optional<Eigen::Index> nearest;
  double least = 0;
  for (Eigen::Index i = 0; i < domain.candidates.rows(); ++i) {
    const double distance = (domain.candidates.row(i) - point.transpose()).squaredNorm();
    if ((nearest && distance >= least) || is_queued(domain.candidates.row(i))) continue;
    nearest = i;
    least = distance;
  }
  if (nearest) Append(domain.candidates.row(*nearest), false);
}

void DesignQueue::Append(const Eigen::VectorXd& point, bool is_evaluated) {
  items_.push_back({point, is_evaluated});
}

void DesignQueue::MarkEvaluated(const Eigen::VectorXd& point) {
  for (Item& item : items_) {
    if (!item.is_evaluated) item.is_evaluated = surrogate::SamePoint(item.point, point);
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
