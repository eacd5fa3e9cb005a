#include "experiments/campaign/answer/conclude.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/sample.h"
#include "base/text/joined.h"
#include "base/version.h"
#include "experiments/campaign/answer/agreement.h"
#include "experiments/campaign/answer/alarms.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/headline.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/answer/nuisances.h"
#include "experiments/campaign/answer/representatives.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/plan/cores.h"
#include "experiments/rigs/case/case.h"
#include "experiments/rigs/case/device_text.h"
#include "experiments/rigs/observables/shown_number.h"
#include "imaging/photos/sad_from_others.h"
#include "imaging/spheres/projection.h"
#include "optimizer/outputs/levels.h"

namespace talus::campaign {
namespace {

// A metric over the trials that have it.
base::Sample MetricSample(const std::vector<const journal::TrialRecord*>& trials,
                          std::string_view name) {
  std::vector<double> values;
  for (const journal::TrialRecord* trial : trials) {
    if (const auto value = trial->Metric(name)) values.push_back(*value);
  }
  return base::SampleOf(values);
}

// Why none of the trials that ended has a value; nothing where one has, and where none ended.
std::optional<std::string> WhyUndefined(const std::vector<const journal::TrialRecord*>& trials,
                                        std::string_view name) {
  std::optional<std::string> why;
  for (const journal::TrialRecord* trial : trials) {
    if (trial->Metric(name)) return std::nullopt;
    const auto metric = std::ranges::find(trial->metrics, name, &journal::MetricRecord::name);
    if (!why && metric != trial->metrics.end()) why = metric->undefined;
  }
  return why;
}

ResultConfirmed ConfirmedOf(const std::vector<const journal::TrialRecord*>& trials,
                            const CampaignEvidence& evidence, std::size_t experiment) {
  const Reference& reference = evidence.references[experiment];
  const journal::ExperimentRecord& record = evidence.campaign.experiments[experiment];
  ResultConfirmed confirmed{.name = record.name};
  std::vector<double> objective;
  std::vector<imaging::GrayImage> profiles;
  for (const journal::TrialRecord* trial : trials) {
    if (reference.has_image() && reference.IsMeasured(*trial)) {
      objective.push_back(reference.Value(*trial).value_or(kWorstAngle));
    }
    if (trial->status != journal::TrialStatus::kOk) continue;
    if (auto profile = evidence.profile(trial->id)) profiles.push_back(std::move(*profile));
  }
  const base::Sample sample = base::SampleOf(objective);
  // One without the number that was measured tells, too.
  confirmed.num_trials = static_cast<int>(
      std::count_if(trials.begin(), trials.end(), [&](const journal::TrialRecord* trial) {
        return reference.has_image() ? reference.IsMeasured(*trial)
                                     : trial->status == journal::TrialStatus::kOk;
      }));
  confirmed.mean = sample.mean;
  confirmed.standard_error = sample.StandardError();
  const base::Sample sad = MetricSample(trials, journal::InfoOf(journal::Objective::kSad).metric);
  if (sad.count > 0) confirmed.sad_mm2 = sad.mean;
  if (!profiles.empty()) {
    journal::TrialRecord mean;
    mean.metrics = reference.Measure(imaging::MeanImage(profiles));
    confirmed.profile_sad_mm2 = mean.Metric(journal::InfoOf(journal::Objective::kSad).metric);
    confirmed.profile_objective = reference.Value(mean);
  }
  if (profiles.size() > 1) {
    const double pixel = reference.frame()->pixel_size * 1e3;  // [mm]
    confirmed.spread_mm2 = base::SampleOf(imaging::SadFromOthers(profiles)).mean * pixel * pixel;
  }
  if (confirmed.profile_sad_mm2 && record.noise_mm2) {
    confirmed.over_floor = *confirmed.profile_sad_mm2 / *record.noise_mm2;
  }
  for (const journal::ScalarRecord& scalar : record.scalars) {
    const base::Sample number = MetricSample(trials, scalar.name);
    confirmed.scalars.push_back({.name = scalar.name,
                                 .num_trials = number.count,
                                 .mean = number.mean,
                                 .undefined = WhyUndefined(trials, scalar.name)});
  }
  return confirmed;
}

// Scatter of a metric from seed to seed, pooled from within the confirmed sets.
base::PooledScatter ScatterOf(const Planner& planner, const std::vector<Candidate>& simulated,
                              int experiment, std::string_view metric) {
  base::PooledScatter scatter;
  for (const Candidate& candidate : simulated) {
    scatter.Add(MetricSample(planner.Confirming(candidate.point, experiment), metric));
  }
  return scatter;
}

// Two or three seeds say little of their own scatter; those of all confirmed sets together say
// more, and where each has one seed the model alone says something. `target`: the scale factor that
// it is of.
void AddStandardErrors(Planner& planner, const Eigen::VectorXd& recommended,
                       const std::vector<Candidate>& simulated, double target, Answer& result) {
  const std::string_view sad_metric = journal::InfoOf(journal::Objective::kSad).metric;
  std::vector<std::vector<double>> noise;  // of each experiment's numbers
  for (std::size_t e = 0; e < result.experiments.size(); ++e) {
    noise.push_back(planner.NumberNoise(recommended, static_cast<int>(e)));
  }
  for (ResultCandidate& candidate : result.confirmed) {
    for (std::size_t e = 0; e < candidate.experiments.size(); ++e) {
      ResultConfirmed& confirmed = candidate.experiments[e];
      const int index = static_cast<int>(e);
      if (confirmed.sad_mm2) {
        const auto scatter = ScatterOf(planner, simulated, index, sad_metric);
        confirmed.degrees = scatter.degrees;
        if (scatter.degrees > 0) {
          confirmed.sad_standard_error = scatter.StandardError(confirmed.num_trials);
        }
      }
      for (std::size_t s = 0; s < confirmed.scalars.size(); ++s) {
        ResultScalar& scalar = confirmed.scalars[s];
        const auto scatter = ScatterOf(planner, simulated, index, scalar.name);
        if (scalar.num_trials == 0) continue;
        scalar.standard_error = scatter.StandardError(scalar.num_trials);
        scalar.degrees = scatter.degrees;
        if (scatter.degrees > 0 || noise[e].empty()) continue;
        scalar.standard_error = noise[e][s] *
                                optimizer::NoiseRatio(candidate.scale_factor, target) /
                                std::sqrt(scalar.num_trials);
      }
    }
  }
}

ResultCandidate CandidateOf(const Planner& planner, const CampaignEvidence& evidence,
                            const Candidate& simulated) {
  const Eigen::VectorXd& point = simulated.point;
  ResultCandidate candidate{.role = simulated.role, .values = FreeValues(planner.space(), point)};
  for (std::size_t e = 0; e < evidence.references.size(); ++e) {
    const auto trials = planner.Confirming(point, static_cast<int>(e));
    for (const journal::TrialRecord* trial : trials) candidate.scale_factor = trial->scale_factor;
    candidate.experiments.push_back(ConfirmedOf(trials, evidence, e));
  }
  return candidate;
}

// The objective's noise sd, from the trials at one set before the search.
std::optional<double> ReplicatesSd(const Planner& planner, const Reference& reference,
                                   int experiment) {
  std::vector<double> values;
  for (const journal::TrialRecord& trial : planner.trials()) {
    if (trial.kind != journal::TrialKind::kNoise || trial.experiment != experiment) continue;
    if (const auto value = reference.Value(trial)) values.push_back(*value);
  }
  if (values.size() < 2) return std::nullopt;
  return base::SampleOf(values).Sd();
}

ResultExperiment ExperimentOf(const Planner& planner, const CampaignEvidence& evidence,
                              std::size_t experiment) {
  const journal::ExperimentRecord& record = evidence.campaign.experiments[experiment];
  const Reference& reference = evidence.references[experiment];
  const int index = static_cast<int>(experiment);
  ResultExperiment made{.name = record.name,
                        .has_image = reference.has_image(),
                        .num_heaps = record.num_heaps,
                        .numbers = record.scalars,
                        .noise_floor = record.noise_mm2,
                        .replicates_sd = ReplicatesSd(planner, reference, index)};
  if (const auto frame = reference.frame()) {
    made.powder_area = record.nebp_px * std::pow(1e3 * frame->pixel_size, 2);
    const int num_simulated =
        rigs::NumViewsOf(TypicalCase(evidence.spec, index, evidence.spec.coarse_graining.Target()));
    const double ratio = static_cast<double>(num_simulated) / reference.NumViews();
    if (record.num_heaps == 1) made.views_per_photograph = std::max(1.0, ratio);
  }
  return made;
}

void AddExperiments(const optimizer::Answer& answer, Planner& planner,
                    const CampaignEvidence& evidence, Answer& result) {
  for (std::size_t e = 0; e < evidence.references.size(); ++e) {
    result.experiments.push_back(ExperimentOf(planner, evidence, e));
    result.experiments.back().noise_sd = planner.NoiseSd(answer.point, static_cast<int>(e));
  }
}

std::optional<ResultNuisance> NuisanceOf(const optimizer::Answer& answer, const Planner& planner,
                                         std::size_t i) {
  const auto& space = planner.space();
  const std::vector<int> free = space.Free();
  const auto parameter = [&](auto k) -> const optimizer::Parameter& {
    return space.parameters[static_cast<std::size_t>(free[static_cast<std::size_t>(k)])];
  };
  if (!parameter(i).is_nuisance) return std::nullopt;
  ResultNuisance nuisance;
  if (!answer.posterior) return nuisance;
  for (const optimizer::NuisanceWeight& weight : answer.posterior->nuisances) {
    if (weight.coordinate != static_cast<Eigen::Index>(i)) continue;
    nuisance = {.narrowing = weight.narrowing, .of_range = parameter(weight.other).name};
  }
  return nuisance;
}

void AddParameters(const optimizer::Answer& answer, const Planner& planner,
                   const CampaignSpec& spec, Answer& result) {
  const auto& space = planner.space();
  const std::vector<int> free = space.Free();
  const std::vector<double> values = FreeValues(space, answer.point);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[i])];
    ResultParameter parameter{.name = p.name,
                              .unit = UnitOf(p.name),
                              .value = values[i],
                              .searched_low = p.low,
                              .searched_high = p.high,
                              .scale = p.scale};
    if (i < answer.credible.size()) {
      parameter.credible_low = p.ToNative(answer.credible[i].low);
      parameter.credible_high = p.ToNative(answer.credible[i].high);
    }
    if (i < answer.sobol_first.size()) parameter.sobol_first = answer.sobol_first[i];
    if (i < answer.sobol_total.size()) parameter.sobol_total = answer.sobol_total[i];
    if (answer.posterior) parameter.prior = PriorOf(*answer.posterior, space, i, *spec.parameters);
    parameter.nuisance = NuisanceOf(answer, planner, i);
    result.parameters.push_back(parameter);
  }
}

void AddConfirmation(const optimizer::Answer& answer, Planner& planner,
                     const CampaignEvidence& evidence, Answer& result) {
  const std::vector<Candidate> all = planner.Candidates(answer);
  for (const Candidate& simulated : all) {
    ResultCandidate candidate = CandidateOf(planner, evidence, simulated);
    const auto succeeded = [](const ResultConfirmed& c) { return c.num_trials > 0; };
    if (std::ranges::any_of(candidate.experiments, succeeded)) {
      result.confirmed.push_back(std::move(candidate));
    }
  }
  AddStandardErrors(planner, answer.point, all, evidence.spec.coarse_graining.Target(), result);
}

// Those of the set at `point`: Young's modulus may be fixed, or searched, among the parameters.
ResultConditions ConditionsOf(const CampaignSpec& spec, const Eigen::VectorXd& point) {
  const double target = spec.coarse_graining.Target();
  ResultConditions conditions{
      .scale_factor = target,
      .surface_energy_exponent = spec.coarse_graining.surface_energy_exponent,
      .youngs_modulus = CaseAt(spec, point, 0, target).powder.material.youngs_modulus,
      .adhesion = std::string(base::NameOf(spec.models.adhesion)),
      .rolling = std::string(base::NameOf(spec.models.rolling))};
  if (spec.engine.kind == EngineKind::kCommand) {
    conditions.command = base::Joined(spec.engine.command.command, " ");
  }
  const std::vector<ExperimentSpec> experiments = ExperimentsOf(spec);
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    if (experiments[e].name == spec.hold_out) continue;  // the answer does not come from it
    conditions.devices.push_back(
        {.experiment = experiments[e].name,
         .text = rigs::DeviceText(TypicalCase(spec, static_cast<int>(e), target).rig)});
  }
  return conditions;
}

ResultCost CostOf(const Planner& planner, const CampaignEvidence& evidence) {
  const double of_trials = MeasuredCoreTime(planner.trials(), evidence.spec);
  ResultCost cost{.core_hours = (planner.CoreTimeOfGoal() + of_trials) / 3600,
                  .elapsed = evidence.elapsed};
  for (const journal::TrialRecord& trial : planner.trials()) {
    if (trial.status == journal::TrialStatus::kRunning ||
        trial.kind == journal::TrialKind::kReused) {
      continue;
    }
    ++cost.num_trials;
    if (trial.status == journal::TrialStatus::kFailed) ++cost.num_failed;
  }
  return cost;
}

JointView ViewOf(const Planner& planner, const CampaignEvidence& evidence) {
  JointView view{.folder = {},
                 .spec = evidence.spec,
                 .record = evidence.campaign,
                 .references = evidence.references,
                 .space = planner.space(),
                 .trials = planner.trials()};
  view.Observe([&](const journal::TrialRecord& trial) {
    const auto profile = evidence.profile(trial.id);
    const Reference& reference = evidence.references[static_cast<std::size_t>(trial.experiment)];
    return profile ? reference.Field(*profile) : std::vector<float>{};
  });
  return view;
}

ResultUnsettled UnsettledBy(optimizer::StopShortfall lacks, const Answer& answer) {
  lacks.number = rigs::SpokenName(lacks.number);
  std::vector<std::string> names;
  for (const std::size_t k : AskedParameters(answer)) names.push_back(answer.parameters[k].name);
  ResultUnsettled unsettled{
      .lacks = lacks.lack, .why = optimizer::TextOf(lacks, names), .num_more = lacks.num_more};
  for (std::size_t k = 0; k < lacks.narrowing.size(); ++k) {
    unsettled.narrowing.push_back({.parameter = names[k], .share = lacks.narrowing[k]});
  }
  return unsettled;
}

// Whether the experiments agree and, where they do not, what each alone would say: it tells which
// of them is the odd one.
void AddAgreement(const Planner& planner, const CampaignEvidence& evidence, Answer& result) {
  if (evidence.references.size() < 2 || !result.posterior) return;
  const Agreement agreement = AgreementOf(ViewOf(planner, evidence));
  result.posterior->tension = agreement.tension;
  result.posterior->odd = agreement.odd;
  const std::vector<Alarm> alarms = PosteriorAlarms(result);
  if (std::ranges::none_of(alarms, [](const Alarm& a) {
        return a.kind == AlarmKind::kImplausible || a.kind == AlarmKind::kDisagree;
      })) {
    return;
  }
  for (const PartialAnswer& answer : agreement.alone) {
    result.posterior->alone.push_back({.name = answer.experiments.front(),
                                       .values = answer.values,
                                       .low = answer.low,
                                       .high = answer.high});
  }
}

// What the answer, made without it, predicts of the experiment that is held out.
void AddHeldOut(const Planner& planner, const CampaignEvidence& evidence, Answer& result) {
  if (!evidence.spec.hold_out) return;
  if (!result.posterior) {
    result.held_out = ResultHeldOut{.name = *evidence.spec.hold_out};
    return;
  }
  std::erase_if(result.posterior->experiments,
                [&](const ResultStanding& e) { return e.name == *evidence.spec.hold_out; });
  result.held_out = HoldOut(ViewOf(planner, evidence), *evidence.spec.hold_out).predicted;
}

}  // namespace

std::optional<Answer> Conclude(Planner& planner, const CampaignEvidence& evidence) {
  const auto answer = planner.Recommend();
  if (!answer) return std::nullopt;
  Answer result;
  result.name = evidence.spec.name;
  result.talus_version = base::Version();
  result.stop = planner.stop().value_or(Stop{});
  const journal::ObjectiveInfo& objective = journal::InfoOf(evidence.spec.objective);
  result.objective = objective.ValueKey();
  result.objective_unit = objective.unit;
  AddParameters(*answer, planner, evidence.spec, result);
  if (const auto lacks = planner.Shortfall()) result.unsettled = UnsettledBy(*lacks, result);
  for (Eigen::Index i = 0; i < answer->correlation.rows(); ++i) {
    const Eigen::RowVectorXd row = answer->correlation.row(i);
    result.correlation.emplace_back(row.data(), row.data() + row.size());
  }
  result.model = answer->model;
  if (answer->posterior) {
    result.posterior = DescribePosterior(*answer->posterior, planner.space());
  }
  AddHeldOut(planner, evidence, result);
  AddExperiments(*answer, planner, evidence, result);
  AddConfirmation(*answer, planner, evidence, result);
  if (answer->posterior) {
    result.representative =
        Representatives({.answer = *answer,
                         .planner = planner,
                         .result = result,
                         .finest = evidence.spec.coarse_graining.Levels().back()});
  }
  AddAgreement(planner, evidence, result);
  result.conditions = ConditionsOf(evidence.spec, answer->point);
  result.cost = CostOf(planner, evidence);
  result.reused = ReusedBy(planner.trials(), CoresOfTrial(evidence.spec));
  const auto kind = VerdictKindOf(result);
  if (kind) result.verdict = {.kind = *kind, .text = {}};
  AddAlarms({.spec = evidence.spec,
             .campaign = evidence.campaign,
             .references = evidence.references,
             .trials = planner.trials(),
             .goal = planner.goal()},
            result);
  if (kind) result.verdict->text = HeadlineText(result);
  return result;
}

}  // namespace talus::campaign
