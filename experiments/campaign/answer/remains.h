// The signed maps of what remains at the recommended set, where no set fits the thing to look at:
// which part of a heap the contact law or the set-up gets wrong.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/campaign/answer/conclude.h"
#include "experiments/campaign/answer/result_remains.h"

namespace talus::campaign {

// Writes remains/1_NAME.png and so on into the folder, for each experiment's image, and each
// picture of a film. Simulated is the mean profile of the trials that confirm the set, or the
// model's mean image where none does; there is none without a model either.
std::vector<ResultRemains> WriteRemains(const std::filesystem::path& folder, Planner& planner,
                                        const CampaignEvidence& evidence);

}  // namespace talus::campaign
