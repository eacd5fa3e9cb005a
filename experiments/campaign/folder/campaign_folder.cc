#include "experiments/campaign/folder/campaign_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/file_lock.h"
#include "base/text/number_text.h"
#include "experiments/trials/engines/trial_engine.h"

namespace talus::campaign {
namespace {

// A process that is killed while it starts a worker leaves its lock to the worker, until this
// begins to run its own program a moment later.
constexpr std::chrono::milliseconds kPatience{1000};
constexpr std::chrono::milliseconds kPause{20};

}  // namespace

std::filesystem::path CampaignFolder::trial(std::int64_t id) const {
  return root / "trials" / base::FileNumber(id);
}

std::filesystem::path CampaignFolder::experiment(std::size_t index) const {
  return index == 0 ? root : root / ("experiment_" + std::to_string(index + 1));
}

CampaignLock::CampaignLock(const std::filesystem::path& root) {
  const std::string path = (root / trials::kCampaignLock).string();
  file_ = base::Descriptor(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (file_.get() < 0) base::ThrowUnwritten(path, errno);
  const base::LockEnd end = base::LockWithin(file_.get(), kPatience, kPause);
  if (end == base::LockEnd::kNone) throw base::Error(path + base::kNoLocks);
  if (end == base::LockEnd::kHeld) {
    char owner[32] = "";
    if (::read(file_.get(), owner, sizeof owner - 1) <= 0) std::strcpy(owner, "unknown");
    throw base::Error(root.string() + ": another process (number " + owner +
                      ") works on this campaign; end it first, or wait");
  }
  const std::string owner = std::to_string(::getpid());
  if (::ftruncate(file_.get(), 0) != 0 ||
      ::pwrite(file_.get(), owner.data(), owner.size(), 0) != static_cast<ssize_t>(owner.size())) {
    base::ThrowUnwritten(path, errno);
  }
}

bool IsWorkedOn(const std::filesystem::path& root) {
  return base::IsLocked(root / trials::kCampaignLock);
}

void RequireWritable(const std::filesystem::path& root) {
  constexpr std::size_t kEnoughForATrial = 256 * 1024;
  const std::filesystem::path probe = root / ".probe";
  base::WriteFileAtomically(probe, std::string(kEnoughForATrial, '.'));
  std::filesystem::remove(probe);
}

}  // namespace talus::campaign
