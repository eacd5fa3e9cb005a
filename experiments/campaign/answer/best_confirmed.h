// Which of the sets that were simulated again is recommended.
#pragma once

#include "experiments/campaign/answer/campaign_result.h"

namespace talus::campaign {

// The model's choice stands first in result.confirmed, and stays unless fresh seeds say clearly
// that another candidate is better: then that one comes first and is recommended, with a warning.
void TakeBestConfirmed(CampaignResult& result);

}  // namespace talus::campaign
