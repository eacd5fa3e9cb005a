#include "experiments/analysis/export/export.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/csv.h"
#include "experiments/journal/journal.h"

namespace talus::analysis {
namespace {

std::vector<std::string> MetricNames(const std::vector<journal::TrialRecord>& trials) {
  std::set<std::string> names;
  for (const journal::TrialRecord& trial : trials) {
    for (const journal::MetricRecord& metric : trial.metrics) names.insert(metric.name);
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::string TrialsCsv(const journal::CampaignRecord& campaign,
                      const std::vector<journal::TrialRecord>& trials) {
  const std::vector<std::string> metrics = MetricNames(trials);
  std::vector<std::string> first{"trial", "kind",       "origin",      "status",
                                 "seed",  "experiment", "scale_factor"};
  for (const journal::ParameterRecord& p : campaign.parameters) {
    first.push_back(journal::ColumnName(p));
  }
  const std::vector<std::string> last{"duration_s", "cpu_s",        "num_steps", "num_particles",
                                      "attempts",   "finish_order", "host",      "reason"};
  base::Csv csv;
  for (const std::string& head : first) csv.Cell(head);
  for (const std::string& metric : metrics) {
    const bool is_taken = std::ranges::count(first, metric) + std::ranges::count(last, metric) > 0;
    csv.Cell(is_taken ? metric + "_of_engine" : metric);  // a deck may echo what it was given
  }
  for (const std::string& head : last) csv.Cell(head);
  csv.EndRow();
  for (const journal::TrialRecord& t : trials) {
    csv.Cell(t.id).Cell(base::NameOf(t.kind)).Cell(t.origin).Cell(base::NameOf(t.status));
    csv.Cell(t.seed).Cell(campaign.experiments.at(static_cast<std::size_t>(t.experiment)).name);
    csv.Cell(t.scale_factor).Cells(t.native);
    for (const std::string& metric : metrics) csv.Cell(t.Metric(metric).value_or(NAN));
    csv.Cell(t.duration_s).Cell(t.cpu_s).Cell(t.num_steps).Cell(t.num_particles);
    csv.Cell(t.attempts).Cell(t.finish_order).Cell(t.host).Cell(t.reason).EndRow();
  }
  return csv.Take();
}

std::string TrialsJson(const journal::CampaignRecord& campaign,
                       const std::vector<journal::TrialRecord>& trials) {
  nlohmann::ordered_json json;
  json["campaign"] = base::ToJson(campaign);
  json["trials"] = base::ToJson(trials);
  return base::JsonText(json, 1) + "\n";
}

void ExportCampaign(const std::filesystem::path& folder, const std::filesystem::path& out) {
  journal::Journal journal = journal::Journal::OpenReadOnly(journal::JournalPath(folder));
  const journal::CampaignRecord campaign = journal.Campaign();
  const std::vector<journal::TrialRecord> trials = journal.Trials();
  base::ClaimOutputFolder(out, "export");
  base::WriteFileAtomically(out / "trials.csv", TrialsCsv(campaign, trials));
  base::WriteFileAtomically(out / "trials.json", TrialsJson(campaign, trials));
}

}  // namespace talus::analysis
