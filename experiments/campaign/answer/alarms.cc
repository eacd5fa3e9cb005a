#include "experiments/campaign/answer/alarms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/not_known.h"
#include "base/student_factor.h"
#include "base/text/number_text.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/fit.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/rigs/case/case_warnings.h"

namespace talus::campaign {
namespace {

constexpr double kSurprise = 2;         // standard deviations that are no luck any more
constexpr double kLeastShare = 0.1;     // of the predicted value: less is not worth a word
constexpr double kLeastOfFloor = 0.25;  // of the experiment's noise floor: neither is this

bool GaveTheSame(const journal::TrialRecord& a, const journal::TrialRecord& b) {
  const auto same = [](const journal::MetricRecord& one, const journal::MetricRecord& other) {
    const bool both_undefined = std::isnan(one.value) && std::isnan(other.value);
    return one.name == other.name && (one.value == other.value || both_undefined);
  };
  return std::ranges::equal(a.metrics, b.metrics, same);
}

// The set without the scatter of its simulations, which is what a model of mean heaps predicts; of
// another objective than the SAD that of the mean heap.
double WithoutScatter(const Answer& answer, const ResultExperiment& experiment,
                      const ResultConfirmed& confirmed) {
  if (!MinimisesSad(answer)) return ComparableOf(answer, confirmed);
  // The scatter of a single one is not known, and is a part of its SAD.
  if (confirmed.num_trials < 2) return base::kNotKnown;
  if (!confirmed.profile_sad_mm2) return confirmed.mean;
  return std::min(confirmed.mean, SadWithoutScatter(experiment, confirmed));
}

std::optional<Alarm> PredictionAlarm(const Answer& answer, const ResultExperiment& experiment) {
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, experiment.name);
  const ResultStanding* standing = StandingOf(answer, experiment.name);
  if (confirmed == nullptr || standing == nullptr) return std::nullopt;
  const double mean = WithoutScatter(answer, experiment, *confirmed);
  const double excess = mean - standing->predicted;
  const std::optional<double> floor =
      MinimisesSad(answer) ? experiment.noise_floor : std::nullopt;  // [mm²]
  const double least =
      std::max(kLeastShare * standing->predicted, kLeastOfFloor * floor.value_or(0));
  const double error =
      std::hypot(ErrorOf(answer, experiment, *confirmed), OrZero(standing->predicted_sd));
  if (!(excess > kSurprise * error) || !(excess > least)) return std::nullopt;
  return Alarm{.kind = AlarmKind::kWorseThanPredicted,
               .experiment = experiment.name,
               .unit = answer.objective_unit,
               .value = excess,
               .shown = mean,
               .noise_floor = floor};
}

// At the finest scale factor, which decides: coarser ones only guide the search.
void AddGrainWarnings(const CampaignSpec& spec, Answer& answer) {
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  const double finest = spec.coarse_graining.Finest();
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const rigs::Case rig_case = TypicalCase(spec, static_cast<int>(e), finest);
    if (!rigs::IsRoundHeap(rig_case.rig.kind)) continue;
    const double across = rigs::GrainsAcrossPlate(rig_case);
    if (across >= rigs::kAdvisedAcross) continue;
    answer.warnings.push_back({.kind = AlarmKind::kFewGrains,
                               .experiment = experiments[e].name,
                               .scale_factor = finest,
                               .value = across});
  }
}

void AddPhotographs(const journal::CampaignRecord& campaign, Answer& answer) {
  for (const journal::ExperimentRecord& experiment : campaign.experiments) {
    for (const journal::PhotoWarningRecord& warning : experiment.warnings) {
      answer.warnings.push_back(PhotographAlarm(warning, experiment.name));
    }
  }
}

// How far the set's farthest measurement is off, in what is still a fit; NaN with nothing to judge
// by.
double FarthestOff(const Answer& answer, const ResultCandidate& candidate) {
  const std::vector<MeasurementFit> distances = DistancesOf(answer, candidate);
  return distances.empty() ? base::kNotKnown : distances.front().off;
}

// How far the set is off in this measurement; NaN where that is not known.
double OffIn(const Answer& answer, const ResultCandidate& candidate, const MeasurementFit& fit) {
  for (const MeasurementFit& one : DistancesOf(answer, candidate)) {
    if (one.experiment == fit.experiment && one.number == fit.number) return one.off;
  }
  return base::kNotKnown;
}

// Another set that was simulated again and comes clearly nearer.
const ResultCandidate* NearerSet(const Answer& answer) {
  constexpr double kClearly = 0.7;  // of the recommended set's distance
  const ResultCandidate* recommended = ConfirmedSet(answer);
  if (recommended == nullptr) return nullptr;
  const ResultCandidate* nearest = nullptr;
  double least = kClearly * FarthestOff(answer, *recommended);
  for (const ResultCandidate& candidate : answer.confirmed) {
    const double miss = FarthestOff(answer, candidate);
    if (!(miss < least)) continue;
    nearest = &candidate;
    least = miss;
  }
  return nearest;
}

// Without a model there are none.
bool HasRanges(const Answer& answer) {
  return std::ranges::any_of(
      answer.parameters, [](const ResultParameter& p) { return std::isfinite(p.credible_low); });
}

constexpr const char* kExpected = "its model expected this set to fit";

// The model held the recommended set for one that fits this image.
std::optional<std::string> FaultOfImage(const Answer& answer, const ResultExperiment& experiment,
                                        const ResultStanding& standing) {
  if (!experiment.noise_floor || !MinimisesSad(answer)) return std::nullopt;
  const bool was_expected = standing.predicted <= kCloseRuns * *experiment.noise_floor &&
                            PredictionAlarm(answer, experiment);
  return was_expected ? std::optional<std::string>(kExpected) : std::nullopt;
}

// The confirming trials of a number are off its prediction by more than chance, or have none.
bool IsSurprise(const ResultScalar& confirmed, const optimizer::NumberStanding& expected) {
  if (confirmed.undefined) return true;
  const double error = std::hypot(OrZero(confirmed.standard_error), expected.predicted_sd);
  return std::abs(confirmed.mean - expected.predicted) > kSurprise * error;
}

// The same of a number; or the model's own error, the larger one, leaves open whether the set gives
// it. Where no set does, a model that knows enough predicts the miss.
std::optional<std::string> FaultOfNumber(const Answer& answer, const ResultExperiment& experiment,
                                         const ResultStanding& standing, std::size_t number) {
  const ResultConfirmed* confirmed = ConfirmedAtTarget(answer, experiment.name);
  if (confirmed == nullptr || number >= standing.numbers.size()) return std::nullopt;
  const optimizer::NumberStanding& expected = standing.numbers[number];
  const double error = experiment.numbers[number].standard_error;
  const double off = std::abs(expected.predicted - experiment.numbers[number].value);
  if (off <= kCloseNumber * error && IsSurprise(confirmed->scalars.at(number), expected)) {
    return kExpected;
  }
  const bool may_fit = off <= kCloseNumber * std::hypot(error, expected.predicted_sd);
  if (!may_fit || !(expected.predicted_sd > error)) return std::nullopt;
  return "its model is too coarse there to tell whether this set fits";
}

// Why the model that chose the recommended set is to blame for this miss.
std::optional<std::string> FaultOfModel(const Answer& answer, const MeasurementFit& fit) {
  const ResultStanding* standing = StandingOf(answer, fit.experiment);
  const auto experiment =
      std::ranges::find(answer.experiments, fit.experiment, &ResultExperiment::name);
  if (standing == nullptr) return std::nullopt;
  if (fit.number.empty()) return FaultOfImage(answer, *experiment, *standing);
  const auto number = std::ranges::find(experiment->numbers, fit.number, &ResultNumber::name);
  return FaultOfNumber(answer, *experiment, *standing,
                       static_cast<std::size_t>(number - experiment->numbers.begin()));
}

// Why a miss is the search's, which has not found what may fit; nothing where it has done its part.
std::optional<std::string> SearchFault(const Answer& answer, const MeasurementFit& fit) {
  if (const ResultCandidate* nearer = NearerSet(answer)) {
    std::vector<std::string> names;
    for (const ResultParameter& p : answer.parameters) names.push_back(p.name);
    const bool nearer_here =
        OffIn(answer, *nearer, fit) < OffIn(answer, *ConfirmedSet(answer), fit);
    return BracketedSet(names, nearer->values) + ", simulated again, too, " +
           (!Misses(answer, *nearer) ? "fits"
            : nearer_here            ? "misses less"
                                     : "misses less on the whole");
  }
  if (!answer.posterior && !HasRanges(answer)) return "there are too few simulations for a model";
  if (auto fault = FaultOfModel(answer, fit)) return fault;
  if (answer.posterior && !answer.posterior->unlearnt_scale_factors.empty()) {
    return "too few of its trials are at scale factor " +
           base::ShortNumber(answer.posterior->unlearnt_scale_factors.front()) +
           " to tell its bias";
  }
  if (answer.posterior && IsProvisional(answer.posterior->surrogate_narrowing)) {
    return "its region is still more the surrogate's than the measurements'";
  }
  return std::nullopt;
}

void Append(const std::vector<Alarm>& more, std::vector<Alarm>& alarms) {
  alarms.insert(alarms.end(), more.begin(), more.end());
}

// Experiments of which no simulation of the recommended set with fresh seeds succeeded.
std::vector<Alarm> FailureAlarms(const std::vector<journal::TrialRecord>& trials,
                                 const Answer& answer) {
  std::vector<Alarm> alarms;
  for (std::size_t e = 0; e < answer.experiments.size(); ++e) {
    int num_failed = 0, num_other = 0;
    std::string last;
    for (const journal::TrialRecord& trial : trials) {
      const bool is_it = trial.kind == journal::TrialKind::kConfirm &&
                         trial.experiment == static_cast<int>(e) &&
                         IsRecommended(answer, trial.native);
      if (!is_it) continue;
      if (trial.status != journal::TrialStatus::kFailed) {
        ++num_other;
        continue;
      }
      ++num_failed;
      last = trial.reason;
    }
    if (num_failed == 0 || num_other > 0) continue;
    alarms.push_back({.kind = AlarmKind::kConfirmationFailed,
                      .experiment = answer.experiments[e].name,
                      .value = static_cast<double>(num_failed),
                      .reason = last});
  }
  return alarms;
}

}  // namespace

std::vector<Alarm> MissAlarms(const Answer& answer) {
  std::vector<Alarm> alarms;
  for (const MeasurementFit& fit : FitsOf(answer)) {
    const ResultStanding* standing = StandingOf(answer, fit.experiment);
    if (fit.meets != Meets::kNo) continue;
    if (IsHeldOut(answer, fit.experiment)) continue;
    if (standing != nullptr && standing->implausibility > kImplausible) continue;
    const std::optional<std::string> fault = SearchFault(answer, fit);
    Alarm alarm{.kind = fault ? AlarmKind::kSearchMisses : AlarmKind::kMisses,
                .experiment = fit.experiment,
                .reason = fault};
    if (!fault) alarm.parameter = HeldByItsPrior(answer);
    if (!fit.number.empty()) alarm.number = fit.number;
    if (std::isfinite(fit.off)) alarm.value = fit.off;
    if (std::isfinite(fit.share)) alarm.share = fit.share;
    alarm.undefined = fit.undefined;
    if (answer.conditions.scale_factor > 1) alarm.scale_factor = answer.conditions.scale_factor;
    alarms.push_back(alarm);
  }
  return alarms;
}

std::vector<Alarm> PredictionAlarms(const Answer& answer) {
  std::vector<Alarm> alarms;
  for (const ResultExperiment& experiment : answer.experiments) {
    if (auto alarm = PredictionAlarm(answer, experiment)) alarms.push_back(std::move(*alarm));
  }
  return alarms;
}

// Trials of the search at this scale factor that have the objective.
int NumberOfSearch(const std::vector<journal::TrialRecord>& trials, const Reference& reference,
                   double scale_factor) {
  return static_cast<int>(std::ranges::count_if(trials, [&](const journal::TrialRecord& trial) {
    return trial.IsOfSearch() && trial.scale_factor == scale_factor &&
           trial.status == journal::TrialStatus::kOk && reference.Value(trial);
  }));
}

// The best of many trials owes something to luck: by how many standard deviations the best of so
// many lies farther off than its own mean once in fifty times.
double MostOf(int num_trials) {
  constexpr double kSeldom = 0.02;
  return base::StudentFactor(std::numeric_limits<double>::infinity(),
                             1 - 2 * kSeldom / std::max(1, num_trials));
}

std::vector<Alarm> SearchAlarms(const Answer& answer,
                                const std::vector<journal::TrialRecord>& trials,
                                const std::vector<Reference>& references) {
  if (references.size() != 1) return {};
  const ResultExperiment& experiment = answer.experiments.front();
  const ResultConfirmed* confirmed = ConfirmedOf(answer, experiment.name);
  const ResultStanding* standing = StandingOf(answer, experiment.name);
  if (confirmed == nullptr && standing == nullptr) return {};
  const double shown = confirmed != nullptr ? confirmed->mean : standing->predicted;
  const double error = confirmed != nullptr ? ErrorOf(answer, experiment, *confirmed)
                                            : OrZero(standing->predicted_sd);
  const double factor =
      confirmed != nullptr ? answer.confirmed.front().scale_factor : answer.conditions.scale_factor;
  const Reference& reference = references[0];  // of `experiment`, the first
  const journal::TrialRecord* best = BestOfSearch(trials, reference, 0, factor);
  if (best == nullptr || !std::isfinite(shown)) return {};
  const double excess = shown - *reference.Value(*best);
  const double luck = MostOf(NumberOfSearch(trials, reference, factor));
  if (!(excess > luck * std::hypot(error, NoiseOfConfirming(answer, experiment))) ||
      !(excess > kLeastShare * shown)) {
    return {};
  }
  return {{.kind = AlarmKind::kWorseThanObserved,
           .experiment = experiment.name,
           .scale_factor = factor,
           .trial = best->id,
           .unit = answer.objective_unit,
           .value = excess}};
}

std::vector<Alarm> AlikeAlarms(const std::vector<journal::TrialRecord>& trials,
                               const std::vector<ResultExperiment>& experiments) {
  constexpr int kFewest = 6;
  std::vector<Alarm> alarms;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const journal::TrialRecord* first = nullptr;
    int count = 0;
    const bool alike = std::ranges::all_of(trials, [&](const journal::TrialRecord& trial) {
      if (trial.experiment != static_cast<int>(e) || trial.status != journal::TrialStatus::kOk) {
        return true;
      }
      ++count;
      if (first == nullptr) first = &trial;
      return GaveTheSame(*first, trial);
    });
    if (!alike || count < kFewest || first->metrics.empty()) continue;
    alarms.push_back(
        {.kind = AlarmKind::kAllAlike, .experiment = experiments[e].name, .value = 1.0 * count});
  }
  return alarms;
}

void AddAlarms(const AlarmBasis& basis, Answer& answer) {
  std::vector<Alarm>& alarms = answer.warnings;
  Append(AlikeAlarms(basis.trials, answer.experiments), alarms);
  Append(MissAlarms(answer), alarms);
  // Without a posterior nothing else tells MissAlarms that the experiment is held out.
  if (basis.spec.hold_out) {
    std::erase_if(alarms, [&](const Alarm& a) { return a.experiment == basis.spec.hold_out; });
  }
  Append(FailureAlarms(basis.trials, answer), alarms);
  Append(PredictionAlarms(answer), alarms);
  Append(SearchAlarms(answer, basis.trials, basis.references), alarms);
  Append(PosteriorAlarms(answer), alarms);
  Append(PriorAlarms(answer), alarms);
  Append(BudgetAlarms(answer), alarms);
  Append(GoalAlarms(basis.spec, basis.goal), alarms);
  Append(CorrelationAlarms(answer), alarms);
  Append(BoundAlarms(answer), alarms);
  AddGrainWarnings(basis.spec, answer);
  AddPhotographs(basis.campaign, answer);
  std::ranges::stable_sort(alarms, {}, &Alarm::kind);
}

}  // namespace talus::campaign
