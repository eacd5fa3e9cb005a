// The folder of a campaign: where its files are, and who may write them.
#pragma once

#include <cstdint>
#include <filesystem>

#include "base/files/descriptor.h"

namespace talus::campaign {

struct CampaignFolder {
  std::filesystem::path root;

  std::filesystem::path trial(std::int64_t id) const;  // trials/0001
  std::filesystem::path log() const { return root / "campaign.log"; }
  std::filesystem::path result() const { return root / "result.json"; }
  std::filesystem::path posterior() const { return root / "posterior.csv"; }
  std::filesystem::path campaign() const { return root / "campaign.json"; }
  std::filesystem::path progress() const { return root / "progress.json"; }  // repair.h
  // There from when a deck is mended (mended_engine.h) until nothing runs with the former one.
  std::filesystem::path mended() const { return root / "mended"; }
  // The folder of an experiment's images, from 0: the root itself for the first.
  std::filesystem::path experiment(std::size_t index) const;
};

// Held while a process works on the campaign; it goes with the process, however that ends.
class CampaignLock {
 public:
  // Throws base::Error that names the process that has it.
  explicit CampaignLock(const std::filesystem::path& root);

 private:
  base::Descriptor file_;
};

// Whether some process holds the lock now.
bool IsWorkedOn(const std::filesystem::path& root);

// Throws base::Error, with the system's reason, when nothing can be written there: a full disk, a
// folder that has become read-only. So that such a thing is not taken for a trial's own failure.
void RequireWritable(const std::filesystem::path& root);

}  // namespace talus::campaign
