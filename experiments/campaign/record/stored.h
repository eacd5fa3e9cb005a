// What the journal keeps of experiments and trials, as a campaign uses it.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/record/reference.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"
#include "optimizer/space/parameter_space.h"

namespace talus::campaign {

// Those that have finished, in the order in which a strategy was told of them.
std::vector<journal::TrialRecord> InOrderOfFinish(std::vector<journal::TrialRecord> trials);

// With its name, range and scale.
optimizer::Parameter SearchedParameter(const journal::ParameterRecord& record);

// The unit cube's point of a trial.
Eigen::VectorXd PointOf(const journal::TrialRecord& trial);

// The case of a trial, with the values that it was given, to the last bit.
rigs::Case CaseOfTrial(const CampaignSpec& spec, const journal::TrialRecord& trial,
                       const std::optional<imaging::Frame>& frame);

// The experiments as the journal keeps them.
std::vector<Reference> ReferencesOf(const journal::CampaignRecord& record,
                                    const CampaignSpec& spec);

// What a strategy is told of a trial's image: empty when it failed, confirms, or its image is lost.
std::vector<float> StoredField(journal::Journal& journal, const CampaignFolder& folder,
                               const std::vector<Reference>& references,
                               const journal::TrialRecord& trial);

// A trial's profile: from the journal, or from its folder if the journal's copy is damaged.
std::optional<imaging::GrayImage> StoredProfile(journal::Journal& journal,
                                                const CampaignFolder& folder, std::int64_t trial);

}  // namespace talus::campaign
