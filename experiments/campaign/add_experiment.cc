#include "experiments/campaign/add_experiment.h"

#include <algorithm>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "base/text/shell_text.h"
#include "experiments/campaign/folder/goal_folder.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/make_parts.h"
#include "experiments/campaign/plan/core_time.h"
#include "experiments/campaign/record/stored.h"
#include "experiments/campaign/spec/drum_images.h"
#include "experiments/campaign/start.h"
#include "experiments/campaign/take_over.h"

namespace talus::campaign {
namespace {

// Makes its photographs' paths absolute, so that the campaign finds them from any folder.
ExperimentSpec ReadExperiment(const std::filesystem::path& path) {
  const base::JsonFile file = base::ReadJsonFile(path);
  base::Problems problems(path.string(), file.places);
  ExperimentSpec experiment;
  base::ReadOptions(file.root, experiment,
                    {problems, std::filesystem::absolute(path).parent_path()});
  base::TreeValidator(problems).Check(experiment);
  problems.ThrowIfAny();
  return experiment;
}

CampaignSpec SpecWith(const CampaignSpec& spec, const ExperimentSpec& experiment) {
  CampaignSpec with = spec;
  with.experiments = ExperimentsOf(spec);
  with.experiment.reset();
  with.experiments->push_back(experiment);
  with.budget.simulations = 0;
  with.budget.min_simulations = 0;
  with.budget.wall_clock.reset();
  return with;
}

// Throws where the campaign's strategy has one objective.
void RequireSeveral(const CampaignSpec& before, const std::filesystem::path& folder) {
  if (!before.HasOwnProposer()) return;
  throw base::ConfigError(folder.string() + ": its strategy \"" +
                          std::string(base::NameOf(before.strategy.kind)) +
                          "\" minimises one objective, so no test can be added; begin a new "
                          "campaign of both tests, with strategy.kind \"auto\"");
}

// Also where the same command was killed when it had recorded the test.
void RequireNew(const CampaignSpec& before, const std::string& name,
                const std::filesystem::path& folder) {
  const std::vector<ExperimentSpec> all = ExperimentsOf(before);
  if (std::ranges::none_of(all, [&](const ExperimentSpec& e) { return e.name == name; })) return;
  throw base::ConfigError(folder.string() + ": has a test \"" + name +
                          "\" already; `talus resume " + base::ShellWord(folder.string()) +
                          "` goes on with it, or give the new one another name");
}

// Reports problems under the keys of the test's own file.
void Check(const CampaignSpec& before, const ExperimentSpec& experiment,
           const std::filesystem::path& file) {
  CampaignSpec spec = SpecWith(before, experiment);
  spec.budget = before.budget;
  SetDrumDiameters(spec);
  base::Problems found;
  CheckSpec(spec, found);
  base::Problems problems(file.string(), base::ReadJsonFile(file).places);
  AddByOwnKeys(found, spec, problems);
  problems.ThrowIfAny();
}

void Write(OpenedCampaign& opened, const journal::CampaignRecord& record, const TakenOver& taken) {
  const journal::ExperimentRecord& experiment = record.experiments.back();
  KeepCampaign(opened.folder, record);
  opened.journal.AddExperiment(experiment, record.spec_json, taken.trials);
  std::filesystem::remove(opened.folder.progress());
  opened.journal.AddEvent("experiment", 0, "\"" + experiment.name + "\" is added");
  if (taken.trials.empty()) return;
  opened.journal.AddEvent("experiment", 0, TakenOverText(taken));
}

}  // namespace

void AddExperiment(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const AddOptions& options, Console& console) {
  if (options.core_time && !(*options.core_time > 0)) {
    throw base::ConfigError("--core-time: must be positive");
  }
  const auto experiment = ReadExperiment(file);
  CampaignSpec spec;
  journal::CampaignRecord record;
  std::vector<Reference> references;
  std::unique_ptr<trials::TrialEngine> engine;
  const auto check = [&](const CampaignSpec& before, const journal::CampaignRecord& campaign) {
    RequireSeveral(before, folder);
    RequireNew(before, experiment.name, folder);
    Check(before, experiment, file);
    spec = SpecWith(before, experiment);
    SetDrumDiameters(spec);
    SetDrumFills(spec);
    record = campaign;
    record.experiments.push_back(
        MakeExperimentRecord(spec, static_cast<int>(spec.experiments->size()) - 1));
    // Throws where the test does not have what is to be met.
    references = ReferencesOf(record, spec);
    engine = options.engine ? options.engine() : MakeEngine(spec);
  };
  OpenedCampaign opened = OpenCampaign(folder, {}, console, check);
  const std::vector<journal::TrialRecord> trials = opened.journal.Trials();
  CoreTime core_time(opened.spec);
  spec.budget.core_time =
      core_time.OfSearch(trials) + options.core_time.value_or(core_time.OfTold(trials));
  // The runs of a goal count against the budget, too.
  *spec.budget.core_time += GoalCoreTime(opened.folder.root, opened.spec);
  const TakenOver taken = TakeOverDesigns(opened.folder, trials,
                                          {.spec = spec,
                                           .index = static_cast<int>(references.size()) - 1,
                                           .reference = references.back()},
                                          *engine);
  *spec.budget.core_time += taken.core_time;
  journal::CampaignRecord now = opened.journal.Campaign();  // by a changed spec, where it has
  now.experiments.push_back(record.experiments.back());
  now.spec_json = SpecText(spec);
  Write(opened, now, taken);
  for (const std::string& reading : ReadingTexts({ExperimentsOf(spec).back()}))
    console.Line(reading);
  if (!taken.trials.empty()) console.Line(TakenOverText(taken));
}

}  // namespace talus::campaign
