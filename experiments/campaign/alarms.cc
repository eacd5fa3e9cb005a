#include "experiments/campaign/alarms.h"

#include <algorithm>
#include <cmath>

#include "base/text/number_text.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/plan/campaign_strategy.h"
#include "experiments/rigs/lifted_tube/heap_scene.h"
#include "optimizer/answer/answer.h"

namespace talus::campaign {
namespace {

constexpr double kSurprise = 2;          // standard deviations that are no luck any more
constexpr double kLeastShare = 0.1;      // of the predicted value: less is not worth a word
constexpr double kLeastOfFloor = 0.25;   // of the experiment's noise floor: neither is this
constexpr int kFewestLeftOut = 10;       // evaluations that a coverage is judged from
constexpr double kLeastCoverage = 0.75;  // of nominal 90 % regions
constexpr double kMostLeftOut = 0.8;     // error / standard deviation: a constant has 1

double OrZero(double x) { return std::isfinite(x) ? x : 0; }

// Error of the recommended set's confirmed mean. A few seeds that happen to agree say little of it.
double ErrorOf(const CampaignResult& result, const ResultCandidate& confirmed) {
  return std::max(OrZero(confirmed.standard_error),
                  OrZero(result.noise_sd) / std::sqrt(std::max(1, confirmed.num_trials)));
}

// What the set would have without any scatter, which is what a model of mean heaps predicts. The
// square of a mean profile's SAD falls as a + b/n with its n heaps: one heap and the mean of n tell
// a.
double WithoutScatter(const ResultCandidate& confirmed) {
  if (!confirmed.profile_sad_mm2 || confirmed.num_trials < 2) return confirmed.mean;
  const double one = confirmed.mean;
  const double all = *confirmed.profile_sad_mm2;
  const double n = confirmed.num_trials;
  return std::min(one, std::sqrt(std::max(0.0, (n * all * all - one * one) / (n - 1))));
}

// "… by 0.68 mm² (noise floor 0.7), 0.08 mm² more than the model predicted"
std::string ConfirmedText(const CampaignResult& result, double confirmed, double excess) {
  const std::string unit = result.objective_unit.empty() ? "" : " " + result.objective_unit;
  std::string text =
      "simulated again with fresh seeds, the mean heap of the recommended set misses the "
      "experiment by " +
      base::ShortNumber(confirmed, 2) + unit;
  if (result.noise_floor) {
    text += " (noise floor " + base::ShortNumber(*result.noise_floor, 2) + ")";
  }
  return text + ", " + base::ShortNumber(excess, 2) + unit + " more than the model predicted";
}

// The best trial of the search at the target scale factor, of the first experiment.
const journal::TrialRecord* BestOfSearch(const std::vector<journal::TrialRecord>& trials,
                                         const Reference& reference, double scale_factor) {
  const journal::TrialRecord* best = nullptr;
  for (const journal::TrialRecord& trial : trials) {
    if (!IsOfSearch(trial) || trial.experiment != 0 || trial.scale_factor != scale_factor) continue;
    if (trial.status != journal::TrialStatus::kOk || !reference.Value(trial)) continue;
    if (best == nullptr || *reference.Value(trial) < *reference.Value(*best)) best = &trial;
  }
  return best;
}

// At the finest scale factor, which decides: coarser ones only guide the search.
void AddGrainWarnings(const CampaignSpec& spec, CampaignResult& result) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  const double finest = std::ranges::min(spec.coarse_graining.Levels());
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const rigs::HeapCase heap_case = TypicalCase(spec, static_cast<int>(e), finest);
    if (rigs::KindOf(heap_case) != rigs::RigKind::kLiftedTube) continue;
    const double across = rigs::GrainsAcrossPlate(heap_case);
    if (across >= rigs::kAdvisedAcross) continue;
    result.warnings.push_back(Worded({.kind = WarningKind::kFewGrains,
                                      .experiment = experiments[e].name,
                                      .scale_factor = finest,
                                      .value = across}));
  }
}

void AddPhotographs(const journal::CampaignRecord& campaign, CampaignResult& result) {
  for (const journal::ExperimentRecord& experiment : campaign.experiments) {
    for (const journal::PhotoWarningRecord& warning : experiment.warnings) {
      result.warnings.push_back(PhotographWarning(warning, experiment.name));
    }
  }
}

void Append(const std::vector<ResultWarning>& more, std::vector<ResultWarning>& warnings) {
  warnings.insert(warnings.end(), more.begin(), more.end());
}

}  // namespace

std::vector<ResultWarning> DisappointmentAlarms(const CampaignResult& result,
                                                const std::vector<journal::TrialRecord>& trials,
                                                const Reference& reference) {
  std::vector<ResultWarning> alarms;
  const bool is_confirmed = !result.confirmed.empty();
  const double shown = is_confirmed ? result.confirmed[0].mean : result.predicted;
  const double error =
      is_confirmed ? ErrorOf(result, result.confirmed[0]) : OrZero(result.predicted_sd);
  if (is_confirmed && std::isfinite(result.predicted)) {
    const double mean = WithoutScatter(result.confirmed[0]);
    const double excess = mean - result.predicted;
    const double least =
        std::max(kLeastShare * result.predicted, kLeastOfFloor * result.noise_floor.value_or(0));
    if (excess > kSurprise * std::hypot(error, OrZero(result.predicted_sd)) && excess > least) {
      alarms.push_back(Worded({.kind = WarningKind::kWorseThanPredicted,
                               .value = excess,
                               .text = ConfirmedText(result, mean, excess)}));
    }
  }
  const double factor =
      is_confirmed ? result.confirmed[0].scale_factor : result.conditions.scale_factor;
  const journal::TrialRecord* best = BestOfSearch(trials, reference, factor);
  if (best == nullptr || !std::isfinite(shown)) return alarms;
  const double excess = shown - *reference.Value(*best);
  // The best of many trials owes something to luck: its own scatter counts.
  if (excess > kSurprise * std::hypot(error, OrZero(result.noise_sd)) &&
      excess > kLeastShare * shown) {
    alarms.push_back(Worded({.kind = WarningKind::kWorseThanObserved,
                             .scale_factor = factor,
                             .trial = best->id,
                             .value = excess}));
  }
  return alarms;
}

std::vector<ResultWarning> CorrelationAlarms(const CampaignResult& result) {
  const auto pair = TiedPair(result.correlation);
  // Draws of a small region may correlate as strongly as they like.
  const bool is_open = result.verdict && (result.verdict->kind == VerdictKind::kCurve ||
                                          result.verdict->kind == VerdictKind::kSeparate);
  if (!pair || !is_open) return {};
  return {Worded({.kind = WarningKind::kCorrelated,
                  .parameter = result.parameters[pair->first].name,
                  .other_parameter = result.parameters[pair->second].name,
                  .value = result.correlation[pair->first][pair->second]})};
}

std::vector<ResultWarning> BoundAlarms(const CampaignResult& result,
                                       const optimizer::ParameterSpace& space) {
  const std::vector<int> free = space.Free();
  Eigen::VectorXd point(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    point[static_cast<Eigen::Index>(i)] =
        space.parameters[static_cast<std::size_t>(free[i])].ToUnit(result.parameters[i].value);
  }
  std::vector<ResultWarning> alarms;
  for (const optimizer::BoundWarning& bound : optimizer::BoundWarnings(point)) {
    alarms.push_back(
        Worded({.kind = WarningKind::kBound,
                .parameter = result.parameters[static_cast<std::size_t>(bound.parameter)].name,
                .side = bound.is_upper ? "upper" : "lower"}));
  }
  return alarms;
}

std::vector<ResultWarning> ModelAlarms(const optimizer::Answer& answer) {
  if (answer.posterior) {
    const optimizer::PosteriorSummary& p = *answer.posterior;
    if (p.num_left_out < kFewestLeftOut || p.raw_coverage >= kLeastCoverage) return {};
    return {Worded({.kind = WarningKind::kPoorModel,
                    .value = p.raw_coverage,
                    .text = "of the simulations left out of the fit one by one, " +
                            base::ShortNumber(std::round(100 * p.raw_coverage)) +
                            " % lay within its 90 % regions; the ranges are widened by " +
                            base::ShortNumber(std::sqrt(p.temper), 2) + " for it"})};
  }
  if (!(answer.left_out_share > kMostLeftOut)) return {};
  return {Worded({.kind = WarningKind::kPoorModel,
                  .value = answer.left_out_share,
                  .text = "trials left out are missed by " +
                          base::ShortNumber(std::round(100 * answer.left_out_share)) +
                          " % of their standard deviation, and a constant would miss them by "
                          "100 %"})};
}

std::vector<ResultWarning> BudgetAlarms(const CampaignResult& result) {
  if (!result.unsettled) return {};
  ResultWarning warning{.kind = WarningKind::kBudgetEnded, .text = result.unsettled->why};
  if (std::isfinite(result.unsettled->num_more)) warning.value = result.unsettled->num_more;
  return {Worded(std::move(warning))};
}

void AddAlarms(const AlarmBasis& basis, CampaignResult& result) {
  Append(DisappointmentAlarms(result, basis.trials, basis.reference), result.warnings);
  Append(ModelAlarms(basis.answer), result.warnings);
  if (result.posterior) Append(PosteriorWarnings(*result.posterior), result.warnings);
  Append(BudgetAlarms(result), result.warnings);
  Append(CorrelationAlarms(result), result.warnings);
  Append(BoundAlarms(result, basis.space), result.warnings);
  AddGrainWarnings(basis.spec, result);
  AddPhotographs(basis.campaign, result);
}

}  // namespace talus::campaign
