// When a posterior's search ends by itself.
#include <algorithm>
#include <cmath>
#include <vector>

#include "optimizer/outputs/output_model.h"
#include "optimizer/posterior/expected_narrowing.h"
#include "optimizer/search/stopping_rule.h"
#include "optimizer/strategy/posterior_strategy.h"

namespace talus::optimizer {
namespace {

constexpr int kOutlookDraws = 400;

}  // namespace

bool PosteriorStrategy::HasDesign() {
  return CanModel() && !FromDesign({}) && !TooFewAt(Eigen::VectorXd(), {});
}

// Number of this experiment's evaluations among the first two thirds of what was told.
std::ptrdiff_t PosteriorStrategy::NumEarlier(const Told& told) const {
  const std::size_t earlier = 2 * observations_.size() / 3;
  return std::ranges::lower_bound(told.place, earlier) - told.place.begin();
}

// Without error, and with the evaluations at the finest scale factor that half as many again bring.
std::vector<SurrogateAhead> PosteriorStrategy::SureSurrogates() {
  std::vector<SurrogateAhead> ahead;
  for (std::size_t e = 0; e < told_.size(); ++e) {
    const std::vector<int>& level = told_[e].by_code.front().level;
    const auto finest = std::ranges::count(level, levels_.finest());
    const auto finest_before =
        std::count(level.begin(), level.begin() + NumEarlier(told_[e]), levels_.finest());
    const double times = 1 + 1.5 * static_cast<double>(finest - finest_before) /
                                 static_cast<double>(std::max<std::ptrdiff_t>(1, finest));
    ahead.push_back(
        {.left = Eigen::VectorXd::Zero(Model().models()[e].num_outputs()), .times_finest = times});
  }
  return ahead;
}

// What half as many evaluations again leave, with today's hyper-parameters. No variance falls
// faster than that of a mean of independent evaluations at the finest scale factor: where the last
// third was the first to tell a discrepancy, it did once.
std::vector<SurrogateAhead> PosteriorStrategy::SurrogatesAhead(const Eigen::MatrixXd& draws) {
  std::vector<SurrogateAhead> ahead = SureSurrogates();
  for (std::size_t e = 0; e < told_.size(); ++e) {
    const Told& told = told_[e];
    const double least = 1 / ahead[e].times_finest;
    ahead[e].left.setConstant(least);
    const auto count = static_cast<int>(NumEarlier(told));
    if (count < kFewest || !told.TellsBy(count)) continue;
    const ExperimentModel before(SetupOf(e), told.FirstOf(count), &*told.state);
    const auto typical = [&](const ExperimentModel& model) -> Eigen::ArrayXd {
      return model.Outputs(draws).variance.colwise().mean().transpose();
    };
    ahead[e].left = (typical(Model().models()[e]) / typical(before)).max(least).min(1.0);
  }
  return ahead;
}

std::vector<double> PosteriorStrategy::NarrowingBy(const Eigen::MatrixXd& draws,
                                                   const std::vector<SurrogateAhead>& ahead) {
  const Eigen::VectorXd each =
      ExpectedNarrowing(Model(), draws, options_.seed).Of(domain_.Asked(), ahead);
  return {each.begin(), each.end()};
}

Outlook PosteriorStrategy::OutlookBy(const Eigen::MatrixXd& draws) {
  return {.all = NarrowingBy(draws, SureSurrogates()), .temper = Model().temper()};
}

const Outlook& PosteriorStrategy::OutlookNow() {
  if (!outlook_) outlook_.emplace(OutlookBy(Sample().Draws(kOutlookDraws, options_.seed)));
  return *outlook_;
}

// An outlook of a fifth of the cost: where it is four times above the limit, the whole one never
// was below (bench/optimizers/RECORD.md, Several grain sizes). Most searches that are asked are
// that far.
bool PosteriorStrategy::IsFarFromTheEnd() {
  constexpr int kDivisor = 5;
  constexpr int kDraws = 100;
  if (outlook_) return false;
  const Eigen::MatrixXd draws = SampleOf(Model(), kDivisor).Draws(kDraws, options_.seed);
  return !StopByOutlook(OutlookBy(draws), 4 * options_.stop_share);
}

std::optional<StopReason> PosteriorStrategy::WhyStop() {
  if (options_.stop_share == 0 || !HasDesign() || IsFarFromTheEnd()) return std::nullopt;
  return StopByOutlook(OutlookNow(), options_.stop_share);
}

std::optional<StopShortfall> PosteriorStrategy::UndefinedNumber() const {
  if (CanModel() || FromDesign({})) return std::nullopt;
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const auto is_here = [&](const Observation& o) { return o.experiment == static_cast<int>(e); };
    for (std::size_t s = 0; s < targets_[e].scalars.size(); ++s) {
      const auto has_it = [&](const Observation& o) {
        return is_here(o) && s < o.scalars.size() && std::isfinite(o.scalars[s]);
      };
      const auto num_defined = static_cast<int>(std::ranges::count_if(observations_, has_it));
      if (num_defined >= kFewest) continue;
      return StopShortfall{
          .lack = StopLack::kDefined,
          .number = targets_[e].scalars[s].name,
          .num_defined = num_defined,
          .num_told = static_cast<int>(std::ranges::count_if(observations_, is_here))};
    }
  }
  return std::nullopt;
}

std::optional<StopShortfall> PosteriorStrategy::Shortfall() {
  if (options_.stop_share == 0) return std::nullopt;
  if (!HasDesign())
    return UndefinedNumber().value_or(StopShortfall{.lack = StopLack::kFirstTrials});
  constexpr Eigen::Index kFew = 50;
  const Eigen::MatrixXd draws = Sample().Draws(kOutlookDraws, options_.seed);
  const Eigen::MatrixXd few = draws(Eigen::seqN(0, kFew, kOutlookDraws / kFew), Eigen::all);
  Outlook outlook = OutlookNow();
  outlook.again = NarrowingBy(draws, SurrogatesAhead(few));
  return ShortOfOutlook(outlook, options_.stop_share, static_cast<int>(observations_.size()));
}

}  // namespace talus::optimizer
