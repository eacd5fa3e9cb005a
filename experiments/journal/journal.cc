#include "experiments/journal/journal.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>

#include "base/error.h"
#include "base/files/file.h"
#include "base/not_known.h"
#include "experiments/journal/checksums.h"
#include "experiments/journal/damaged_tables.h"
#include "experiments/journal/objective.h"
#include "experiments/journal/schema.h"

namespace talus::journal {
namespace {

void CheckThatItIsAJournal(Database& database, const std::filesystem::path& path) {
  if (database.Number("SELECT COUNT(*) FROM sqlite_schema") == 0) {
    throw base::Error(path.string() +
                      ": holds no campaign yet; `talus resume` begins one that was ended before "
                      "it was written");
  }
  const std::int64_t version = database.Number("PRAGMA user_version");
  if (database.Number("PRAGMA application_id") != kJournalApplicationId) {
    throw base::Error(path.string() + ": is not a journal of talus, or is damaged");
  }
  if (version != kSchemaVersion) {
    throw base::ConfigError(path.string() + ": is of schema " + std::to_string(version) +
                            ", and this talus reads schema " + std::to_string(kSchemaVersion) +
                            " only; use the version that wrote it");
  }
}

std::uint32_t BigEndian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

// From the file's head, so that another program's database is not even opened: that could change
// it. A young journal may be in its log alone, and one that a full disk or a kill has cut short
// when it was made is an empty database.
void RefuseForeignFile(const std::filesystem::path& path) {
  constexpr std::string_view kMagic("SQLite format 3\0", 16);
  std::error_code absent;
  if (std::filesystem::file_size(path.string() + "-wal", absent) > 0 && !absent) return;
  std::ifstream in(path, std::ios::binary);
  char bytes[105] = {};
  const std::string_view head(bytes, sizeof bytes);
  if (!in.read(bytes, sizeof bytes) || !head.starts_with(kMagic)) return;
  if (BigEndian(head.substr(68, 4)) == kJournalApplicationId) return;
  const bool one_page = BigEndian(head.substr(28, 4)) <= 1;
  if (one_page && BigEndian(head.substr(103, 2)) == 0) return;  // no cell: it has no table
  throw base::ConfigError(path.string() +
                          ": is a database of another program; name the folder of "
                          "a campaign");
}

[[noreturn]] void RefuseFolder(const std::filesystem::path& campaign) {
  if (std::filesystem::exists(campaign / "campaign.json")) {
    throw base::Error(campaign.string() +
                      ": its journal is not there; `talus resume` makes it anew from the trials");
  }
  const bool is_folder = std::filesystem::is_directory(campaign);
  throw base::ConfigError(campaign.string() +
                          (is_folder ? ": holds no campaign (journal.sqlite is missing)"
                                     : ": is no folder of a campaign") +
                          "; name the one that `talus calibrate` wrote");
}

std::string WhatIsBroken(Database& database) {
  const std::string damage = DamagedTables(database);
  return damage.empty() ? BrokenSeal(database) : damage;
}

constexpr std::string_view kTrialColumns =
    "id, kind, kind_index, set_index, origin, objective, seed, scale_factor, status, reason, "
    "attempts, finish_order, started_utc, finished_utc, duration_s, cpu_s, num_steps, "
    "num_particles, host, job, experiment, due";

TrialRecord ReadTrial(const Statement& row) {
  TrialRecord t;
  row.Read(0, t.id, t.kind, t.kind_index, t.set, t.origin, t.objective, t.seed, t.scale_factor,
           t.status, t.reason, t.attempts, t.finish_order, t.started_utc, t.finished_utc,
           t.duration_s, t.cpu_s, t.num_steps, t.num_particles, t.host, t.job, t.experiment, t.due);
  if (t.status == TrialStatus::kRunning) {  // what its attempts take is added to these
    if (std::isnan(t.duration_s)) t.duration_s = 0;
    if (std::isnan(t.cpu_s)) t.cpu_s = 0;
  }
  return t;
}

}  // namespace

std::filesystem::path JournalPath(const std::filesystem::path& campaign) {
  return campaign / "journal.sqlite";
}

std::string UtcNow() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

std::optional<double> TrialRecord::Metric(std::string_view name) const {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const auto& m) { return m.name == name; });
  if (found == metrics.end() || !std::isfinite(found->value)) return std::nullopt;
  return found->value;
}

Journal Journal::Create(const std::filesystem::path& path, const CampaignRecord& campaign,
                        std::span<const TrialRecord> trials) {
  if (std::filesystem::exists(path)) {
    throw base::ConfigError(path.string() +
                            ": exists already; `talus resume` goes on with that campaign, or name "
                            "another folder with --out");
  }
  Journal journal{Database(path, Database::Mode::kCreate)};
  Transaction transaction(journal.database_);
  journal.database_.Execute(kSchema);
  journal.InsertCampaign(campaign);
  journal.CreateView(campaign);
  journal.database_.Execute("PRAGMA application_id = " + std::to_string(kJournalApplicationId) +
                            "; PRAGMA user_version = " + std::to_string(kSchemaVersion));
  SealCampaign(journal.database_);
  for (const TrialRecord& trial : trials) journal.Insert(trial);
  transaction.Commit();
  return journal;
}

Journal Journal::Open(const std::filesystem::path& path) {
  RefuseForeignFile(path);
  Database database(path, Database::Mode::kReadWrite);
  CheckThatItIsAJournal(database, path);
  if (const std::string damage = database.Damage(); !damage.empty()) {
    throw base::Error(path.string() + ": is damaged: " + damage);
  }
  if (const std::string broken = WhatIsBroken(database); !broken.empty()) {
    throw base::Error(path.string() + ": is damaged: " + broken);
  }
  return Journal(std::move(database));
}

Journal Journal::OpenReadOnly(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) RefuseFolder(path.parent_path());
  Database database(path, Database::Mode::kReadOnly);
  CheckThatItIsAJournal(database, path);
  database.Execute("BEGIN");  // another process may be writing
  const std::string broken = WhatIsBroken(database);
  database.Execute("COMMIT");
  if (!broken.empty()) {
    throw base::Error(path.string() + ": is damaged: " + broken + "; `talus resume` repairs it");
  }
  return Journal(std::move(database));
}

std::vector<TrialRecord> Journal::Trials() {
  std::vector<TrialRecord> trials;
  Statement row =
      database_.Prepare("SELECT " + std::string(kTrialColumns) + " FROM trials ORDER BY id");
  while (row.Step()) trials.push_back(ReadTrial(row));
  ReadPoints(trials);
  ReadMetrics(trials);
  return trials;
}

// Both tables are walked once, in the order of the trials.
void Journal::ReadPoints(std::vector<TrialRecord>& trials) {
  Statement row =
      database_.Prepare("SELECT trial, unit_value, value FROM points ORDER BY trial, position");
  auto trial = trials.begin();
  while (row.Step()) {
    while (trial != trials.end() && trial->id < row.Integer(0)) ++trial;
    if (trial == trials.end()) break;  // started after the trials were read
    if (trial->id != row.Integer(0)) continue;
    trial->unit.push_back(row.Real(1));
    trial->native.push_back(row.Real(2));
  }
}

void Journal::ReadMetrics(std::vector<TrialRecord>& trials) {
  Statement row = database_.Prepare(
      "SELECT trial, name, value, unit, undefined FROM metrics ORDER BY trial, name");
  auto trial = trials.begin();
  while (row.Step()) {
    while (trial != trials.end() && trial->id < row.Integer(0)) ++trial;
    if (trial == trials.end()) break;
    if (trial->id != row.Integer(0)) continue;
    MetricRecord& m = trial->metrics.emplace_back();
    row.Read(1, m.name, m.value, m.unit, m.undefined);
  }
}

void Journal::Start(std::span<const TrialRecord> trials, base::Outlives outlives) {
  Transaction transaction(database_, outlives);
  for (const TrialRecord& trial : trials) Insert(trial);
  transaction.Commit();
}

void Journal::Insert(const TrialRecord& t) {
  // Only of a trial that had ended in a journal that was lost, or in another campaign.
  const auto if_known = [](double seconds) { return seconds > 0 ? seconds : base::kNotKnown; };
  database_
      .Prepare("INSERT INTO trials (" + std::string(kTrialColumns) +
               ") VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, 'running', '', ?9, 0, ?10, ?16, ?13, "
               "?14, 0, 0, '', ?11, ?12, ?15)")
      .Bind(t.id, base::NameOf(t.kind), t.kind_index, t.set, t.origin, t.objective, t.seed,
            t.scale_factor, t.attempts, t.started_utc, t.job, t.experiment, if_known(t.duration_s),
            if_known(t.cpu_s), t.due, t.finished_utc)
      .Finish();
  InsertPoint(t);
  SealTrial(database_, t.id);
}

void Journal::InsertPoint(const TrialRecord& t) {
  for (std::size_t i = 0; i < t.unit.size(); ++i) {
    database_.Prepare("INSERT INTO points VALUES (?1, ?2, ?3, ?4)")
        .Bind(t.id, static_cast<std::int64_t>(i), t.unit[i], t.native[i])
        .Finish();
  }
}

void Journal::Restart(std::span<const TrialRecord> trials) {
  Transaction transaction(database_);
  for (const TrialRecord& t : trials) {
    database_
        .Prepare(
            "UPDATE trials SET seed = ?2, attempts = ?3, job = ?4, started_utc = ?5, finished_utc "
            "= "
            "'', duration_s = ?6, cpu_s = ?7 WHERE id = ?1 AND status = 'running'")
        .Bind(t.id, t.seed, t.attempts, t.job, t.started_utc, t.duration_s, t.cpu_s)
        .Finish();
    SealTrial(database_, t.id);
  }
  transaction.Commit();
}

void Journal::Reopen(std::span<const TrialRecord> trials) {
  Transaction transaction(database_);
  for (const TrialRecord& t : trials) {
    database_
        .Prepare(
            "UPDATE trials SET status = 'running', reason = '', job = '', finish_order = 0, "
            "finished_utc = '' WHERE id = ?1 AND finish_order > 0")
        .Bind(t.id)
        .Finish();
    database_.Prepare("DELETE FROM metrics WHERE trial = ?1").Bind(t.id).Finish();
    SealTrial(database_, t.id);
  }
  transaction.Commit();
  last_finish_order_.reset();
}

void Journal::NoteEnd(const TrialRecord& t) {
  Transaction transaction(database_);
  database_.Prepare("UPDATE trials SET duration_s = ?2, cpu_s = ?3, host = ?4 WHERE id = ?1")
      .Bind(t.id, t.duration_s, t.cpu_s, t.host)
      .Finish();
  SealTrial(database_, t.id);
  transaction.Commit();
}

void Journal::Finish(TrialRecord& t, std::string_view profile_png) {
  Transaction transaction(database_);
  if (!last_finish_order_) {
    last_finish_order_ = database_.Number("SELECT ifnull(max(finish_order), 0) FROM trials");
  }
  t.finish_order = *last_finish_order_ + 1;
  database_
      .Prepare(
          "UPDATE trials SET status = ?2, reason = ?3, attempts = ?4, finish_order = ?5, "
          "finished_utc = ?6, duration_s = ?7, cpu_s = ?8, num_steps = ?9, num_particles = "
          "?10, host = ?11 WHERE id = ?1")
      .Bind(t.id, base::NameOf(t.status), t.reason, t.attempts, t.finish_order, t.finished_utc,
            t.duration_s, t.cpu_s, t.num_steps, t.num_particles, t.host)
      .Finish();
  for (const MetricRecord& metric : t.metrics) {
    database_.Prepare("INSERT OR REPLACE INTO metrics VALUES (?1, ?2, ?3, ?4, ?5)")
        .Bind(t.id, metric.name, metric.value, metric.unit, metric.undefined)
        .Finish();
  }
  if (!profile_png.empty()) {
    database_.Prepare("INSERT OR REPLACE INTO profiles VALUES (?1, ?2, ?3)")
        .Bind(t.id, Blob{profile_png}, base::Hex(base::Checksum(profile_png)))
        .Finish();
  }
  SealTrial(database_, t.id);
  transaction.Commit();
  last_finish_order_ = t.finish_order;
}

std::string Journal::ProfilePng(std::int64_t trial) {
  Statement row = database_.Prepare("SELECT png, checksum_xxh3 FROM profiles WHERE trial = ?1");
  row.Bind(trial);
  if (!row.Step()) return {};
  std::string png = row.Text(0);
  return base::Hex(base::Checksum(png)) == row.Text(1) ? png : std::string();
}

void Journal::AddEvent(std::string_view kind, std::int64_t trial, std::string_view text) {
  database_.Prepare("INSERT INTO events (utc, kind, trial, text) VALUES (?1, ?2, ?3, ?4)")
      .Bind(UtcNow(), kind, trial, text)
      .Finish();
}

}  // namespace talus::journal
