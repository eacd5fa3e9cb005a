// Campaigns that several tests begin with: each is run once a program, and copied.
#pragma once

#include <algorithm>
#include <filesystem>
#include <list>
#include <string>

#include "tests/experiments/scratch_folder.h"

namespace talus::campaign {

// Key: what tells one such campaign from another.
template <class Key>
class FinishedCampaigns {
 public:
  // Copies the campaign of this key to the folder `to`. Where it is the first that is asked for,
  // `finish` runs it, as "run" in the empty folder that it is given.
  template <class Finish>
  void Copy(const Key& key, const std::filesystem::path& to, const Finish& finish) {
    const auto is_this = [&](const Campaign& campaign) { return campaign.key == key; };
    auto found = std::find_if(campaigns_.begin(), campaigns_.end(), is_this);
    if (found == campaigns_.end()) {
      found = campaigns_.emplace(found, key, "_finished" + std::to_string(campaigns_.size()));
      finish(found->folder.path());
    }
    std::filesystem::copy(found->folder.path() / "run", to,
                          std::filesystem::copy_options::recursive);
  }

 private:
  struct Campaign {
    Campaign(const Key& campaign_key, const std::string& purpose)
        : key(campaign_key), folder(purpose) {}
    Key key;
    ScratchFolder folder;
  };
  std::list<Campaign> campaigns_;
};

}  // namespace talus::campaign
