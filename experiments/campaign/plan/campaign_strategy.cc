#include "experiments/campaign/plan/campaign_strategy.h"

#include <utility>

#include "base/not_known.h"
#include "experiments/campaign/plan/usual_cost.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/rigs/observables/observable.h"
#include "imaging/formats/images/image_file.h"
#include "optimizer/strategy/make_strategy.h"

namespace talus::campaign {

std::vector<optimizer::ExperimentTarget> TargetsOf(const CampaignSpec& spec,
                                                   const journal::CampaignRecord& record,
                                                   const std::vector<Reference>& references) {
  std::vector<optimizer::ExperimentTarget> targets;
  const std::vector<ExperimentSpec> specs = ExperimentsOf(spec);
  for (std::size_t e = 0; e < references.size(); ++e) {
    const journal::ExperimentRecord& experiment = record.experiments[e];
    optimizer::ExperimentTarget target{.name = experiment.name,
                                       .image = references[e].MakeFieldObjective()};
    for (const journal::RunRecord& run : experiment.runs) {
      target.runs.push_back(
          references[e].Field(imaging::DecodeGrayImage(run.png, "the journal's run " + run.name)));
    }
    for (const journal::ScalarRecord& scalar : experiment.scalars) {
      const auto [low, high] = rigs::BoundsOf(scalar.name);
      target.scalars.push_back({.name = scalar.name,
                                .value = scalar.value,
                                .standard_error = scalar.NormalError(),
                                .low = low,
                                .high = high});
    }
    for (const double factor : spec.coarse_graining.Levels()) {
      target.costs.push_back(GrainStepsOf(spec, static_cast<int>(e), factor) / kUsualSpeed);
    }
    target.weight = specs.at(e).weight;
    targets.push_back(std::move(target));
  }
  return targets;
}

std::unique_ptr<optimizer::PosteriorStrategy> MakePosteriorStrategyFor(
    const CampaignSpec& spec, std::vector<optimizer::ExperimentTarget> targets) {
  const optimizer::PosteriorStrategyOptions options{
      .scale_factors = spec.coarse_graining.Levels(),
      .target = spec.coarse_graining.Target(),
      .num_initial = spec.strategy.num_initial,
      .model_error = spec.posterior.model_error,
      .learn_model_error = spec.posterior.learn_model_error,
      .stop_share = spec.posterior.stop_share,
      .simulations = spec.budget.simulations,
      .core_time = spec.budget.core_time.value_or(0),
      .seed = spec.seed};
  return std::make_unique<optimizer::PosteriorStrategy>(options, SpaceOf(spec).MakeDomain(),
                                                        std::move(targets));
}

std::unique_ptr<optimizer::PosteriorStrategy> MakePosteriorStrategy(
    const CampaignSpec& spec, const journal::CampaignRecord& record,
    const std::vector<Reference>& references) {
  std::vector<optimizer::ExperimentTarget> targets = TargetsOf(spec, record, references);
  for (optimizer::ExperimentTarget& target : targets) {
    if (spec.hold_out && target.name == *spec.hold_out) target.weight = 0;
  }
  return MakePosteriorStrategyFor(spec, std::move(targets));
}

std::unique_ptr<optimizer::Strategy> MakeProposer(const CampaignSpec& spec,
                                                  const std::vector<Reference>& references) {
  if (!spec.HasOwnProposer()) return nullptr;
  // A proposer of its own knows one experiment only.
  const optimizer::FieldObjective field = references.at(0).MakeFieldObjective();
  return optimizer::MakeStrategy(spec.strategy, SpaceOf(spec).MakeDomain(), &field, spec.seed);
}

optimizer::Observation ObservationOf(const journal::TrialRecord& trial, const Reference& reference,
                                     std::vector<float> field) {
  const std::optional<double> value = reference.Value(trial);
  optimizer::Observation observation{
      .point = PointOf(trial),
      .experiment = trial.experiment,
      .scale_factor = trial.scale_factor,
      // Not the processor time, which differs from run to run and would take proposals with it.
      .cost = CostAtUsualSpeed(trial),
      .is_paid_for = trial.IsPaidFor(),
      .failed = trial.status != journal::TrialStatus::kOk || !reference.IsMeasured(trial),
      .value = value.value_or(reference.has_image() ? kWorstAngle : 0),
      .field = std::move(field)};
  for (const journal::ScalarRecord& scalar : reference.scalars()) {
    observation.scalars.push_back(trial.Metric(scalar.name).value_or(base::kNotKnown));
  }
  return observation;
}

}  // namespace talus::campaign
