// The strategies that choose a campaign's trials and make its answer, and what they are told.
#pragma once

#include <memory>
#include <vector>

#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "optimizer/strategy/posterior_strategy.h"
#include "optimizer/strategy/strategy.h"

namespace talus::campaign {

// What the optimiser is to meet, one an experiment.
std::vector<optimizer::ExperimentTarget> TargetsOf(const CampaignSpec& spec,
                                                   const journal::CampaignRecord& record,
                                                   const std::vector<Reference>& references);

// The calibration's own strategy: told every trial of the search, it makes the answer, and chooses
// the trials unless the spec names another strategy for that.
std::unique_ptr<optimizer::PosteriorStrategy> MakePosteriorStrategy(
    const CampaignSpec& spec, const journal::CampaignRecord& record,
    const std::vector<Reference>& references);

// The same for other targets at the campaign's scale factors: some of its experiments, or a test
// that has not been made.
std::unique_ptr<optimizer::PosteriorStrategy> MakePosteriorStrategyFor(
    const CampaignSpec& spec, std::vector<optimizer::ExperimentTarget> targets);

// The strategy that chooses the trials in its place; null where the spec names none.
std::unique_ptr<optimizer::Strategy> MakeProposer(const CampaignSpec& spec,
                                                  const std::vector<Reference>& references);

// A finished trial as a strategy is told it; the field is empty when it failed or its image is
// lost.
optimizer::Observation ObservationOf(const journal::TrialRecord& trial, const Reference& reference,
                                     std::vector<float> field);

}  // namespace talus::campaign
