#include "experiments/campaign/add_experiment.h"

#include <algorithm>
#include <cmath>

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
  with.num_added = spec.num_added.value_or(0) + 1;
  return with;
}

// What the search may spend with the test. One that has ended goes on for as much core time as it
// has used; one that has not goes on to its own bounds, which are wider by what the test takes.
BudgetOptions BudgetWith(const CampaignSpec& with, OpenedCampaign& opened,
                         const AddOptions& options) {
  constexpr int kFewest = 16;  // simulations that a test adds, where nobody says
  const std::vector<journal::TrialRecord> trials = opened.journal.Trials();
  const journal::ProgressRecord progress = opened.journal.Progress();
  CoreTime core_time(with);
  BudgetOptions budget = with.budget;
  // The runs of a goal count against the budget, too.
  const double used = core_time.OfSearch(trials) + GoalCoreTime(opened.folder.root, opened.spec);
  const double told = core_time.OfTold(trials);
  if (SearchHasEnded(progress, budget) && told > 0) {
    budget.simulations = budget.min_simulations = 0;
    budget.wall_clock.reset();
    budget.core_time = used + options.core_time.value_or(told);
    return budget;
  }
  const double factor = with.coarse_graining.scale_factor;
  const int added = static_cast<int>(with.experiments->size()) - 1;
  const double each = core_time.OfOne(added, factor);
  if (budget.core_time) {
    *budget.core_time = std::max(used, *budget.core_time) +
                        options.core_time.value_or(std::max(told, kFewest * each));
  }
  if (budget.simulations > 0) {
    const double num_told =
        static_cast<double>(std::ranges::count_if(trials, &journal::TrialRecord::IsOfSearch));
    // The search may spend it on any of the tests.
    double dearest = each;
    for (int e = 0; e < added; ++e) dearest = std::max(dearest, core_time.OfOne(e, factor));
    const double num_more = options.core_time ? std::ceil(*options.core_time / dearest)
                                              : std::max<double>(kFewest, num_told);
    budget.simulations = static_cast<int>(
        std::min<double>(BudgetOptions::kMostSimulations, budget.simulations + num_more));
  }
  if (progress.elapsed_s >= budget.wall_clock.value_or(0)) budget.wall_clock.reset();
  return budget;
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
  spec.budget = BudgetWith(spec, opened, options);
  const TakenOver taken = TakeOverDesigns(opened.folder, trials,
                                          {.spec = spec,
                                           .index = static_cast<int>(references.size()) - 1,
                                           .reference = references.back()},
                                          *engine);
  // It is paid for already.
  if (spec.budget.core_time) *spec.budget.core_time += taken.core_time;
  if (spec.budget.simulations > 0) spec.budget.simulations += static_cast<int>(taken.trials.size());
  journal::CampaignRecord now = opened.journal.Campaign();  // by a changed spec, where it has
  now.experiments.push_back(record.experiments.back());
  now.spec_json = SpecText(spec);
  Write(opened, now, taken);
  for (const std::string& reading : ReadingTexts({ExperimentsOf(spec).back()}))
    console.Line(reading);
  if (!taken.trials.empty()) console.Line(TakenOverText(taken));
}

}  // namespace talus::campaign
