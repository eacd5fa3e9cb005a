#include "experiments/analysis/compare/gather_evidence.h"

#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include "base/error.h"
#include "base/json/json_file.h"
#include "base/json/json_reader.h"
#include "base/not_known.h"
#include "base/text/joined.h"
#include "base/version.h"
#include "engine/kernel/dispatch.h"
#include "experiments/analysis/compare/labels.h"
#include "experiments/campaign/answer/answer.h"
#include "experiments/campaign/folder/campaign_folder.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/status.h"
#include "experiments/journal/checksums.h"
#include "experiments/journal/journal.h"
#include "experiments/journal/objective.h"
#include "experiments/rigs/observables/observable.h"
#include "imaging/formats/images/image_file.h"
#include "optimizer/space/point_rows.h"

namespace talus::analysis {
namespace {

ParameterInfo InfoOf(const journal::ParameterRecord& record) {
  ParameterInfo info;
  info.range = campaign::SearchedParameter(record);
  info.symbol = SymbolOf(record.name);
  info.unit = PrettyUnit(record.unit);
  info.column = journal::ColumnName(record);
  return info;
}

// As the spec has them, which a campaign without an answer has, too.
void MarkNuisances(const campaign::CampaignSpec& spec, Evidence& evidence) {
  const optimizer::ParameterSpace space = campaign::SpaceOf(spec);
  for (ParameterInfo& parameter : evidence.parameters) {
    const auto known =
        std::ranges::find(space.parameters, parameter.range.name, &optimizer::Parameter::name);
    parameter.range.is_nuisance = known != space.parameters.end() && known->is_nuisance;
  }
}

// The value of each known metric, in their order; new ones are added to the list.
std::vector<double> InColumns(const std::vector<journal::MetricRecord>& records,
                              std::vector<MetricInfo>& columns) {
  std::vector<double> values(columns.size(), base::kNotKnown);
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto same = [&](const MetricInfo& info) { return info.name == records[i].name; };
    // Nearly always the list is the same for all.
    const auto found = i < columns.size() && same(columns[i])
                           ? columns.begin() + static_cast<std::ptrdiff_t>(i)
                           : std::find_if(columns.begin(), columns.end(), same);
    if (found == columns.end()) {
      columns.push_back({records[i].name, records[i].unit});
      values.push_back(records[i].value);
    } else {
      values[static_cast<std::size_t>(found - columns.begin())] = records[i].value;
    }
  }
  return values;
}

TrialEvidence EvidenceOf(const journal::TrialRecord& record, std::vector<MetricInfo>& columns) {
  TrialEvidence trial;
  trial.id = static_cast<int>(record.id);
  trial.state = record.status;
  trial.kind = record.kind;
  trial.point = optimizer::VectorOf(record.unit);
  trial.values = record.native;
  trial.seed = record.seed;
  trial.scale_factor = record.scale_factor;
  trial.metrics = InColumns(record.metrics, columns);
  if (trial.state == journal::TrialStatus::kFailed) trial.reason = record.reason;
  if (trial.state != journal::TrialStatus::kRunning) {
    trial.seconds = record.duration_s;
    trial.cpu_seconds = record.cpu_s;
  }
  return trial;
}

// Empty where the experiment has numbers only.
imaging::Profile ReadReference(const journal::ExperimentRecord& record) {
  imaging::Profile aehp;
  if (record.aehp_png.empty()) return aehp;
  base::Problems problems("the journal's frame", {});
  base::ReadOptions(base::ParseJson(record.frame_json, "frame").root, aehp.frame, {problems, {}});
  problems.ThrowIfAny();
  aehp.image = imaging::DecodeGrayImage(record.aehp_png, "the journal's AEHP");
  return aehp;
}

// The finest scale factor of the search that says something, the target where none does: what
// others say of a set is biased by their grains.
double FinestOfSearch(const std::vector<journal::TrialRecord>& trials, double target) {
  double finest = std::numeric_limits<double>::infinity();
  for (const journal::TrialRecord& t : trials) {
    const bool tells = t.status == journal::TrialStatus::kOk;
    if (tells && t.IsOfSearch()) finest = std::min(finest, t.scale_factor);
  }
  return std::isfinite(finest) ? finest : target;
}

void AddTrials(Evidence& evidence, const journal::ExperimentRecord& record,
               const std::vector<journal::TrialRecord>& trials) {
  InColumns(record.reference, evidence.metrics);  // these columns come first
  for (const journal::TrialRecord& trial : trials) {
    evidence.trials.push_back(EvidenceOf(trial, evidence.metrics));
  }
  std::vector<journal::MetricRecord> measured = record.reference;
  for (const journal::ScalarRecord& number : record.scalars) {
    measured.push_back({.name = number.name,
                        .value = number.value,
                        .unit = rigs::UnitOfObservable(number.name),
                        .undefined = {},
                        .standard_error = number.standard_error});
  }
  evidence.reference.metrics = InColumns(measured, evidence.metrics);
  evidence.reference.metrics.resize(evidence.metrics.size(), base::kNotKnown);
  for (journal::MetricRecord& metric : measured) metric.value = metric.standard_error;
  evidence.reference.errors = InColumns(measured, evidence.metrics);
  for (TrialEvidence& trial : evidence.trials) {
    trial.metrics.resize(evidence.metrics.size(), base::kNotKnown);
  }
  evidence.scale_factor = FinestOfSearch(trials, evidence.target);
}

// The times of all experiments together.
void AddTimes(Evidence& evidence, double elapsed) {
  double wall = 0;
  double cpu = 0;
  for (const TrialEvidence* trial : evidence.AllTrials()) {
    if (trial->state == journal::TrialStatus::kRunning ||
        trial->kind == journal::TrialKind::kReused) {
      continue;
    }
    wall += trial->seconds;
    cpu += trial->cpu_seconds;
  }
  evidence.stages = {{"the campaign, from start to now or to its end", elapsed},
                     {"all simulations, one after the other", wall},
                     {"their processor time", cpu}};
}

void AddSpec(Evidence& evidence, const journal::CampaignRecord& record) {
  evidence.spec = record.spec_text;
  evidence.spec_json = record.spec_json;
  const nlohmann::json spec = base::ParseJson(record.spec_json, "the journal's spec").root;
  if (spec.contains("budget")) evidence.max_simulations = spec["budget"].value("simulations", 0);
  if (spec.contains("strategy")) evidence.strategy = spec["strategy"].value("kind", "");
}

// "Linux 6.1.0 x86_64, 8 processors"
std::string MachineText() {
  struct utsname name {};
  if (::uname(&name) != 0) return "unknown";
  return std::string(name.sysname) + " " + name.release + " " + name.machine + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " processors";
}

std::string SeedsText(std::size_t num_trials) {
  if (num_trials == 0) return "none drawn yet";
  return std::to_string(num_trials) + " trials, each with its own in tables/";
}

// Without a name the first that has images, or the first of all where none has.
std::size_t ExperimentNamed(const journal::CampaignRecord& record, const std::string& name) {
  for (std::size_t e = 0; e < record.experiments.size(); ++e) {
    const journal::ExperimentRecord& experiment = record.experiments[e];
    if (name.empty() ? !experiment.aehp_png.empty() : experiment.name == name) return e;
  }
  if (name.empty()) return 0;
  const auto quoted = [](const journal::ExperimentRecord& e) { return "\"" + e.name + "\""; };
  throw base::ConfigError("the campaign has no experiment \"" + name + "\"; it has " +
                          base::Joined(record.experiments, ", ", quoted));
}

// Those of the experiment that is shown, and the others without their metrics.
void AddTrialsOf(const journal::ExperimentRecord& record,
                 const std::vector<journal::TrialRecord>& all, Evidence& evidence) {
  std::vector<journal::TrialRecord> trials;
  for (const journal::TrialRecord& trial : all) {
    std::vector<MetricInfo> none;
    if (static_cast<std::size_t>(trial.experiment) == evidence.experiment) {
      trials.push_back(trial);
    } else {
      evidence.of_others.push_back(EvidenceOf(trial, none));
    }
  }
  AddTrials(evidence, record, trials);
}

void AddReference(const journal::ExperimentRecord& record, Evidence& evidence) {
  evidence.reference.aehp = ReadReference(record);
  evidence.reference.numbers = record.scalars;
  evidence.reference.num_heaps = record.num_heaps;
  evidence.reference.noise_floor = record.noise_mm2.value_or(base::kNotKnown);
}

// A result calls its objective by the key of its value, "sad_mm2" or "aor2_difference_deg".
std::string ObjectiveKey(const std::string& result_key) {
  for (const journal::ObjectiveInfo& info : journal::kObjectives) {
    if (result_key == info.ValueKey()) return std::string(info.key);
  }
  throw base::Error("the journal's result is of \"" + result_key + "\", which is not known here");
}

void AddAnswer(const std::string& result_json, const journal::CampaignRecord& record,
               Evidence& evidence) {
  if (result_json.empty()) return;
  evidence.answer = campaign::ParseAnswer(result_json);
  evidence.objective = ObjectiveKey(evidence.answer->objective);
  evidence.fit = FitRows(*evidence.answer, record);
}

void AddVersions(const journal::CampaignRecord& record, Evidence& evidence) {
  evidence.versions = {{"talus that started the campaign", record.talus_version},
                       {"talus that wrote this report", base::Version()},
                       {"its commit", base::Commit()},
                       {"its compiler", base::Compiler()},
                       {"instruction set here", engine::ChooseKernels().name},
                       {"machine", MachineText()},
                       {"written", journal::UtcNow()},
                       {"started", record.created_utc},
                       {"strategy", evidence.strategy},
                       {"spec", record.spec_path},
                       {"hash of the spec", base::Hex(base::Checksum(record.spec_json))},
                       {"seeds", SeedsText(evidence.trials.size() + evidence.of_others.size())}};
}

}  // namespace

Evidence GatherEvidence(const std::filesystem::path& campaign, const std::string& experiment) {
  const auto journal = std::make_shared<journal::Journal>(
      journal::Journal::OpenReadOnly(journal::JournalPath(campaign)));
  const journal::CampaignRecord record = journal->Campaign();
  const bool worked_on = campaign::IsWorkedOn(campaign);  // asked before what it has written
  const journal::ProgressRecord progress = journal->Progress();

  Evidence evidence;
  evidence.name = record.name;
  evidence.folder = campaign;
  evidence.state = progress.state;
  evidence.stop_reason = progress.stop_reason;
  evidence.objective = record.objective;
  const campaign::CampaignSpec spec = campaign::ParseSpecText(record.spec_json);
  evidence.target = spec.coarse_graining.Target();
  AddSpec(evidence, record);
  for (const journal::ParameterRecord& parameter : record.parameters) {
    evidence.parameters.push_back(InfoOf(parameter));
  }
  for (const journal::ExperimentRecord& e : record.experiments) {
    evidence.experiments.push_back(e.name);
  }
  evidence.experiment = ExperimentNamed(record, experiment);
  const journal::ExperimentRecord& shown = record.experiments.at(evidence.experiment);
  const std::vector<journal::TrialRecord> trials = journal->Trials();
  AddTrialsOf(shown, trials, evidence);
  evidence.ended_silently = evidence.IsRunning() && !worked_on;
  if (evidence.IsRunning()) {
    const auto left = campaign::UseSoFar(campaign, spec, trials, progress.elapsed_s).seconds_left;
    evidence.seconds_left = left.value_or(base::kNotKnown);
  }
  AddReference(shown, evidence);
  AddAnswer(progress.result_json, record, evidence);
  MarkNuisances(spec, evidence);
  AddTimes(evidence, progress.elapsed_s);
  evidence.core_hours = evidence.answer && !evidence.IsRunning()
                            ? evidence.answer->cost.core_hours
                            : campaign::MeasuredCoreTime(trials, spec) / 3600;
  AddVersions(record, evidence);
  evidence.profile =
      [journal, frame = evidence.reference.aehp.frame](int id) -> std::optional<imaging::Profile> {
    const std::string png = journal->ProfilePng(id);
    if (png.empty()) return std::nullopt;
    return imaging::Profile{imaging::DecodeGrayImage(png, "the profile of a trial"), frame};
  };
  return evidence;
}

std::vector<Evidence> GatherOthers(const std::filesystem::path& campaign,
                                   const Evidence& evidence) {
  std::vector<Evidence> others;
  for (std::size_t e = 0; e < evidence.experiments.size(); ++e) {
    if (e != evidence.experiment) {
      others.push_back(GatherEvidence(campaign, evidence.experiments[e]));
    }
  }
  return others;
}

}  // namespace talus::analysis
