#include "experiments/analysis/export/export.h"

#include <charconv>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_writer.h"

namespace talus::analysis {
namespace {

// Shortest text that reads back to the same number; nothing for what is not a number.
std::string Exact(double value) {
  if (!std::isfinite(value)) return "";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

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
  std::string csv = "trial,kind,origin,status,seed,experiment,scale_factor";
  for (const journal::ParameterRecord& p : campaign.parameters) csv += "," + journal::ColumnName(p);
  for (const std::string& metric : metrics) csv += "," + metric;
  csv += ",duration_s,cpu_s,num_steps,num_particles,attempts,finish_order,host,reason\n";
  for (const journal::TrialRecord& t : trials) {
    csv += std::to_string(t.id) + "," + std::string(base::NameOf(t.kind)) + "," + t.origin + "," +
           std::string(base::NameOf(t.status)) + "," + std::to_string(t.seed) + "," +
           Quoted(campaign.experiments.at(static_cast<std::size_t>(t.experiment)).name) + "," +
           Exact(t.scale_factor);
    for (const double value : t.native) csv += "," + Exact(value);
    for (const std::string& metric : metrics) csv += "," + Exact(t.Metric(metric).value_or(NAN));
    csv += "," + Exact(t.duration_s) + "," + Exact(t.cpu_s) + "," + std::to_string(t.num_steps) +
           "," + std::to_string(t.num_particles) + "," + std::to_string(t.attempts) + "," +
           std::to_string(t.finish_order) + "," + Quoted(t.host) + "," + Quoted(t.reason) + "\n";
  }
  return csv;
}

std::string TrialsJson(const journal::CampaignRecord& campaign,
                       const std::vector<journal::TrialRecord>& trials) {
  nlohmann::ordered_json json;
  json["campaign"] = base::ToJson(campaign);
  json["trials"] = base::ToJson(trials);
  return json.dump(1) + "\n";
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
