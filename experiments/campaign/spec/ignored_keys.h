// Keys of which one would be ignored beside another. Only a user's file is asked: a spec that the
// program keeps has its defaults and what follows from the rest written out.
#pragma once

#include "base/json/json_file.h"
#include "base/problems.h"
#include "experiments/campaign/spec/campaign_spec.h"

namespace talus::campaign {

// `file` is what `spec` was read from, before what the photographs say is filled in.
void RefuseIgnoredKeys(const base::JsonFile& file, const CampaignSpec& spec,
                       base::Problems& problems);

}  // namespace talus::campaign
