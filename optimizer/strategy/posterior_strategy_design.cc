// What the posterior's search evaluates before its model chooses.
#include <algorithm>
#include <cstddef>
#include <optional>

#include "optimizer/designs/posterior_design.h"
#include "optimizer/space/distinct_points.h"
#include "optimizer/strategy/posterior_strategy.h"
#include "surrogate/same_point.h"

namespace talus::optimizer {
namespace {

constexpr int kOfAddedTest = 8;  // sets of the design, for an experiment that is added later

}  // namespace

// Distinct points, at most `most`, of what was told and asked and is `counted`.
template <class Counted>
int PosteriorStrategy::NumSets(std::span<const Proposal> asked, int most,
                               const Counted& counted) const {
  DistinctPoints sets;
  const auto add = [&](const auto& evaluation) {
    if (sets.size() < most && counted(evaluation)) sets.Add(evaluation.point);
  };
  std::ranges::for_each(asked, add);
  std::ranges::for_each(observations_, add);
  return sets.size();
}

// Whether the model has chosen simulations already: two sets at least that are not of the design,
// since that of the noise need not be. An experiment without its design was added later then: a few
// evaluations all over the ranges are enough, since what the others say tells where more of them
// matter.
bool PosteriorStrategy::IsUnderWay() const {
  constexpr int kChosen = 2;
  return NumSets({}, kChosen, [&](const auto& told) {
           return std::none_of(
               design_.rowwise().begin(), design_.rowwise().end(),
               [&](const auto& row) { return surrogate::SamePoint(told.point, row.transpose()); });
         }) == kChosen;
}

// Every experiment at the same points: what their residuals share is part of the posterior.
std::optional<Proposal> PosteriorStrategy::FromDesign(std::span<const Proposal> asked) const {
  const bool under_way = IsUnderWay();
  const Eigen::Index size =
      under_way ? std::min<Eigen::Index>(kOfAddedTest, design_.rows()) : design_.rows();
  // Any sets at the coarsest scale factor will do for an added one; but those simulated before a
  // parameter was searched do not tell what it does.
  const auto has_enough = [&](int e) {
    const auto is_it = [&](const auto& other) {
      return other.experiment == e && levels_.LevelOf(other.scale_factor) == 0 &&
             !domain_.IsBeforeAdded(other.point);
    };
    return under_way && NumSets(asked, static_cast<int>(size), is_it) == size;
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    const Eigen::VectorXd point = design_.row(i);
    for (int e = 0; e < static_cast<int>(targets_.size()); ++e) {
      const auto is_it = [&](const auto& other) {
        return other.experiment == e && surrogate::SamePoint(other.point, point);
      };
      if (has_enough(e) || std::any_of(asked.begin(), asked.end(), is_it) ||
          std::any_of(observations_.begin(), observations_.end(), is_it)) {
        continue;
      }
      return Proposal{.point = point,
                      .origin = Origin::kDesign,
                      .experiment = e,
                      .scale_factor = levels_.factor(0)};
    }
  }
  return std::nullopt;
}

std::optional<Proposal> PosteriorStrategy::TooFewAt(const Eigen::VectorXd& point,
                                                    std::span<const Proposal> asked) const {
  for (int level = 1; level < levels_.size(); ++level) {
    for (int e = 0; e < static_cast<int>(targets_.size()); ++e) {
      const auto is_it = [&](const auto& other) {
        return other.experiment == e && levels_.LevelOf(other.scale_factor) == level;
      };
      // A narrow posterior may offer one set again and again: nine repeats stand for three sets.
      const auto count = std::count_if(asked.begin(), asked.end(), is_it) +
                         std::count_if(observations_.begin(), observations_.end(), is_it);
      if (NumSets(asked, kFewestFinerSets, is_it) == kFewestFinerSets) continue;
      if (count >= kFewestFinerSets * kFewestFinerSets) continue;
      return Proposal{.point = point,
                      .origin = Origin::kModel,
                      .experiment = e,
                      .scale_factor = levels_.factor(level)};
    }
  }
  return std::nullopt;
}

}  // namespace talus::optimizer
