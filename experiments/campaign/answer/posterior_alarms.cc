// The alarms that the posterior, its parameters and the end of the search give.
#include <algorithm>
#include <cmath>

#include "experiments/campaign/answer/agreement.h"
#include "experiments/campaign/answer/alarms.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/rigs/observables/shown_number.h"
#include "optimizer/search/describe_minimum.h"

namespace talus::campaign {
namespace {

constexpr double kContradicts = 3;       // standard deviations of a prior
constexpr int kFewestLeftOut = 10;       // evaluations that a coverage is judged from
constexpr double kLeastCoverage = 0.75;  // of nominal 90 % regions
constexpr int kEnoughAtFinest = 12;  // simulations of each experiment (bench/twins/dem_twins.py)

// The regions of several experiments are small, and the errors of their surrogates weigh more. A
// search that ended since more simulations would hardly narrow the ranges has counted that in.
bool HasFewSimulations(const Answer& answer) {
  const ResultPosterior& p = *answer.posterior;
  const bool is_done = answer.stop.rule && answer.stop.rule->rule == optimizer::StopRule::kShare;
  return p.experiments.size() > 1 && !p.is_extrapolated && p.unlearnt_scale_factors.empty() &&
         p.fewest_at_finest < kEnoughAtFinest && !is_done;
}

// The experiment with the fewest simulations at the smallest scale factor. One that is held out has
// no standing.
std::string MostCautious(const ResultPosterior& posterior) {
  return std::ranges::max_element(posterior.experiments, {}, &ResultStanding::caution)->name;
}

}  // namespace

std::vector<Alarm> PosteriorAlarms(const Answer& answer) {
  std::vector<Alarm> alarms;
  if (!answer.posterior) return alarms;
  const ResultPosterior& p = *answer.posterior;
  for (const ResultStanding& e : p.experiments) {
    if (!(e.implausibility > kImplausible)) continue;
    alarms.push_back({.kind = AlarmKind::kImplausible,
                      .parameter = HeldByItsPrior(answer),
                      .experiment = e.name,
                      .value = e.implausibility,
                      .reason = p.experiments.size() > 1
                                    ? std::optional<std::string>("beside the other tests")
                                    : std::nullopt});
  }
  if (Disagree(p.tension, p.raw_coverage)) {
    alarms.push_back({.kind = AlarmKind::kDisagree, .experiment = p.odd, .value = p.tension});
  }
  if (p.num_left_out >= kFewestLeftOut && p.raw_coverage < kLeastCoverage) {
    alarms.push_back(
        {.kind = AlarmKind::kPoorModel, .value = p.raw_coverage, .widened = std::sqrt(p.temper)});
  }
  if (p.is_extrapolated) {
    alarms.push_back({.kind = AlarmKind::kExtrapolated, .scale_factor = p.target_scale_factor});
  }
  for (const double level : p.unlearnt_scale_factors) {
    alarms.push_back({.kind = AlarmKind::kUnlearntScaleFactor, .scale_factor = level});
  }
  if (HasFewSimulations(answer)) {
    alarms.push_back({.kind = AlarmKind::kFewSimulations,
                      .experiment = MostCautious(p),
                      .value = 1.0 * p.fewest_at_finest});
  }
  return alarms;
}

std::vector<Alarm> CorrelationAlarms(const Answer& all) {
  const Answer answer = AskedPart(all);
  const auto pair = TiedPair(answer.correlation);
  // Draws of a small region may correlate as strongly as they like.
  const bool is_open = answer.verdict && (answer.verdict->kind == VerdictKind::kCurve ||
                                          answer.verdict->kind == VerdictKind::kSeparate);
  if (!pair || !is_open) return {};
  return {{.kind = AlarmKind::kCorrelated,
           .parameter = answer.parameters[pair->first].name,
           .other_parameter = answer.parameters[pair->second].name,
           .value = answer.correlation[pair->first][pair->second]}};
}

std::vector<Alarm> BoundAlarms(const Answer& all) {
  const Answer answer = AskedPart(all);
  std::vector<Alarm> alarms;
  for (const optimizer::BoundWarning& bound : optimizer::BoundWarnings(RecommendedPoint(answer))) {
    alarms.push_back(
        {.kind = AlarmKind::kBound,
         .parameter = answer.parameters[static_cast<std::size_t>(bound.parameter)].name,
         .side = bound.is_upper ? "upper" : "lower"});
  }
  return alarms;
}

std::vector<Alarm> PriorAlarms(const Answer& answer) {
  std::vector<Alarm> alarms;
  for (const ResultParameter& p : answer.parameters) {
    if (!p.prior || !(std::abs(p.prior->offset) > kContradicts)) continue;
    alarms.push_back({.kind = AlarmKind::kContradictsPrior,
                      .parameter = p.name,
                      .value = p.prior->offset,
                      .reason = p.prior->text});
  }
  return alarms;
}

std::vector<Alarm> BudgetAlarms(const Answer& answer) {
  if (!answer.unsettled) return {};
  Alarm alarm{.kind = AlarmKind::kBudgetEnded,
              .reason = answer.stop.Text() + ", and " + answer.unsettled->why};
  if (answer.unsettled->num_more > 0) alarm.value = answer.unsettled->num_more;
  return {alarm};
}

std::vector<Alarm> GoalAlarms(const CampaignSpec& spec, const std::optional<GoalState>& goal) {
  if (!spec.goal || (goal && goal->reason)) return {};
  const std::string text =
      goal ? TextOf(*goal, *spec.goal)
           : rigs::SpokenName(spec.goal->metric()) + " of " + spec.goal->file.stem().string() +
                 " was never looked at: the first look comes after 16 trials and the "
                 "first design";
  return {{.kind = AlarmKind::kGoalMissed, .reason = text}};
}

}  // namespace talus::campaign
