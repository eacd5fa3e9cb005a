// The campaign's state: one SQLite file that a `kill -9` at any moment leaves whole, and that
// `sqlite3` reads while the campaign runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/journal/database.h"
#include "experiments/journal/records.h"

namespace talus::journal {

// DIR/journal.sqlite
std::filesystem::path JournalPath(const std::filesystem::path& campaign);

// Now, as "2026-01-31T12:00:00Z": for people to read; nothing is computed from it.
std::string UtcNow();

class Journal {
 public:
  // A new one, written with the campaign in it and these trials as running; throws ConfigError when
  // there is one already.
  static Journal Create(const std::filesystem::path& path, const CampaignRecord& campaign,
                        std::span<const TrialRecord> trials = {});

  // To go on. Throws base::Error when the file is damaged, and base::ConfigError when its schema is
  // another.
  static Journal Open(const std::filesystem::path& path);

  // To look at while another process may be writing.
  static Journal OpenReadOnly(const std::filesystem::path& path);

  CampaignRecord Campaign();
  ProgressRecord Progress();
  void SetProgress(const ProgressRecord& progress);
  // A search that has ended is one that was interrupted, and goes on when the campaign does.
  void ReopenSearch();
  // The spec after an allowed change: its path and its texts; with ReopenSearch if asked for.
  void SetSpec(const CampaignRecord& campaign, bool reopens = false);
  // Other parameters than it began with, and for each of `trials`, which are all of them, its
  // point; together with the spec's texts and ReopenSearch. There is no result any more.
  void SetParameters(const CampaignRecord& campaign, std::span<const TrialRecord> trials);
  // A further one, after the others, together with the spec that has it, with the trials that it
  // takes over, as running, and with ReopenSearch.
  void AddExperiment(const ExperimentRecord& experiment, std::string_view spec_json,
                     std::span<const TrialRecord> trials);

  // By id, with their metrics, without their images.
  std::vector<TrialRecord> Trials();

  // Inserts them as running, in one transaction, as each waits for the disk; not even that where a
  // power cut ends the trials too.
  void Start(std::span<const TrialRecord> trials,
             base::Outlives outlives = base::Outlives::kPowerCut);
  // Running trials get another seed, attempt or job name; with what they have taken so far.
  void Restart(std::span<const TrialRecord> trials);
  // Ended trials are as if they had never ended.
  void Reopen(std::span<const TrialRecord> trials);
  // How long a running trial took, that has ended and waits for its turn to be told.
  void NoteEnd(const TrialRecord& trial);
  // Status, reason, metrics, timing and image in one transaction. Sets finish_order.
  void Finish(TrialRecord& trial, std::string_view profile_png);

  // The trial's ANHP, bytes of a PNG; empty when it has none or its checksum does not match.
  std::string ProfilePng(std::int64_t trial);

  // For people who look into the journal: "retry", "reuse", "spec", "stop"; 0 for the campaign
  // itself.
  void AddEvent(std::string_view kind, std::int64_t trial, std::string_view text);

 private:
  explicit Journal(Database database) : database_(std::move(database)) {}
  void SetOpen();  // ReopenSearch, in a transaction of the caller's
  void CreateView(const CampaignRecord& campaign);
  void InsertCampaign(const CampaignRecord& campaign);
  void InsertParameters(const CampaignRecord& campaign);
  void InsertPoint(const TrialRecord& trial);
  void Insert(const TrialRecord& trial);
  void ReadPoints(std::vector<TrialRecord>& trials);
  void ReadMetrics(std::vector<TrialRecord>& trials);

  Database database_;
  std::optional<std::int64_t> last_finish_order_;  // once it is known
};

}  // namespace talus::journal
