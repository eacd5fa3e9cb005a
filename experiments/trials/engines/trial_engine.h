// What simulates a trial: our own engine, or anybody's. To a campaign a trial is a folder and a
// command that fills it; an engine says what is put in and reads what comes out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/journal/records.h"
#include "experiments/rigs/case/case.h"
#include "imaging/gray_image.h"

namespace talus::trials {

// In a campaign's folder: locked while a process works on the campaign.
inline constexpr const char* kCampaignLock = "campaign.lock";

struct TrialOutput {
  imaging::GrayImage profile;  // ANHP in the case's frame; empty without one
  std::int64_t num_steps = 0;  // 0 when not known
  std::int64_t num_particles = 0;
  std::vector<journal::MetricRecord> scalars{};  // what was measured beside the image
  double cpu_time = 0;                           // [s], 0 when not known
  std::string note;     // how it ended, such as a phase that met its time cap; may be empty
  std::string doubt{};  // of the set-up, and so of every trial: "heap.dump has grains of …"
};

class TrialEngine {
 public:
  virtual ~TrialEngine() = default;

  // Makes the folder ready for the command. A folder that was made ready for the same case keeps
  // what is in it, a finished result or a checkpoint; any other is cleared first.
  virtual void Prepare(const rigs::Case& rig_case, const std::filesystem::path& folder) = 0;

  // Whether the folder has been made ready for this very case, and not been cleared since.
  virtual bool IsPrepared(const rigs::Case& rig_case, const std::filesystem::path& folder) = 0;

  // To be run in the folder.
  virtual std::vector<std::string> Command(const std::filesystem::path& folder) = 0;

  // Whether the command has ended well here, in this or an earlier process: it need not run again.
  virtual bool IsComplete(const std::filesystem::path& folder) = 0;

  // From now on what an outside command has left there does not count: it need run again. What our
  // own engine leaves follows from its case, and stays.
  virtual void Forget(const std::filesystem::path&) {}

  // What a complete folder holds. Throws base::Error with the reason when it is no good: the trial
  // has failed then, and the folder need no longer be complete.
  virtual TrialOutput Collect(const rigs::Case& rig_case, const std::filesystem::path& folder) = 0;

  // Why what is in the complete folder `from` cannot be this case's, drawn in its frame:
  // "powder.mass is 0.001 there and 0.002 here"; nothing where it can.
  virtual std::optional<std::string> WhyNotTaken(const rigs::Case& rig_case,
                                                 const std::filesystem::path& from) = 0;

  // Makes `to` the complete folder of the case from `from`, drawn in the case's frame. False, and
  // `to` is left alone, where WhyNotTaken says why not.
  virtual bool TakeOver(const rigs::Case& rig_case, const std::filesystem::path& from,
                        const std::filesystem::path& to) = 0;
};

// The folder with nothing in it but `key_file` = `text`; untouched when that is so already, other
// files or not.
void PrepareFolder(const std::filesystem::path& folder, const std::string& key_file,
                   const std::string& text);

// Whether that is so.
bool HoldsKey(const std::filesystem::path& folder, const std::string& key_file,
              const std::string& text);

// `to` with what `from` holds and nothing else; throws base::Error when it cannot be.
void CopyFolder(const std::filesystem::path& from, const std::filesystem::path& to);

// Why a command has failed, from the end of its log.txt; "" when that says nothing.
std::string LastLogLines(const std::filesystem::path& folder);

// Whether that end says that a file could not be written: in this program's words, or that the disk
// was full or over a quota in the C library's.
bool LogSaysUnwritten(const std::filesystem::path& folder);

}  // namespace talus::trials
