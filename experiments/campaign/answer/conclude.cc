#include "experiments/campaign/answer/conclude.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "base/version.h"
#include "experiments/campaign/alarms.h"
#include "experiments/campaign/answer/agreement.h"
#include "experiments/campaign/answer/best_confirmed.h"
#include "experiments/campaign/answer/describe_posterior.h"
#include "experiments/campaign/answer/hold_out.h"
#include "experiments/campaign/plan/cores.h"
#include "imaging/spheres/projection.h"

namespace talus::campaign {
namespace {

constexpr std::size_t kMostTied = 200;  // listed; the tied volume counts them all

struct Sample {
  int count = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  double sd = std::numeric_limits<double>::quiet_NaN();  // of one, unbiased
};

Sample SampleOf(const std::vector<double>& values) {
  Sample sample{.count = static_cast<int>(values.size())};
  if (values.empty()) return sample;
  double sum = 0;
  for (const double v : values) sum += v;
  sample.mean = sum / sample.count;
  if (sample.count < 2) return sample;
  double squares = 0;
  for (const double v : values) squares += (v - sample.mean) * (v - sample.mean);
  sample.sd = std::sqrt(squares / (sample.count - 1));
  return sample;
}

std::vector<const journal::TrialRecord*> Confirming(const Planner& planner,
                                                    const Eigen::VectorXd& candidate,
                                                    int experiment) {
  const std::int64_t set = planner.ConfirmSet(candidate);
  std::vector<const journal::TrialRecord*> trials;
  for (const journal::TrialRecord& trial : planner.trials()) {
    if (trial.kind == journal::TrialKind::kConfirm && trial.set == set &&
        trial.experiment == experiment) {
      trials.push_back(&trial);
    }
  }
  return trials;
}

// The mean of a metric over the trials that have it; nothing where none has.
std::optional<double> MeanMetric(const std::vector<const journal::TrialRecord*>& trials,
                                 std::string_view name) {
  std::vector<double> values;
  for (const journal::TrialRecord* trial : trials) {
    if (const auto value = trial->Metric(name)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return SampleOf(values).mean;
}

ResultConfirmed ConfirmedOf(const std::vector<const journal::TrialRecord*>& trials,
                            const CampaignEvidence& of, std::size_t experiment) {
  const Reference& reference = of.references[experiment];
  const journal::ExperimentRecord& record = of.campaign.experiments[experiment];
  ResultConfirmed confirmed{.name = record.name};
  std::vector<double> objective;
  std::vector<imaging::GrayImage> profiles;
  for (const journal::TrialRecord* trial : trials) {
    if (const auto value = reference.Value(*trial)) objective.push_back(*value);
    if (trial->status != journal::TrialStatus::kOk) continue;
    if (auto profile = of.profile(trial->id)) profiles.push_back(std::move(*profile));
  }
  const Sample sample = SampleOf(objective);
  confirmed.num_trials = static_cast<int>(std::count_if(
      trials.begin(), trials.end(),
      [&](const journal::TrialRecord* trial) { return reference.IsMeasured(*trial); }));
  confirmed.mean = sample.mean;
  confirmed.standard_error = sample.sd / std::sqrt(sample.count);
  confirmed.sad_mm2 = MeanMetric(trials, journal::InfoOf(journal::Objective::kSad).metric);
  if (!profiles.empty()) {
    journal::TrialRecord mean;
    mean.metrics = reference.Measure(imaging::MeanImage(profiles));
    confirmed.profile_sad_mm2 = mean.Metric(journal::InfoOf(journal::Objective::kSad).metric);
  }
  if (confirmed.profile_sad_mm2 && record.noise_mm2) {
    confirmed.over_floor = *confirmed.profile_sad_mm2 / *record.noise_mm2;
  }
  for (const journal::ScalarRecord& scalar : record.scalars) {
    confirmed.scalars.push_back({.name = scalar.name,
                                 .mean = MeanMetric(trials, scalar.name).value_or(kNotKnown),
                                 .measured = scalar.value,
                                 .measured_sd = scalar.standard_error});
  }
  return confirmed;
}

ResultCandidate CandidateOf(const Planner& planner, const CampaignEvidence& of,
                            const Eigen::VectorXd& point) {
  ResultCandidate candidate{.values = FreeValues(planner.space(), point)};
  std::vector<ResultConfirmed> all;
  for (std::size_t e = 0; e < of.references.size(); ++e) {
    const auto trials = Confirming(planner, point, static_cast<int>(e));
    for (const journal::TrialRecord* trial : trials) candidate.scale_factor = trial->scale_factor;
    all.push_back(ConfirmedOf(trials, of, e));
  }
  const ResultConfirmed& first = all.front();
  candidate.num_trials = first.num_trials;
  candidate.mean = first.mean;
  candidate.standard_error = first.standard_error;
  candidate.sad_mm2 = first.sad_mm2;
  candidate.profile_sad_mm2 = first.profile_sad_mm2;
  if (all.size() > 1 || !first.scalars.empty()) candidate.experiments = std::move(all);
  return candidate;
}

void AddParameters(const optimizer::Answer& answer, const Planner& planner,
                   CampaignResult& result) {
  const auto& space = planner.space();
  const std::vector<int> free = space.Free();
  const std::vector<double> values = FreeValues(space, answer.point);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(free[i])];
    ResultParameter parameter{.name = p.name, .unit = UnitOf(p.name), .value = values[i]};
    if (i < answer.credible.size()) {
      parameter.credible_low = p.ToNative(answer.credible[i].low);
      parameter.credible_high = p.ToNative(answer.credible[i].high);
    }
    if (i < answer.sobol_first.size()) parameter.sobol_first = answer.sobol_first[i];
    if (i < answer.sobol_total.size()) parameter.sobol_total = answer.sobol_total[i];
    result.parameters.push_back(parameter);
  }
}

void AddConfirmation(const optimizer::Answer& answer, const Planner& planner,
                     const CampaignEvidence& of, CampaignResult& result) {
  for (const Eigen::VectorXd& point : planner.Candidates(answer)) {
    const ResultCandidate candidate = CandidateOf(planner, of, point);
    if (candidate.num_trials > 0) result.confirmed.push_back(candidate);
  }
  if (result.confirmed.empty()) return;
  // Where several experiments are to be met, none of them alone decides.
  if (of.references.size() == 1) TakeBestConfirmed(result);
  if (result.noise_floor && result.confirmed[0].profile_sad_mm2) {
    result.confirmed_over_floor = *result.confirmed[0].profile_sad_mm2 / *result.noise_floor;
  }
}

// Of the joint 90 % region: a set outside it does not fit equally.
Eigen::MatrixXd InRegion(const Eigen::MatrixXd& draws, const Planner& planner) {
  const auto levels = planner.CredibleLevels(draws);
  if (!levels) return draws;
  std::vector<Eigen::Index> inside;
  for (Eigen::Index i = 0; i < draws.rows(); ++i) {
    if ((*levels)[i] <= 0.9) inside.push_back(i);
  }
  return draws(inside, Eigen::all);
}

// What the sentence and the sets to look at stand on: the posterior's draws, or the sets that tie.
void AddVerdict(const optimizer::Answer& answer, const Planner& planner, CampaignResult& result) {
  Eigen::MatrixXd points(static_cast<Eigen::Index>(answer.tied.size()), answer.point.size());
  for (std::size_t i = 0; i < answer.tied.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = answer.tied[i];
  }
  if (answer.posterior) points = InRegion(answer.posterior->draws, planner);
  for (const Eigen::VectorXd& set : RepresentativeSets(points, answer.point)) {
    result.representative.push_back(FreeValues(planner.space(), set));
  }
  VerdictBasis basis{.correlation = result.correlation,
                     .sets = result.representative,
                     .region_volume = result.tied_volume};
  for (const int i : planner.space().Free()) {
    basis.parameters.push_back(planner.space().parameters[static_cast<std::size_t>(i)]);
    basis.names.push_back(basis.parameters.back().name);
  }
  for (const ResultParameter& parameter : result.parameters) {
    basis.low.push_back(parameter.credible_low);
    basis.high.push_back(parameter.credible_high);
  }
  if (result.posterior) basis.branches = result.posterior->branches;
  result.verdict = VerdictOf(basis);
}

ResultConditions ConditionsOf(const CampaignSpec& spec) {
  return {.scale_factor = spec.coarse_graining.Target(),
          .surface_energy_exponent = spec.coarse_graining.surface_energy_exponent,
          .youngs_modulus = spec.powder.material.youngs_modulus,
          .lift_velocity = spec.device.lift_velocity,
          .adhesion = std::string(base::NameOf(spec.models.adhesion)),
          .rolling = std::string(base::NameOf(spec.models.rolling))};
}

ResultCost CostOf(const Planner& planner, const CampaignEvidence& of) {
  ResultCost cost{.elapsed = of.elapsed};
  for (const journal::TrialRecord& trial : planner.trials()) {
    if (trial.status == journal::TrialStatus::kRunning) continue;
    ++cost.num_trials;
    if (trial.status == journal::TrialStatus::kFailed) ++cost.num_failed;
    const double seconds = trial.cpu_s > 0 ? trial.cpu_s : trial.duration_s * CoresOfTrial(of.spec);
    if (std::isfinite(seconds)) cost.core_hours += seconds / 3600;
  }
  return cost;
}

JointView ViewOf(const Planner& planner, const CampaignEvidence& of) {
  JointView view{.folder = {},
                 .spec = of.spec,
                 .record = of.campaign,
                 .references = of.references,
                 .space = planner.space(),
                 .trials = planner.trials()};
  view.Observe([&](const journal::TrialRecord& trial) {
    const auto profile = of.profile(trial.id);
    const Reference& reference = of.references[static_cast<std::size_t>(trial.experiment)];
    return profile ? reference.Field(*profile) : std::vector<float>{};
  });
  return view;
}

// Whether the experiments agree and, where they do not, what each alone would say: it tells which
// of them is the odd one.
void AddAgreement(const Planner& planner, const CampaignEvidence& of, CampaignResult& result) {
  if (of.references.size() < 2 || !result.posterior) return;
  const Agreement agreement = AgreementOf(ViewOf(planner, of));
  result.posterior->tension = agreement.tension;
  if (Disagree(agreement.tension, result.posterior->raw_coverage)) {
    result.warnings.push_back(Worded(
        {.kind = WarningKind::kDisagree, .experiment = agreement.odd, .value = agreement.tension}));
  }
  if (std::ranges::none_of(result.warnings, [](const ResultWarning& w) {
        return w.kind == WarningKind::kImplausible || w.kind == WarningKind::kDisagree;
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
void AddHeldOut(const Planner& planner, const CampaignEvidence& of, CampaignResult& result) {
  if (!of.spec.hold_out || !result.posterior) return;
  std::erase_if(result.posterior->experiments,
                [&](const ResultStanding& e) { return e.name == *of.spec.hold_out; });
  result.held_out = HoldOut(ViewOf(planner, of), *of.spec.hold_out).predicted;
}

}  // namespace

std::optional<CampaignResult> Conclude(Planner& planner, const CampaignEvidence& of) {
  const auto answer = planner.Recommend();
  if (!answer) return std::nullopt;
  CampaignResult result;
  result.name = of.spec.name;
  result.talus_version = base::Version();
  result.stop_reason = planner.stop_reason();
  if (const auto lacks = planner.Shortfall()) {
    result.unsettled = {.why = lacks->text, .share = lacks->share, .num_more = lacks->num_more};
  }
  result.objective = of.references.front().info().ValueKey();
  result.objective_unit = of.references.front().info().unit;
  AddParameters(*answer, planner, result);
  if (std::any_of(of.references.begin(), of.references.end(),
                  [](const Reference& r) { return r.has_image(); })) {
    result.predicted = answer->predicted_value;
    result.predicted_sd = answer->predicted_sd;
    result.noise_sd = answer->noise_sd;
  }
  result.noise_floor = of.campaign.experiments.front().noise_mm2;
  result.tied_volume = answer->tied_volume;
  for (std::size_t i = 0; i < std::min(answer->tied.size(), kMostTied); ++i) {
    result.tied.push_back(FreeValues(planner.space(), answer->tied[i]));
  }
  for (Eigen::Index i = 0; i < answer->correlation.rows(); ++i) {
    const Eigen::RowVectorXd row = answer->correlation.row(i);
    result.correlation.emplace_back(row.data(), row.data() + row.size());
  }
  result.model = answer->model;
  if (answer->posterior) {
    result.posterior = DescribePosterior(*answer->posterior, planner.space());
  }
  AddHeldOut(planner, of, result);
  AddVerdict(*answer, planner, result);
  std::vector<double> noise;
  for (const journal::TrialRecord& trial : planner.trials()) {
    if (trial.kind != journal::TrialKind::kNoise) continue;
    if (const auto value = of.references.front().Value(trial)) noise.push_back(*value);
  }
  if (noise.size() >= 2) result.replicates_sd = SampleOf(noise).sd;
  AddConfirmation(*answer, planner, of, result);
  result.conditions = ConditionsOf(of.spec);
  AddAlarms({.answer = *answer,
             .space = planner.space(),
             .spec = of.spec,
             .campaign = of.campaign,
             .reference = of.references.front(),
             .trials = planner.trials()},
            result);
  AddAgreement(planner, of, result);
  result.cost = CostOf(planner, of);
  return result;
}

}  // namespace talus::campaign
