// What the journal says of the campaign as a whole.
#include "base/error.h"
#include "experiments/journal/checksums.h"
#include "experiments/journal/experiment_tables.h"
#include "experiments/journal/journal.h"
#include "experiments/journal/objective.h"

namespace talus::journal {
namespace {

// "J/m^2" → "J_per_m2": a unit as part of a column's name.
std::string UnitInName(const std::string& unit) {
  std::string name;
  for (const char c : unit) {
    if (c == '/') {
      name += "_per_";
    } else if (c != '^') {
      name += c;
    }
  }
  return name;
}

}  // namespace

std::string ColumnName(const ParameterRecord& parameter) {
  return parameter.unit.empty() ? parameter.name
                                : parameter.name + "_" + UnitInName(parameter.unit);
}

void Journal::InsertCampaign(const CampaignRecord& c) {
  database_
      .Prepare(
          "INSERT INTO campaign VALUES (1, ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, 'running', '', 0, '', "
          "'')")
      .Bind(c.name, c.spec_path, c.spec_text, c.spec_json, c.spec_hash, c.talus_version,
            c.created_utc, c.objective)
      .Finish();
  InsertParameters(c);
  for (std::size_t i = 0; i < c.experiments.size(); ++i) {
    InsertExperiment(database_, static_cast<std::int64_t>(i), c.experiments[i]);
  }
}

void Journal::InsertParameters(const CampaignRecord& c) {
  for (std::size_t i = 0; i < c.parameters.size(); ++i) {
    const ParameterRecord& p = c.parameters[i];
    database_.Prepare("INSERT INTO parameters VALUES (?1, ?2, ?3, ?4, ?5, ?6)")
        .Bind(static_cast<std::int64_t>(i), p.name, p.low, p.high, p.scale, p.unit)
        .Finish();
  }
}

void Journal::SetParameters(const CampaignRecord& campaign, std::span<const TrialRecord> trials) {
  Transaction transaction(database_);
  database_.Execute("DROP VIEW results; DELETE FROM points; DELETE FROM parameters");
  InsertParameters(campaign);
  CreateView(campaign);
  for (const TrialRecord& trial : trials) InsertPoint(trial);
  database_.Prepare("UPDATE campaign SET spec_text = ?1, spec_json = ?2, result_json = ''")
      .Bind(campaign.spec_text, campaign.spec_json)
      .Finish();
  SetOpen();
  SealAll(database_);
  transaction.Commit();
}

// One row a trial with parameters and the usual metrics side by side: what people want to see.
void Journal::CreateView(const CampaignRecord& campaign) {
  std::string columns = "SELECT t.id, t.kind, t.status";
  for (std::size_t i = 0; i < campaign.parameters.size(); ++i) {
    const ParameterRecord& p = campaign.parameters[i];
    columns +=
        ",\n (SELECT value FROM points WHERE trial = t.id AND position = " + std::to_string(i) +
        ") AS " + ColumnName(p);
  }
  for (const ObjectiveInfo& objective : kObjectives) {
    const std::string metric(objective.metric);
    columns += ",\n (SELECT value FROM metrics WHERE trial = t.id AND name = '" + metric +
               "') AS " + metric;
  }
  database_.Execute("CREATE VIEW results AS " + columns +
                    ",\n t.scale_factor, (SELECT name FROM experiments WHERE position = "
                    "t.experiment) AS experiment,"
                    "\n t.duration_s, t.seed, t.reason FROM trials t ORDER BY t.id");
}

CampaignRecord Journal::Campaign() {
  Statement row = database_.Prepare(
      "SELECT name, spec_path, spec_text, spec_json, spec_hash, talus_version, created_utc, "
      "objective FROM campaign");
  if (!row.Step()) throw base::Error("the journal holds no campaign");
  CampaignRecord c;
  row.Read(0, c.name, c.spec_path, c.spec_text, c.spec_json, c.spec_hash, c.talus_version,
           c.created_utc, c.objective);
  Statement list =
      database_.Prepare("SELECT name, low, high, scale, unit FROM parameters ORDER BY position");
  while (list.Step()) {
    ParameterRecord& p = c.parameters.emplace_back();
    list.Read(0, p.name, p.low, p.high, p.scale, p.unit);
  }
  c.experiments = ReadExperiments(database_);
  return c;
}

ProgressRecord Journal::Progress() {
  Statement row = database_.Prepare(
      "SELECT state, stop_reason, elapsed_s, result_json, stop_json FROM campaign");
  if (!row.Step()) throw base::Error("the journal holds no campaign");
  ProgressRecord p;
  row.Read(0, p.state, p.stop_reason, p.elapsed_s, p.result_json, p.stop_json);
  return p;
}

void Journal::SetProgress(const ProgressRecord& progress) {
  Transaction transaction(database_);
  database_
      .Prepare(
          "UPDATE campaign SET state = ?1, stop_reason = ?2, elapsed_s = ?3, result_json = ?4, "
          "stop_json = ?5")
      .Bind(base::NameOf(progress.state), progress.stop_reason, progress.elapsed_s,
            progress.result_json, progress.stop_json)
      .Finish();
  SealCampaign(database_);
  transaction.Commit();
}

void Journal::SetOpen() {
  database_.Execute(
      "UPDATE campaign SET stop_json = ''; "
      "UPDATE campaign SET state = 'interrupted', stop_reason = 'it is to go on' "
      "WHERE state = 'finished'");
}

void Journal::ReopenSearch() {
  Transaction transaction(database_);
  SetOpen();
  SealCampaign(database_);
  transaction.Commit();
}

void Journal::SetSpec(const CampaignRecord& campaign, bool reopens) {
  Transaction transaction(database_);
  database_.Prepare("UPDATE campaign SET name = ?1, spec_path = ?2, spec_text = ?3, spec_json = ?4")
      .Bind(campaign.name, campaign.spec_path, campaign.spec_text, campaign.spec_json)
      .Finish();
  if (reopens) SetOpen();
  SealCampaign(database_);
  transaction.Commit();
}

void Journal::AddExperiment(const ExperimentRecord& experiment, std::string_view spec_json,
                            std::span<const TrialRecord> trials) {
  Transaction transaction(database_);
  InsertExperiment(database_, database_.Number("SELECT count(*) FROM experiments"), experiment);
  database_.Prepare("UPDATE campaign SET spec_json = ?1, result_json = ''")
      .Bind(spec_json)
      .Finish();
  for (const TrialRecord& trial : trials) Insert(trial);
  SetOpen();
  SealCampaign(database_);
  transaction.Commit();
}

}  // namespace talus::journal
