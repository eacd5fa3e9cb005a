// What the folder keeps beside the journal, so that a journal that is damaged (a truncated file, a
// failing disk) can be made anew: the campaign's record, and each trial's own in its folder.
#pragma once

#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/journal/journal.h"

namespace talus::campaign {

// campaign.json, and of each experiment aehp.png, aehp_sd.png and its runs as run_01.png …
void KeepCampaign(const CampaignFolder& folder, const journal::CampaignRecord& record);

// trials/0001/trial.json: why there is such a trial.
void KeepTrial(const CampaignFolder& folder, const journal::TrialRecord& trial);

// What the trials do not tell of how far a search has come.
struct KeptProgress {
  double elapsed_s = 0;     // as ProgressRecord's
  int num_of_search = 0;    // trials that it had started then
  std::string stop_json{};  // why it has ended; "" while it goes on

  TALUS_FIELDS(elapsed_s, num_of_search, stop_json);
};

// progress.json.
void KeepProgress(const CampaignFolder& folder, const KeptProgress& progress);

// Puts the damaged journal aside and makes a new one in which every trial that was ever started is
// running: those that have ended are then collected from their folders, the others run again.
// Throws base::Error when the folder does not hold enough for it.
journal::Journal RebuildJournal(const CampaignFolder& folder);

}  // namespace talus::campaign
