// A parameter that is searched from now on, in a campaign that has begun: the trials so far stay,
// at the value that they were made with.
#pragma once

#include <string>

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/spec/campaign_spec.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {

// "restitution=0.3..0.95"; the values may have units.
struct AddedParameter {
  std::string name;
  double low = 0;
  double high = 0;
};
// Throws ConfigError that says how it is written.
AddedParameter ParseAddedParameter(const std::string& text);

// The spec with the parameter as a nuisance, and `added_at` what the trials have. Throws
// ConfigError where it is searched already, where the trials differ in it, as those of a wall do
// that follows the searched powder, or where their value lies outside its range.
CampaignSpec SpecWith(const CampaignSpec& spec, const AddedParameter& added);

// What --search has added to the spec that the campaign goes on with, put into the user's file as
// it is now read.
void KeepAddedParameters(const CampaignSpec& going, CampaignSpec& read);

// The trials of a campaign with `spec` gain the coordinates that SpecWith has given it; its result
// is dropped. `spec_text`: as the user wrote it.
void WriteAddedParameters(const CampaignFolder& folder, const CampaignSpec& spec,
                          const std::string& spec_text, journal::Journal& journal);

}  // namespace talus::campaign
