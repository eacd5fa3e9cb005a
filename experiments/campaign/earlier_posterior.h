// Posteriors of other campaigns as priors of this one ("from": "DIR").
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/json/json_file.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/records.h"

namespace talus::campaign {

// ReadCampaignSpec, and copies into the spec's priors the draws that they are to be made of, so
// that nothing depends on the other folders later. `begun`, where not null, is the spec that the
// campaign began with: what it has of a folder stays.
//
// Throws ConfigError, too, where a folder is no finished campaign, where its powder is another one
// (sizes, density of the grains or contact laws differ), or where its parameters are.
CampaignSpec ReadSpecWithPosteriors(const base::JsonFile& file,
                                    const CampaignSpec* begun = nullptr);

// The campaigns whose posteriors its priors are.
std::set<std::filesystem::path> PriorFolders(const CampaignSpec& spec);

// What is to be said of the campaigns that priors are from: one of the same measurements, which
// then count twice, and one in which no set fits.
std::vector<std::string> EarlierWarnings(const CampaignSpec& spec,
                                         const journal::CampaignRecord& record);

// The copying alone, into a spec that is in order; what is wrong goes to `problems`.
void TakePosteriors(CampaignSpec& spec, const CampaignSpec* begun, base::Problems& problems);

}  // namespace talus::campaign
