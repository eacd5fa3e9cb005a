#include "experiments/journal/checksums.h"

#include <array>
#include <map>
#include <utility>

#include "base/files/file.h"

namespace talus::journal {
namespace {

constexpr std::int64_t kCampaign = 0;  // trials count from 1

// Every column of these, so that a new column is covered as it comes; the first is the trial. A
// profile has a checksum beside it.
struct Query {
  const char* rows;
  const char* of_one;  // condition that selects one trial
  const char* order;
};
constexpr std::array kOfTrials{
    Query{"SELECT id, * FROM trials", " WHERE id = ?1", " ORDER BY id"},
    Query{"SELECT trial, * FROM points", " WHERE trial = ?1", " ORDER BY trial, position"},
    Query{"SELECT trial, * FROM metrics", " WHERE trial = ?1", " ORDER BY trial, name"}};
constexpr const char* kOfCampaign[] = {
    "SELECT 0, * FROM campaign",
    "SELECT 0, * FROM parameters ORDER BY position",
    "SELECT 0, * FROM experiments ORDER BY position",
    "SELECT 0, * FROM experiment_runs ORDER BY experiment, position",
    "SELECT 0, * FROM experiment_scalars ORDER BY experiment, position",
    "SELECT 0, * FROM reference_metrics ORDER BY experiment, position",
    "SELECT 0, * FROM experiment_warnings ORDER BY experiment, position"};

using Contents = std::map<std::int64_t, std::string>;

void AddRows(Statement rows, Contents& contents) {
  while (rows.Step()) {
    std::string& content = contents[rows.Integer(0)];
    for (int column = 1; column < rows.NumColumns(); ++column) content += rows.Raw(column);
  }
  for (auto& [id, content] : contents) content += ';';
}

std::string DigestOfCampaign(Database& database) {
  Contents contents;
  for (const char* rows : kOfCampaign) AddRows(database.Prepare(rows), contents);
  return base::Hex(base::Checksum(contents[kCampaign]));
}

std::string DigestOfTrial(Database& database, std::int64_t id) {
  Contents contents;
  for (const Query& query : kOfTrials) {
    Statement rows = database.Prepare(std::string(query.rows) + query.of_one + query.order);
    rows.Bind(id);
    AddRows(std::move(rows), contents);
  }
  return base::Hex(base::Checksum(contents[id]));
}

// Digests of all trials, in one walk over each table.
Contents DigestsOfTrials(Database& database) {
  Contents contents;
  for (const Query& query : kOfTrials) {
    AddRows(database.Prepare(std::string(query.rows) + query.order), contents);
  }
  for (auto& [id, content] : contents) content = base::Hex(base::Checksum(content));
  return contents;
}

void Store(Database& database, std::int64_t id, const std::string& digest) {
  database.Prepare("INSERT OR REPLACE INTO checksums VALUES (?1, ?2)").Bind(id, digest).Finish();
}

}  // namespace

void SealTrial(Database& database, std::int64_t trial) {
  Store(database, trial, DigestOfTrial(database, trial));
}

void SealCampaign(Database& database) { Store(database, kCampaign, DigestOfCampaign(database)); }

void SealAll(Database& database) {
  database.Execute("DELETE FROM checksums");
  SealCampaign(database);
  for (const auto& [id, digest] : DigestsOfTrials(database)) Store(database, id, digest);
}

std::string BrokenSeal(Database& database) {
  Contents stored;
  Statement rows = database.Prepare("SELECT id, xxh3 FROM checksums");
  while (rows.Step()) stored[rows.Integer(0)] = rows.Text(1);
  if (stored[kCampaign] != DigestOfCampaign(database)) {
    return "the campaign does not match its checksum";
  }
  stored.erase(kCampaign);
  const Contents trials = DigestsOfTrials(database);
  for (const auto& [id, digest] : trials) {
    if (stored[id] == digest) continue;
    return "trial " + std::to_string(id) + " does not match its checksum";
  }
  return stored.size() == trials.size() ? "" : "a trial is missing";
}

}  // namespace talus::journal
