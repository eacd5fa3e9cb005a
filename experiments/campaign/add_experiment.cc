#include "experiments/campaign/add_experiment.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/json/json_reader.h"
#include "experiments/campaign/campaign_strategy.h"
#include "experiments/campaign/core_time.h"
#include "experiments/campaign/folder/repair.h"
#include "experiments/campaign/start.h"

namespace talus::campaign {
namespace {

double CoreTimeOfSearch(const CampaignSpec& spec, std::vector<journal::TrialRecord> trials) {
  std::erase_if(trials, [](const journal::TrialRecord& trial) { return !IsOfSearch(trial); });
  return CoreTime(spec).Of(trials);
}

}  // namespace

void AddExperiment(const std::filesystem::path& folder, const std::filesystem::path& file,
                   const AddOptions& options, Console& console) {
  if (options.core_time && !(*options.core_time > 0)) {
    throw base::ConfigError("--core-time: must be positive");
  }
  const auto experiment = base::LoadOptions<ExperimentSpec>(base::ReadJsonFile(file));
  OpenedCampaign opened = OpenCampaign(folder, {}, console);
  CampaignSpec spec = opened.spec;
  spec.experiments = ExperimentsOf(spec);
  spec.experiment.reset();
  spec.experiments->push_back(experiment);
  const double used = CoreTimeOfSearch(opened.spec, opened.journal.Trials());
  spec.budget.core_time = used + options.core_time.value_or(used);
  spec.budget.simulations = 0;
  spec.budget.min_simulations = 0;
  base::Problems problems(file.string(), {});
  CheckSpec(spec, problems);
  problems.ThrowIfAny();
  journal::CampaignRecord record = opened.journal.Campaign();
  record.experiments.push_back(MakeExperimentRecord(spec.experiments->back()));
  record.spec_json = SpecText(spec);
  ReferencesOf(record, spec);  // throws where the test does not have what is to be met
  KeepCampaign(opened.folder, record);
  opened.journal.AddExperiment(record.experiments.back(), record.spec_json);
  opened.journal.AddEvent("experiment", 0, "\"" + experiment.name + "\" is added");
}

}  // namespace talus::campaign
