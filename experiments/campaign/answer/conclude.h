// From the finished trials to the result.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/plan/planner.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

struct CampaignEvidence {
  const CampaignSpec& spec;
  const journal::CampaignRecord& campaign;
  const std::vector<Reference>& references;  // of the experiments
  // A trial's ANHP.
  std::function<std::optional<imaging::GrayImage>(std::int64_t)> profile;
  double elapsed = 0;  // [s]
};

// Nothing when no trial has succeeded, or none of one of the experiments.
std::optional<Answer> Conclude(Planner& planner, const CampaignEvidence& evidence);

}  // namespace talus::campaign
