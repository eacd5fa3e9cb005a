// When a posterior's search ends by itself.
#include <algorithm>
#include <vector>

#include "optimizer/outputs/output_model.h"
#include "optimizer/posterior/expected_narrowing.h"
#include "optimizer/search/stopping_rule.h"
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

Outlook PosteriorStrategy::OutlookBy(const PosteriorSample& sample, int num_draws) {
  constexpr Eigen::Index kFew = 50;
  const Eigen::MatrixXd draws = sample.Draws(num_draws, options_.seed);
  const Eigen::MatrixXd few = draws(Eigen::seqN(0, kFew, num_draws / kFew), Eigen::all);
  std::vector<SurrogateAhead> ahead = SurrogatesAhead(few);
  const ExpectedNarrowing expected(Model(), draws, options_.seed);
  const auto narrowing = [&]() -> std::vector<double> {
    const Eigen::VectorXd each = expected.Of(domain_.Asked(), ahead);
    return {each.begin(), each.end()};
  };
  Outlook outlook{.again = narrowing(), .temper = Model().temper()};
  for (SurrogateAhead& surrogate : ahead) surrogate.left.setZero();
  outlook.all = narrowing();
  return outlook;
}

const Outlook& PosteriorStrategy::OutlookNow() {
  constexpr int kDraws = 400;
  if (!outlook_) outlook_.emplace(OutlookBy(Sample(), kDraws));
  return *outlook_;
}

// An outlook of a fifth of the cost: where it is four times above the limit, the whole one never
// was below (bench/optimizers/RECORD.md, Several grain sizes). Most searches that are asked are
// that far.
bool PosteriorStrategy::IsFarFromTheEnd() {
  constexpr int kDivisor = 5;
  constexpr int kDraws = 100;
  const double far = 4 * options_.stop_share;
  return !outlook_ && !StopByOutlook(OutlookBy(SampleOf(Model(), kDivisor), kDraws), far);
}

std::optional<StopReason> PosteriorStrategy::WhyStop() {
  if (options_.stop_share == 0 || !HasDesign() || IsFarFromTheEnd()) return std::nullopt;
  return StopByOutlook(OutlookNow(), options_.stop_share);
}

std::optional<StopShortfall> PosteriorStrategy::Shortfall() {
  if (options_.stop_share == 0) return std::nullopt;
  if (!HasDesign()) return StopShortfall{.lack = StopLack::kFirstTrials};
  return ShortOfOutlook(OutlookNow(), options_.stop_share, static_cast<int>(observations_.size()));
}

}  // namespace talus::optimizer
