// When a posterior's search ends by itself.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "optimizer/outputs/output_model.h"
#include "optimizer/posterior/expected_narrowing.h"
#include "optimizer/search/stopping_rule.h"
#include "optimizer/space/domain.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::optimizer {

bool PosteriorStrategy::HasDesign() {
  return CanModel() && !FromDesign({}) && !TooFewAt(Eigen::VectorXd(), {});
}

// With today's hyper-parameters. No variance falls faster than that of a mean of independent
// evaluations at the finest scale factor: where the last third was the first to tell a discrepancy,
// it did once.
std::vector<SurrogateAhead> PosteriorStrategy::SurrogatesAhead(const Eigen::MatrixXd& draws) {
  const std::size_t earlier = 2 * observations_.size() / 3;
  std::vector<SurrogateAhead> ahead;
  for (std::size_t e = 0; e < told_.size(); ++e) {
    const Told& told = told_[e];
    const ExperimentModel& now = Model().models()[e];
    const std::vector<int>& level = told.by_code.front().level;
    const auto count = std::ranges::lower_bound(told.place, earlier) - told.place.begin();
    const auto finest = std::ranges::count(level, levels_.finest());
    const auto finest_before = std::count(level.begin(), level.begin() + count, levels_.finest());
    const double times = 1 + 1.5 * static_cast<double>(finest - finest_before) /
                                 static_cast<double>(std::max<std::ptrdiff_t>(1, finest));
    ahead.push_back(
        {.left = Eigen::VectorXd::Constant(now.num_outputs(), 1 / times), .times_finest = times});
    if (count < kFewest) continue;
    const OutputData data =
        Modelled(told.by_code[told.code()], told.values, static_cast<int>(count));
    const ExperimentModel before(SetupOf(e), data, &*told.state);
    const auto typical = [&](const ExperimentModel& model) -> Eigen::ArrayXd {
      return model.Outputs(draws).variance.colwise().mean().transpose();
    };
    ahead.back().left = (typical(now) / typical(before)).max(1 / times).min(1.0);
  }
  return ahead;
}

const Outlook& PosteriorStrategy::OutlookNow() {
  if (outlook_) return *outlook_;
  constexpr int kDraws = 400;
  constexpr Eigen::Index kFew = 50;
  const Eigen::MatrixXd draws = Sample().Draws(kDraws, options_.seed);
  const Eigen::MatrixXd few = draws(Eigen::seqN(0, kFew, kDraws / kFew), Eigen::all);
  std::vector<SurrogateAhead> ahead = SurrogatesAhead(few);
  const ExpectedNarrowing expected(Model(), draws, options_.seed);
  const auto narrowing = [&]() -> std::vector<double> {
    const Eigen::VectorXd each = expected.Of(domain_.Asked(), ahead);
    return {each.begin(), each.end()};
  };
  outlook_.emplace(Outlook{.again = narrowing(), .temper = Model().temper()});
  for (SurrogateAhead& surrogate : ahead) surrogate.left.setZero();
  outlook_->all = narrowing();
  return *outlook_;
}

// Since it was last asked, and at least since the last proposal, which may have been evaluated more
// than once: a search that goes on after an interruption looks where it would have looked without.
bool PosteriorStrategy::IsTimeToLook() const {
  const Observation& last = observations_.back();
  const auto is_other = [&](const Observation& told) {
    return told.experiment != last.experiment || told.scale_factor != last.scale_factor ||
           !SamePoint(told.point, last.point);
  };
  const auto others = std::find_if(observations_.rbegin(), observations_.rend(), is_other);
  const int before = static_cast<int>(std::distance(others, observations_.rend()));
  return IsTimeForOutlook(std::min(before, asked_at_.value_or(before)),
                          static_cast<int>(observations_.size()));
}

std::optional<StopReason> PosteriorStrategy::WhyStop() {
  if (options_.stop_share == 0 || !HasDesign()) return std::nullopt;
  const bool is_time = IsTimeToLook();
  asked_at_ = static_cast<int>(observations_.size());
  if (!is_time) return std::nullopt;
  return StopByOutlook(OutlookNow(), options_.stop_share);
}

std::optional<StopShortfall> PosteriorStrategy::Shortfall() {
  if (options_.stop_share == 0) return std::nullopt;
  if (!HasDesign()) return StopShortfall{.lack = StopLack::kFirstTrials};
  return ShortOfOutlook(OutlookNow(), options_.stop_share, static_cast<int>(observations_.size()));
}

}  // namespace talus::optimizer
