#include "optimizer/strategy/replayed_search.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/random.h"
#include "optimizer/designs/points_within.h"
#include "optimizer/search/history.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

constexpr int kMaxRuns = 1000;            // of a local search, each from another start
constexpr int kMaxEvaluations = 1000000;  // the budget is the caller's business
constexpr double kFirstStep = 0.15;       // of a local search, in the unit cube
constexpr double kNoValue = 1e100;        // of what fails before anything has a value
constexpr int kMostOutside = 200000;      // points in one replay that constraints forbid
constexpr int kStarts = 100;              // where the domain is too small to be hit at random
constexpr double kSmallestStep = 1e-4;    // a local search that moves less has converged

struct Wanted {  // thrown through the search to end it
  Eigen::VectorXd point;
};
struct Lost {};  // the same, of a search that hardly finds the domain

// Answers the calls of one replay.
class Memory {
 public:
  Memory(std::span<const Observation> told, std::span<const Eigen::VectorXd> pending,
         const Domain& domain)
      : told_(told), pending_(pending), domain_(domain) {}

  double Answer(const Eigen::VectorXd& point) {
    // Some searches finish their round of calls before they end: the first unknown point counts.
    if (wanted_) throw Wanted{*wanted_};
    const double value = Look(point);
    seen_.emplace_back(point, value);
    return value;
  }

 private:
  double Look(const Eigen::VectorXd& point) {
    if (!domain_.Contains(point)) {
      if (++num_outside_ > kMostOutside) throw Lost{};
      return Worst();
    }
    for (const Observation& observation : told_) {
      if (surrogate::SamePoint(observation.point, point)) {
        if (observation.failed) return Worst();
        worst_ = std::max(worst_.value_or(observation.value), observation.value);
        return observation.value;
      }
    }
    for (const Eigen::VectorXd& runs : pending_) {
      if (surrogate::SamePoint(runs, point)) return Nearest(point);
    }
    wanted_ = point;
    throw Wanted{point};
  }

  // Only what this replay has seen so far counts, so that later observations do not change the path
  // the search has taken.
  double Worst() const { return worst_.value_or(kNoValue); }
  double Nearest(const Eigen::VectorXd& to) const {
    double smallest = std::numeric_limits<double>::infinity();
    double nearest = 0;
    for (const auto& [point, value] : seen_) {
      const double distance = (point - to).squaredNorm();
      if (distance >= smallest) continue;
      smallest = distance;
      nearest = value;
    }
    return nearest;
  }

  std::span<const Observation> told_;
  std::span<const Eigen::VectorXd> pending_;
  const Domain& domain_;
  std::vector<std::pair<Eigen::VectorXd, double>> seen_;
  int num_outside_ = 0;
  std::optional<double> worst_;  // of the values seen
  std::optional<Eigen::VectorXd> wanted_;
};

}  // namespace

ReplayedSearch::ReplayedSearch(const Domain& domain, ReplayOptions options, std::uint64_t seed)
    : domain_(domain), options_(std::move(options)), seed_(seed) {}

Eigen::VectorXd ReplayedSearch::Start(int run) {
  if (run < static_cast<int>(domain_.guesses.size())) {
    return domain_.guesses[static_cast<std::size_t>(run)];
  }
  base::Random random(seed_, base::Stream("search start"), static_cast<std::uint64_t>(run));
  Eigen::VectorXd start(domain_.num_parameters);
  for (int attempt = 0; attempt < kMaxRuns; ++attempt) {
    for (double& x : start) x = random.Uniform();
    if (domain_.Contains(start)) return start;
  }
  if (starts_.empty()) starts_ = SobolInside(domain_, kStarts, seed_);
  return starts_.empty() ? start : starts_[static_cast<std::size_t>(run) % starts_.size()];
}

std::optional<Eigen::VectorXd> ReplayedSearch::Replay(std::span<const Eigen::VectorXd> pending) {
  Memory memory(told_, pending, domain_);
  is_lost_ = false;
  try {
    // A search may begin elsewhere: BOBYQA shifts a start near a bound, DIRECT has none.
    for (const Eigen::VectorXd& guess : domain_.guesses) memory.Answer(guess);
    for (int run = 0; run < (options_.local ? kMaxRuns : 1); ++run) {
      const Eigen::VectorXd start = Start(run);
      if (domain_.feasible && options_.local) memory.Answer(start);  // it may never come near
      const surrogate::SearchTask task{
          .algorithm = options_.algorithm,
          .lower = Eigen::VectorXd::Zero(domain_.num_parameters),
          .upper = Eigen::VectorXd::Ones(domain_.num_parameters),
          .start = start,
          .max_evaluations = kMaxEvaluations,
          .absolute_tolerance = options_.local ? kSmallestStep : 0,
          .initial_step = options_.local ? kFirstStep : 0,
      };
      surrogate::Minimize(
          [&](const Eigen::VectorXd& x, Eigen::VectorXd*) { return memory.Answer(x); }, task);
    }
  } catch (const Wanted& wanted) {
    return wanted.point;
  } catch (const Lost&) {
    is_lost_ = true;
    if (told_.empty() && pending.empty()) return Start(0);
  }
  return std::nullopt;
}

std::vector<Proposal> ReplayedSearch::Ask(int count, std::span<const Eigen::VectorXd> pending) {
  std::vector<Eigen::VectorXd> asked(pending.begin(), pending.end());
  std::vector<Proposal> proposals;
  while (static_cast<int>(proposals.size()) < count) {
    const auto point = Replay(asked);
    if (!point) break;
    asked.push_back(*point);
    proposals.push_back({*point, Origin::kSearch});
  }
  return proposals;
}

std::optional<StopReason> ReplayedSearch::WhyStop() {
  if (Replay({})) return std::nullopt;
  return StopReason{
      .rule = StopRule::kConverged,
      .name =
          options_.name + (is_lost_ ? ", which finds no more points within the constraints," : "")};
}

Answer ReplayedSearch::Recommend() { return BestObserved(told_, domain_, options_.name); }

}  // namespace talus::optimizer
