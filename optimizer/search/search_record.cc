#include "optimizer/search/search_record.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/random.h"
#include "optimizer/designs/design.h"
#include "optimizer/designs/points_within.h"
#include "optimizer/designs/r_sequence.h"
#include "optimizer/search/stopping_rule.h"
#include "optimizer/space/point_rows.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

// Two evaluations this close to each other teach under noise what a replicate would.
constexpr double kReplicateDistance = 0.005;

constexpr int kMostTries = 10000;

// The lower quartile of the first values, those of the design: a penalty, which some commands
// return where others would fail, does not move it, nor do a search's many values near its optimum.
double QuartileOfFirst(const Eigen::VectorXd& values, int num_first) {
  const Eigen::Index count =
      num_first > 0 ? std::min<Eigen::Index>(num_first, values.size()) : values.size();
  std::vector<double> first(values.begin(), values.begin() + count);
  const auto quartile = first.begin() + count / 4;
  std::nth_element(first.begin(), quartile, first.end());
  return *quartile;
}

// Points that the domain, no list, contains, one a row; none where constraints leave next to none.
Eigen::MatrixXd SomeWithin(const Domain& domain, std::uint64_t seed) {
  constexpr int kNumCandidates = 1000;
  constexpr int kFew = 20;
  const Eigen::MatrixXd even =
      Inside(domain, RSequence(kNumCandidates, domain.num_parameters, seed));
  if (even.rows() > 0) return even;
  const Points sobol = SobolInside(domain, kFew, seed);
  Eigen::MatrixXd points(static_cast<Eigen::Index>(sobol.size()), domain.num_parameters);
  for (std::size_t i = 0; i < sobol.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = sobol[i];
  }
  return Inside(domain, points);
}

// A row of a table that is evaluated once has been spent on the design.
int DesignSize(const Domain& domain, const SurrogateOptions& options) {
  if (options.num_initial > 0) return options.num_initial;
  const bool spends_rows = domain.IsList() && options.exact;
  return (spends_rows ? 1 : 2) * domain.num_parameters + 3;
}

}  // namespace

SearchRecord::SearchRecord(Domain domain, const SurrogateOptions& options)
    : domain_(std::move(domain)),
      options_(options),
      design_(domain_, PointsWithin(domain_,
                                    LatinHypercube(DesignSize(domain_, options),
                                                   domain_.num_parameters, options.seed),
                                    options.seed)),
      history_(MakeHistory(told_, domain_.num_parameters)) {}

void SearchRecord::Tell(const Observation& observation) {
  told_.push_back(WithoutImage(observation));
  design_.MarkEvaluated(observation.point);
  history_ = MakeHistory(told_, domain_.num_parameters);
  if (!observation.failed) repeats_.CountLast(history_);
  feasibility_.reset();
}

// Enough points from elsewhere, such as the trials of another campaign, make the design needless.
std::optional<Proposal> SearchRecord::BeforeModel(std::span<const Eigen::VectorXd> asked) const {
  if (told_.size() + asked.size() < static_cast<std::size_t>(design_.size())) {
    if (const auto point = design_.Next(asked)) return Proposal{*point, Origin::kDesign};
  }
  if (const auto point = FirstRepeat(asked)) return Proposal{*point, Origin::kRepeat};
  return std::nullopt;
}

// The best point, since near it the noise matters; not one that has failed meanwhile.
std::optional<Eigen::VectorXd> SearchRecord::FirstRepeat(
    std::span<const Eigen::VectorXd> asked) const {
  if (options_.exact || repeats_.num_repeats > 0 || history_.size() == 0) return std::nullopt;
  if (domain_.IsList() && options_.max_replicates < 2) return std::nullopt;  // each only once
  for (Eigen::Index i = 0; i < history_.points.rows(); ++i) {
    if (IsAmong(history_.points.row(i), asked)) return std::nullopt;  // the repeat is under way
  }
  std::optional<Eigen::Index> best;
  for (Eigen::Index i = 0; i < history_.values.size(); ++i) {
    if (best && history_.values[i] >= history_.values[*best]) continue;
    if (!HasFailed(history_.points.row(i))) best = i;
  }
  if (!best) return std::nullopt;
  return history_.points.row(*best);
}

bool SearchRecord::HasFailed(const Eigen::VectorXd& point) const {
  return std::any_of(told_.begin(), told_.end(), [&](const Observation& seen) {
    return seen.failed && surrogate::SamePoint(seen.point, point);
  });
}

bool SearchRecord::WasEvaluated(const Eigen::VectorXd& point,
                                std::span<const Eigen::VectorXd> asked) const {
  return IsAmong(point, asked) ||
         std::any_of(told_.begin(), told_.end(), [&](const Observation& seen) {
           return surrogate::SamePoint(seen.point, point);
         });
}

Domain SearchRecord::OpenDomain(std::span<const Eigen::VectorXd> asked) const {
  if (!domain_.IsList()) return domain_;
  const int most = deterministic() ? 1 : std::max(1, options_.max_replicates);
  std::vector<Eigen::Index> open;
  for (Eigen::Index i = 0; i < domain_.candidates.rows(); ++i) {
    const Eigen::VectorXd point = domain_.candidates.row(i);
    const auto is_here = [&](const Eigen::VectorXd& other) {
      return surrogate::SamePoint(point, other);
    };
    const auto num_asked = std::count_if(asked.begin(), asked.end(), is_here);
    const auto num_told = std::count_if(
        told_.begin(), told_.end(), [&](const Observation& seen) { return is_here(seen.point); });
    if (num_asked + num_told < most && !HasFailed(point)) open.push_back(i);
  }
  Domain domain = domain_;
  domain.candidates = domain_.candidates(open, Eigen::all);
  return domain;
}

Eigen::VectorXd SearchRecord::MostFeasible(std::span<const Eigen::VectorXd> asked) const {
  const Domain domain = OpenDomain(asked);
  Eigen::VectorXd best = Eigen::VectorXd::Constant(domain_.num_parameters, 0.5);
  double highest = -1;
  const Eigen::MatrixXd candidates =
      domain.IsList() ? domain.candidates : SomeWithin(domain, StepSeed(asked));
  for (Eigen::Index i = 0; i < candidates.rows(); ++i) {
    const double probability = feasibility().Probability(candidates.row(i));
    if (probability <= highest) continue;
    highest = probability;
    best = candidates.row(i);
  }
  return best;
}

Proposal SearchRecord::ReplicateOrPerturb(const Eigen::VectorXd& point,
                                          std::span<const Eigen::VectorXd> asked) const {
  if (domain_.IsList()) {
    return {point, WasEvaluated(point, asked) ? Origin::kRepeat : Origin::kModel};
  }
  if (!deterministic() && repeats_.num_repeats < 1 + options_.max_replicates) {
    for (Eigen::Index i = 0; i < history_.points.rows(); ++i) {
      const Eigen::VectorXd near = history_.points.row(i);
      if ((near - point).norm() < kReplicateDistance && !IsAmong(near, asked) && !HasFailed(near)) {
        return {near, Origin::kRepeat};
      }
    }
  }
  base::Random random(options_.seed, base::Stream("not the same point"), told_.size());
  constexpr double kFarthest = 0.5;  // beyond it nearly all end in corners
  Eigen::VectorXd moved = point;
  double reach = 1e-3;
  for (int tries = 0; WasEvaluated(moved, asked) || !domain_.Contains(moved); ++tries) {
    if (tries == kMostTries) return {Unevaluated(asked), Origin::kModel};
    for (Eigen::Index k = 0; k < moved.size(); ++k) {
      moved[k] = std::clamp(point[k] + reach * random.Normal(), 0.0, 1.0);
    }
    if (!domain_.IsContinuous()) moved = domain_.Snap(moved);
    reach = std::min(1.2 * reach, kFarthest);
  }
  return {moved, Origin::kModel};
}

// Where constraints are so narrow that steps near a point all leave them.
Eigen::VectorXd SearchRecord::Unevaluated(std::span<const Eigen::VectorXd> asked) const {
  const auto num_used = static_cast<int>(told_.size() + asked.size());
  const Points sobol = SobolInside(domain_, num_used + 1, options_.seed);
  for (const Eigen::VectorXd& one : sobol) {
    const Eigen::VectorXd point = domain_.Snap(one);
    if (domain_.Contains(point) && !WasEvaluated(point, asked)) return point;
  }
  throw base::ConfigError(
      sobol.empty() ? "constraints: no point of the ranges is found that satisfies all of them: "
                      "check their signs, or widen the ranges"
                    : "no point is found that was not evaluated: constraints or levels leave too "
                      "little of the ranges; widen them");
}

std::uint64_t SearchRecord::StepSeed(std::span<const Eigen::VectorXd> asked) const {
  return options_.seed + 7919 * (told_.size() + asked.size());
}

bool SearchRecord::MayStop(int num_evaluations) const {
  return options_.stop_multiple > 0 && (options_.exact || repeats_.num_repeats > 0) &&
         num_evaluations >= 2 * design_.size();
}

std::optional<StopReason> SearchRecord::ReasonToStop(double gain, double noise) const {
  if (noise_free()) {
    return StopByExactGain(
        gain, QuartileOfFirst(history_.values, design_.size()) - history_.values.minCoeff());
  }
  return StopByGain(gain, noise, options_.stop_multiple);
}

}  // namespace talus::optimizer
