#include "experiments/campaign/folder/repair.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/checked_text.h"
#include "base/files/file.h"
#include "base/json/json_writer.h"
#include "experiments/journal/record_json.h"
#include "experiments/rigs/case/run_files.h"

namespace talus::campaign {
namespace {

constexpr const char* kAehp = "aehp.png";
constexpr const char* kAehpSd = "aehp_sd.png";

std::string RunFile(std::size_t index) {
  return "run_" + std::string(index < 9 ? "0" : "") + std::to_string(index + 1) + ".png";
}

template <class Record>
std::string TextWithChecksum(const Record& record) {
  return base::WithChecksum(base::JsonTextWriter::TextOf(record));
}

template <class Record>
Record ReadRecord(const std::filesystem::path& path) {
  const std::optional<std::string> text = base::CheckedText(base::ReadFile(path), path.string());
  if (!text) throw base::Error(path.string() + ": is damaged: its checksum is not there");
  return journal::ParseRecord<Record>(*text, path.string());
}

std::string IfThere(const std::filesystem::path& path) {
  return std::filesystem::exists(path) ? base::ReadFile(path) : std::string();
}

// Moves the journal with its log out of the way, under a name that is free.
void PutAside(const std::filesystem::path& journal) {
  int number = 1;
  const auto aside = [&](const std::string& suffix) {
    return journal.string() + ".damaged" + std::to_string(number) + suffix;
  };
  while (std::filesystem::exists(aside(""))) ++number;
  for (const char* suffix : {"", "-wal", "-shm"}) {
    const std::string from = journal.string() + suffix;
    if (std::filesystem::exists(from)) std::filesystem::rename(from, aside(suffix));
  }
}

// At the beginning, one that is there without any was left by another that was killed, of another
// spec perhaps; later it is the user's.
void KeepImage(const std::filesystem::path& path, const std::string& png, bool is_beginning) {
  if (!png.empty()) {
    base::WriteFileAtomically(path, png);
  } else if (is_beginning) {
    std::filesystem::remove(path);
  }
}

journal::CampaignRecord KeptCampaign(const CampaignFolder& folder) {
  auto record = ReadRecord<journal::CampaignRecord>(folder.campaign());
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    journal::ExperimentRecord& experiment = record.experiments[e];
    const std::filesystem::path place = folder.experiment(e);
    if (experiment.frame_json.empty()) continue;  // numbers only: a picture there is the user's
    experiment.aehp_png = IfThere(place / kAehp);
    if (experiment.aehp_png.empty()) throw base::Error((place / kAehp).string() + ": is missing");
    experiment.aehp_sd_png = IfThere(place / kAehpSd);
    for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
      experiment.runs[r].png = base::ReadFile(place / RunFile(r));
    }
  }
  return record;
}

// One of another campaign, or of before a parameter was added, does not.
bool IsOfCampaign(const journal::TrialRecord& trial, const journal::CampaignRecord& campaign) {
  const std::size_t num_parameters = campaign.parameters.size();
  return trial.unit.size() == num_parameters && trial.native.size() == num_parameters &&
         trial.experiment >= 0 && trial.experiment < std::ssize(campaign.experiments);
}

std::vector<journal::TrialRecord> KeptTrials(const CampaignFolder& folder,
                                             const journal::CampaignRecord& campaign) {
  std::vector<journal::TrialRecord> trials;
  if (!std::filesystem::exists(folder.root / "trials")) return trials;
  for (const auto& entry : std::filesystem::directory_iterator(folder.root / "trials")) {
    const std::filesystem::path file = entry.path() / rigs::kTrialFile;
    // A folder without one was being made when the process ended: there is no such trial yet. An
    // empty one is all that a power cut has left.
    std::error_code absent;
    const auto size = std::filesystem::file_size(file, absent);
    if (absent || size == 0) continue;
    try {
      auto trial = ReadRecord<journal::TrialRecord>(file);
      if (IsOfCampaign(trial, campaign)) trials.push_back(std::move(trial));
    } catch (const base::Error&) {  // damaged: as if it were not there, it is run again
    }
  }
  std::sort(trials.begin(), trials.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return trials;
}

// Where more trials of the search were started since, it has gone on.
journal::ProgressRecord KeptProgressOf(const CampaignFolder& folder,
                                       const std::vector<journal::TrialRecord>& trials) {
  if (!std::filesystem::exists(folder.progress())) return {};
  try {
    const auto kept = ReadRecord<KeptProgress>(folder.progress());
    const auto num_of_search = std::ranges::count_if(trials, &journal::TrialRecord::IsOfSearch);
    return {.elapsed_s = kept.elapsed_s,
            .stop_json = num_of_search == kept.num_of_search ? kept.stop_json : ""};
  } catch (const base::Error&) {
    return {};  // it only spares work
  }
}

}  // namespace

void KeepCampaign(const CampaignFolder& folder, const journal::CampaignRecord& record) {
  const bool is_beginning = !std::filesystem::exists(folder.campaign());
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    const journal::ExperimentRecord& experiment = record.experiments[e];
    if (experiment.aehp_png.empty() && experiment.runs.empty()) continue;  // numbers only
    const std::filesystem::path place = folder.experiment(e);
    std::filesystem::create_directories(place);
    KeepImage(place / kAehp, experiment.aehp_png, is_beginning);
    KeepImage(place / kAehpSd, experiment.aehp_sd_png, is_beginning);
    for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
      base::WriteFileAtomically(place / RunFile(r), experiment.runs[r].png);
    }
  }
  base::WriteFileAtomically(folder.campaign(), TextWithChecksum(record));
}

void KeepTrial(const CampaignFolder& folder, const journal::TrialRecord& trial) {
  std::filesystem::create_directories(folder.trial(trial.id));
  base::WriteFileAtomically(folder.trial(trial.id) / rigs::kTrialFile, TextWithChecksum(trial),
                            base::Outlives::kProgram);
}

void KeepProgress(const CampaignFolder& folder, const KeptProgress& progress) {
  base::WriteFileAtomically(folder.progress(), TextWithChecksum(progress));
}

journal::Journal RebuildJournal(const CampaignFolder& folder) {
  const journal::CampaignRecord record = KeptCampaign(folder);
  std::vector<journal::TrialRecord> trials = KeptTrials(folder, record);
  // After a gap nothing can be what an unbroken run would have made.
  std::size_t whole = 0;
  while (whole < trials.size() && trials[whole].id == static_cast<std::int64_t>(whole) + 1) ++whole;
  trials.resize(whole);
  PutAside(journal::JournalPath(folder.root));
  journal::Journal journal =
      journal::Journal::Create(journal::JournalPath(folder.root), record, trials);
  journal.SetProgress(KeptProgressOf(folder, trials));
  journal.AddEvent("repair", 0,
                   "the journal was damaged and has been made anew from the trials' folders");
  return journal;
}

}  // namespace talus::campaign
