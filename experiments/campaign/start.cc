#include "experiments/campaign/start.h"

#include <iostream>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/files/output_folder.h"
#include "base/json/json_reader.h"
#include "base/json/json_text.h"
#include "base/json/json_writer.h"
#include "base/text/joined.h"
#include "base/text/shell_text.h"
#include "base/version.h"
#include "experiments/campaign/add_parameter.h"
#include "experiments/campaign/earlier_posterior.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/record/heap_mass.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/reuse.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/spec/plausible.h"
#include "experiments/journal/record_json.h"
#include "experiments/trials/engines/template_folder.h"
#include "experiments/trials/engines/trial_engine.h"
#include "imaging/formats/images/image_file.h"

namespace talus::campaign {
namespace {

namespace fs = std::filesystem;

std::vector<journal::ParameterRecord> ParametersOf(const optimizer::ParameterSpace& space) {
  std::vector<journal::ParameterRecord> records;
  for (const int i : space.Free()) {
    const optimizer::Parameter& p = space.parameters[static_cast<std::size_t>(i)];
    records.push_back({.name = p.name,
                       .low = p.low,
                       .high = p.high,
                       .scale = std::string(base::NameOf(p.scale)),
                       .unit = UnitOf(p.name)});
  }
  return records;
}

void AddImages(const ExperimentSpec& spec, const rigs::Case& rig_case,
               journal::ExperimentRecord& record) {
  const imaging::Experiment experiment = MeasureImages(spec);
  for (const imaging::PhotoWarning& warning : experiment.warnings) {
    record.warnings.push_back({.kind = std::string(base::NameOf(warning.doubt)),
                               .photo = warning.photo.string(),
                               .value = warning.value,
                               .text = imaging::WarningText(warning)});
  }
  if (auto doubt = MoreThanFilled(rig_case, experiment.aehp)) record.warnings.push_back(*doubt);
  for (const journal::PhotoWarningRecord& warning : record.warnings) {
    std::cerr << "warning: experiment \"" << spec.name << "\": " << warning.text << '\n';
  }
  record.aehp_png = imaging::EncodePng(experiment.aehp.image);
  if (!experiment.standard_deviation.pixels.empty()) {
    record.aehp_sd_png = imaging::EncodePng(experiment.standard_deviation);
  }
  record.frame_json = base::JsonText(base::ToJson(experiment.aehp.frame));
  record.nebp_px = imaging::Nebp(experiment.aehp.image);
  record.num_heaps =
      experiment.runs.empty() ? spec.images.map_heaps : static_cast<int>(experiment.runs.size());
  if (experiment.noise_floor) record.noise_mm2 = experiment.noise_floor->mean_sad_mm2;
  for (const imaging::Metric& metric : experiment.metrics) {
    record.reference.push_back({.name = metric.name,
                                .value = metric.value.value,
                                .unit = metric.unit,
                                .undefined = metric.value.not_defined,
                                .standard_error = metric.value.standard_error});
  }
  for (const imaging::MeasuredRun& run : experiment.runs) {
    record.runs.push_back({.name = run.name, .png = imaging::EncodePng(run.profile.image)});
  }
}

// The journal, or a new one from what the folder keeps beside it.
journal::Journal OpenOrRebuild(const CampaignFolder& folder, Console& console) {
  const fs::path path = journal::JournalPath(folder.root);
  std::string damage = "is not there";
  if (fs::exists(path)) {
    try {
      return journal::Journal::Open(path);
    } catch (const base::ConfigError&) {
      throw;  // another program's, or held by one
    } catch (const base::Error& error) {
      damage = error.what();
    }
    RequireWritable(folder.root);  // a journal that cannot be written is not damaged
  }
  console.Line("the journal " + damage + "; it is made anew from the trials' folders");
  return RebuildJournal(folder);
}

// What may be in a folder that a campaign begins in: what a process that was killed, or another
// that begins now, has left there before the campaign itself. No image is without the lock,
// which is there first: a user's own may have these names.
bool HoldsOnlyBeginnings(const CampaignFolder& folder) {
  constexpr std::string_view kCopies[] = {kCopiesFolder};
  if (!fs::exists(folder.root / trials::kCampaignLock))
    return base::HoldsOnly(folder.root, kCopies);
  for (const auto& entry : fs::directory_iterator(folder.root)) {
    const std::string name = entry.path().filename();
    const bool is_image =
        name.ends_with(".png") && (name.starts_with("aehp") || name.starts_with("run_"));
    const bool may_be_there = name == trials::kCampaignLock || name == kCopiesFolder || is_image ||
                              name.starts_with("experiment_") ||
                              name.find(".tmp") != std::string::npos;
    if (!may_be_there) return false;
  }
  return true;
}

void RequireNewFolder(const CampaignFolder& folder, const fs::path& shown) {
  if (fs::exists(journal::JournalPath(folder.root)) || fs::exists(folder.campaign())) {
    throw base::ConfigError(shown.string() + ": holds a campaign already; `talus resume " +
                            base::ShellWord(shown.string()) +
                            "` goes on with it, or name another folder with --out");
  }
  if (HoldsOnlyBeginnings(folder)) return;
  throw base::ConfigError(shown.string() +
                          ": holds other files, which the campaign's could overwrite; name a new "
                          "folder with --out");
}

// A campaign that takes its own trials over would lose them.
void RequireOthers(const std::vector<fs::path>& reuse, const CampaignFolder& folder) {
  const auto place_of = [](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path));
  };
  for (const fs::path& other : reuse) {
    if (place_of(other) == place_of(folder.root)) {
      throw base::ConfigError("--reuse: " + other.string() +
                              ": is the new campaign's own folder; name that of a former one");
    }
  }
}

// The campaign is there once campaign.json is; from then on OpenCampaign does what is left of this.
void WriteCampaign(const CampaignFolder& folder, const journal::CampaignRecord& record,
                   const std::vector<journal::TrialRecord>& reused,
                   const std::vector<std::string>& messages) {
  KeepCampaign(folder, record);
  AdoptCopies(folder);
  journal::Journal journal =
      journal::Journal::Create(journal::JournalPath(folder.root), record, reused);
  for (const std::string& message : messages) journal.AddEvent("reuse", 0, message);
}

// Photographs that cannot be used are named for all experiments at once.
std::vector<journal::ExperimentRecord> MeasuredExperiments(const CampaignSpec& spec) {
  std::vector<journal::ExperimentRecord> records;
  std::vector<std::string> faults;
  const auto num_experiments = static_cast<int>(ExperimentsOf(spec).size());
  for (int e = 0; e < num_experiments; ++e) {
    try {
      records.push_back(MakeExperimentRecord(spec, e));
    } catch (const base::ConfigError& error) {
      faults.emplace_back(error.what());
    }
  }
  if (!faults.empty()) throw base::ConfigError(base::Joined(faults, "\n"));
  return records;
}

// The folder first: a journal that is made anew from it is to know of the change as well.
void WriteSpec(const CampaignFolder& folder, const SpecChange& change, journal::Journal& journal) {
  journal::CampaignRecord record = journal.Campaign();
  record.name = change.spec.name;
  if (!change.path.empty()) record.spec_path = change.path;
  record.spec_text = change.text;
  record.spec_json = SpecText(change.spec);
  KeepCampaign(folder, record);
  journal.SetSpec(record, change.asks_more);
}

}  // namespace

std::vector<journal::ParameterRecord> SearchedParameters(const CampaignSpec& spec) {
  return ParametersOf(SpaceOf(spec));
}

journal::ExperimentRecord MakeExperimentRecord(const CampaignSpec& campaign, int experiment) {
  const ExperimentSpec spec = ExperimentsOf(campaign)[static_cast<std::size_t>(experiment)];
  journal::ExperimentRecord record;
  record.name = spec.name;
  if (spec.images.HasImages()) {
    rigs::Case rig_case = TypicalCase(campaign, experiment, 1);
    rig_case.powder.mass = MostMass(campaign, spec);
    AddImages(spec, rig_case, record);
  }
  for (const ScalarSpec& scalar : ScalarsOf(spec)) {
    record.scalars.push_back({.name = scalar.metric,
                              .value = scalar.value,
                              .standard_error = scalar.standard_error,
                              .degrees = scalar.degrees});
  }
  return record;
}

journal::CampaignRecord MakeRecord(const CampaignSpec& spec, const base::JsonFile& file) {
  journal::CampaignRecord record;
  record.name = spec.name;
  record.spec_path = fs::absolute(file.path).lexically_normal().string();
  record.spec_text = base::ReadFile(file.path);
  record.spec_json = SpecText(spec);
  record.spec_hash = base::Hex(base::Checksum(record.spec_json));
  record.talus_version = base::Version() + ", commit " + base::Commit();
  record.created_utc = journal::UtcNow();
  record.objective = base::NameOf(spec.objective);
  record.parameters = SearchedParameters(spec);
  record.experiments = MeasuredExperiments(spec);
  ReferencesOf(record, spec);  // throws where the experiment does not have what is to be met
  return record;
}

void BeginCampaign(const fs::path& spec_path, const fs::path& root, const BeginOptions& options) {
  base::JsonFile file = base::ReadJsonFile(spec_path);
  if (options.hold_out && file.root.is_object()) file.root["hold_out"] = *options.hold_out;
  const CampaignSpec spec = ReadSpecWithPosteriors(file);
  const CampaignFolder folder{fs::absolute(root)};
  RequireOthers(options.reuse, folder);
  RequireNewFolder(folder, root);
  if (spec.engine.kind == EngineKind::kCommand) trials::RequireOutside(spec.engine.command, root);
  options.check(spec);
  const journal::CampaignRecord record = MakeRecord(spec, file);
  const std::vector<std::string> doubts = EarlierWarnings(spec, record);
  const std::vector<Reference> references = ReferencesOf(record, spec);
  const auto engine = options.engine ? options.engine() : MakeEngine(spec);
  const Reuser reuser{.spec = spec, .references = references, .engine = *engine};
  ReusePlan plan;
  if (!options.reuse.empty()) plan = PlanReuse(reuser, options.reuse);
  base::MakeOutputFolder(root);
  const CampaignLock lock(folder.root);
  RequireNewFolder(folder, root);  // another process may have begun one meanwhile
  const std::vector<journal::TrialRecord> reused = CopyReused(reuser, folder, plan);
  WriteCampaign(folder, record, reused, plan.messages);
  for (const std::string& reading : ReadingTexts(ExperimentsOf(spec))) options.say(reading);
  for (const std::string& doubt : doubts) options.say("warning: " + doubt);
  for (const std::string& message : plan.messages) options.say(message);
}

OpenedCampaign OpenCampaign(const fs::path& root, const ResumeOptions& options, Console& console,
                            const OpenCheck& check) {
  const CampaignFolder folder{fs::absolute(root)};
  if (!fs::is_directory(folder.root)) {
    throw base::ConfigError(root.string() +
                            ": is no folder of a campaign; name the one that `talus calibrate` "
                            "wrote, or begin one: `talus calibrate SPEC`");
  }
  if (!fs::exists(folder.campaign()) && !fs::exists(journal::JournalPath(folder.root))) {
    throw base::ConfigError(root.string() +
                            ": holds no campaign; `talus calibrate SPEC` begins one");
  }
  CampaignLock lock(folder.root);
  if (fs::exists(folder.campaign())) AdoptCopies(folder);
  journal::Journal journal = OpenOrRebuild(folder, console);
  const journal::CampaignRecord record = journal.Campaign();
  const SpecChange change = ChangeOf(journal, folder.root, options);
  if (!change.note.empty()) console.Line(change.note);
  CampaignSpec spec = change.spec;
  if (options.objective) spec.objective = *options.objective;
  ReferencesOf(record, spec);  // throws for an objective that the experiment does not have
  MakeEngine(spec);            // and for templates that are not those it began with
  check(spec, record);
  if (change.engine_is_new) base::WriteFileAtomically(folder.mended(), change.words + "\n");
  // A search is open again together with what it goes on by: one that ends in between, or finds the
  // disk full, is as it was.
  if (!options.search.empty()) {
    WriteAddedParameters(folder, change.spec, change.text, journal);
  }
  if (!change.event.empty() || !change.path.empty()) WriteSpec(folder, change, journal);
  if (options.objective && !change.asks_more) journal.ReopenSearch();
  if (options.objective || change.asks_more) fs::remove(folder.progress());
  if (!change.event.empty()) {
    journal.AddEvent(change.event, 0, change.words);
  }
  return {.folder = folder,
          .lock = std::move(lock),
          .journal = std::move(journal),
          .spec = std::move(spec),
          .engine_is_new = fs::exists(folder.mended())};
}

}  // namespace talus::campaign
