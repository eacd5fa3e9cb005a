// A campaign as it is before its first trial: what cases and costs follow from the spec alone.
#pragma once

#include <filesystem>

#include "experiments/campaign/answer/joint_view.h"

namespace talus::analysis {

campaign::JointView PlannedView(const campaign::CampaignSpec& spec,
                                const std::filesystem::path& folder);

}  // namespace talus::analysis
