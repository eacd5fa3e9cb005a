#include "experiments/analysis/predict/test_regimes.h"

#include <string>

#include "base/text/name.h"
#include "experiments/analysis/predict/predict.h"
#include "experiments/analysis/predict/regimes.h"
#include "experiments/campaign/run_cases.h"

namespace talus::analysis {
namespace {

namespace fs = std::filesystem;

// That of another prediction in `predictions` where the same has been simulated; else `own`.
fs::path FolderOf(const rigs::Case& rig_case, const fs::path& own, const fs::path& predictions,
                  trials::TrialEngine& engine) {
  const auto has_it = [&](const fs::path& folder) {
    return engine.IsPrepared(rig_case, folder) && engine.IsComplete(folder);
  };
  if (has_it(own)) return own;
  for (const fs::directory_entry& entry : fs::directory_iterator(predictions)) {
    const fs::path other = entry.path() / "tests" / own.filename();
    if (has_it(other)) return other;
  }
  return own;
}

}  // namespace

std::optional<std::vector<FlowRegime>> TestRegimes(const campaign::JointView& view,
                                                   const TestsToRun& tests,
                                                   const campaign::CampaignParts& parts) {
  const fs::path predictions = PredictFolder(view.folder.root);
  std::vector<std::string> names;
  std::vector<campaign::FolderCase> runs;
  for (const auto& experiment : campaign::ExperimentsOf(view.spec)) {
    const auto rig_case = campaign::CaseOf(
        view.spec,
        {.values = view.space.ToNative(tests.set),
         .seed = view.spec.seed,
         .scale_factor = NearestScaleFactor(view.spec.coarse_graining.Levels(), tests.scale_factor),
         .experiment = static_cast<int>(runs.size())},
        std::nullopt);
    const fs::path own = tests.prediction / "tests" /
                         (std::to_string(runs.size() + 1) + "_" + base::FileWord(experiment.name));
    runs.push_back(
        {.folder = FolderOf(rig_case, own, predictions, *parts.engine), .rig_case = rig_case});
    names.push_back(experiment.name);
  }
  if (!campaign::RunCases({.spec = view.spec,
                           .count = runs.size(),
                           .at = [&](std::size_t test) { return runs[test]; }},
                          parts)) {
    return std::nullopt;
  }
  std::vector<FlowRegime> regimes;
  for (std::size_t test = 0; test < runs.size(); ++test) {
    if (const auto regime = RegimeIn(runs[test].folder)) {
      regimes.push_back(DescribeRegime(names[test], {*regime}, runs[test].rig_case));
    }
  }
  return regimes;
}

}  // namespace talus::analysis
