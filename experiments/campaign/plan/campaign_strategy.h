// The strategy that chooses a campaign's trials, and what it is told of them.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiments/campaign/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"
#include "optimizer/fidelity/fidelity_strategy.h"
#include "optimizer/strategies/strategy.h"

namespace talus::campaign {

// What the optimiser is to meet, one an experiment.
std::vector<optimizer::ExperimentTarget> TargetsOf(const CampaignSpec& spec,
                                                   const journal::CampaignRecord& record,
                                                   const std::vector<Reference>& references);

// The spec's own, or the one over all scale factors and experiments where there are several.
std::unique_ptr<optimizer::Strategy> MakeCampaignStrategy(const CampaignSpec& spec,
                                                          const journal::CampaignRecord& record,
                                                          const std::vector<Reference>& references);

// The one over all scale factors and experiments, also where there is one of each only.
std::unique_ptr<optimizer::FidelityStrategy> MakeJointStrategy(
    const CampaignSpec& spec, const journal::CampaignRecord& record,
    const std::vector<Reference>& references);

// One over other targets at the campaign's scale factors: some of its experiments, or a test that
// has not been made.
std::unique_ptr<optimizer::FidelityStrategy> MakeJointStrategyFor(
    const CampaignSpec& spec, std::vector<optimizer::ExperimentTarget> targets);

// Whether a strategy is told of it: all but the confirming ones are.
inline bool IsOfSearch(const journal::TrialRecord& trial) {
  return trial.kind != journal::TrialKind::kConfirm;
}

// Those that have finished, in the order in which a strategy was told of them.
std::vector<journal::TrialRecord> InOrderOfFinish(std::vector<journal::TrialRecord> trials);

// The unit cube's point of a trial.
Eigen::VectorXd PointOf(const journal::TrialRecord& trial);

// A finished trial as a strategy is told it; the field is empty when it failed or its image is
// lost.
optimizer::Observation ObservationOf(const journal::TrialRecord& trial, const Reference& reference,
                                     std::vector<float> field);

}  // namespace talus::campaign
