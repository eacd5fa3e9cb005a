#include "optimizer/search/restart.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "optimizer/search/step_choice.h"
#include "optimizer/space/ascending.h"

namespace talus::optimizer {
namespace {

constexpr double kNear = 0.01;   // of the cube: evaluations that polish the best one
constexpr double kLongLink = 2;  // times the mean link

struct Link {
  Eigen::Index better = -1;  // none of the best one
  double length = 0;
};

// To the nearest better evaluation; of equal ones the earlier is taken for the better.
Link LinkOf(const History& history, Eigen::Index i) {
  Link link{.length = std::numeric_limits<double>::infinity()};
  for (Eigen::Index j = 0; j < history.values.size(); ++j) {
    const bool better =
        history.values[j] < history.values[i] || (history.values[j] == history.values[i] && j < i);
    if (!better) continue;
    const double length = (history.points.row(i) - history.points.row(j)).norm();
    if (length < link.length) link = {.better = j, .length = length};
  }
  return link;
}

// Which evaluations lie in the basin of the best one.
std::vector<bool> BasinOfBest(const History& history) {
  const Eigen::Index size = history.values.size();
  const std::vector<Eigen::Index> order = Ascending(history.values);
  std::vector<Link> links;
  double sum = 0;
  for (const Eigen::Index i : order) {
    links.push_back(LinkOf(history, i));
    if (links.back().better >= 0) sum += links.back().length;
  }
  const double longest = kLongLink * sum / static_cast<double>(std::max<Eigen::Index>(1, size - 1));
  std::vector<bool> inside(static_cast<std::size_t>(size), false);
  inside[static_cast<std::size_t>(order.front())] = true;
  for (std::size_t k = 1; k < order.size(); ++k) {  // the better ones are decided already
    const Link& link = links[k];
    if (link.length > longest) continue;
    inside[static_cast<std::size_t>(order[k])] = inside[static_cast<std::size_t>(link.better)];
  }
  return inside;
}

History Without(const History& history, const std::vector<bool>& left_out) {
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (!left_out[i]) kept.push_back(static_cast<Eigen::Index>(i));
  }
  return {.points = history.points(kept, Eigen::all),
          .values = history.values(kept),
          .failed = history.failed};
}

}  // namespace

bool HasConverged(const History& history, int num_before, Eigen::Index patience) {
  const Eigen::Index before = history.values.size() - patience;
  if (before < num_before) return false;
  const double gain = history.values.head(before).minCoeff() - history.values.minCoeff();
  if (gain > LeastGain(history.values, num_before)) return false;
  Eigen::Index best = 0;
  history.values.minCoeff(&best);
  const auto apart = (history.points.rowwise() - history.points.row(best)).rowwise().norm();
  return (apart.array() < kNear).count() > 2 * history.points.cols();
}

std::optional<Elsewhere> RestartElsewhere(const History& history, const Domain& domain,
                                          int num_before) {
  if (!HasConverged(history, num_before, 2 * history.points.cols())) return std::nullopt;
  const std::vector<bool> basin = BasinOfBest(history);
  Elsewhere elsewhere{.history = Without(history, basin), .domain = domain};
  if (elsewhere.history.values.size() < 2 * history.points.cols() + 2) return std::nullopt;
  elsewhere.domain.feasible = [points = history.points, basin,
                               contains = domain.feasible](const Eigen::VectorXd& x) {
    if (contains && !contains(x)) return false;
    Eigen::Index nearest = 0;
    (points.rowwise() - x.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    return !basin[static_cast<std::size_t>(nearest)];
  };
  return elsewhere;
}

}  // namespace talus::optimizer
